"""Verdicts on what holds the balls of a bearing: preload or load beside the least one, preload class."""

from collections.abc import Iterator

from fmu_bearing.design.operating_point import BearingPoint
from fmu_bearing.design.rating import preload_classes, unclassed
from fmu_bearing.design.verdict import Verdict, unjudged
from fmu_bearing.formulas import makers


def preload_verdicts(point: BearingPoint) -> Iterator[Verdict]:
    """Yield the verdicts on the preload of one bearing, of a deep groove one on its load."""
    if point.scene.bearing.is_deep_groove:
        yield _holding(point)
        return
    preload = point.scene.mounted.preload_N
    rpm = point.scene.operation.speed_rpm
    advice, name = "", "axial load" if point.on_shaft else "preload"
    # a computed load has three digits, a scene's own figure those that it is given with
    shown = f"{point.axial:.3g}" if point.on_shaft else f"{point.axial:g}"
    if point.axial < point.least_preload:
        advice = (
            f"{name} {shown} N: below the {point.least_preload:.3g} N that keep balls from skidding at "
            f"{rpm:g} r/min (1.1 Z F_c tan(alpha), fitted to GMN's spring preloads): give more preload, "
            "lower speed, or lighter balls"
        )
    source = "1.1 Z F_c tan(alpha): fit to GMN, +-9 %"
    source += "" if point.scene.materials.steel_rings else ", with rings of steel"
    yield Verdict(
        "least_preload", f"{name} over skidding, N", point.axial, shown, f"{point.least_preload:.3g}",
        source, "change" if advice else "good", advice,
    )  # fmt: skip
    label, found = "preload class, N", preload_classes(point.scene)
    if found is None or preload == 0.0:
        why = unclassed(point.scene) or "no preload"
        yield unjudged("preload_class", label, why, preload, f"{preload:g}")
        return
    if point.scene.fit is not None and point.scene.fit.preload == "mounted":
        why = "classes are of the loose bearing, and this preload is of the mounted one"
        yield unjudged("preload_class", label, why, preload, f"{preload:g}")
        return
    heavy, advice = found.loads["heavy"], ""
    own = makers.preload_class(preload, found.loads)
    if own is None:
        shown, share = f"{preload / heavy:.2g} x heavy", ""
        if point.rating is not None:
            share = f" ({preload / point.rating.dynamic:.3f} C)"
        advice = (
            f"preload {preload:g} N{share}: {preload / heavy:.2g} times the heavy class of {found.maker}, "
            f"{heavy:g} N: give {heavy:g} N or less, unless it takes the place of a load"
        )
    else:
        between = makers.CLASS_SLACK * preload < found.loads[own]
        shown = f"up to {own}" if between else own
    yield Verdict(
        "preload_class", label, preload, f"{preload:g}: {shown}",
        ", ".join(f"{one} {load:g}" for one, load in found.loads.items()),
        f"{found.maker}; loose, at standstill and 20 degC; 10 % slack", "watch" if advice else "good", advice,
    )  # fmt: skip


def _holding(point: BearingPoint) -> Verdict:
    """Return the verdict on the load of a deep groove bearing beside the least one against skidding."""
    shown, least, advice = f"{point.holding:.3g}", f"{point.least_preload:.3g}", ""
    if point.holding < point.least_preload:
        advice = (
            f"load {shown} N: below the {least} N that keep balls from skidding at "
            f"{point.scene.operation.speed_rpm:g} r/min (SKF's least radial load, from memory): give more "
            "load or an axial preload, lower speed, or a thinner oil"
        )
    return Verdict(
        "least_preload", "load over skidding, N", point.holding, shown, least,
        "SKF: least radial load, of radial and axial load together", "change" if advice else "good", advice,
    )  # fmt: skip
