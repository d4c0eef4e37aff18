"""What to know of a surface that was found, in sentences, and values that no surface explains."""

from collections.abc import Iterator

import numpy as np

from fmu_bearing.scene.surface import Surface
from fmu_bearing.vibration_test.inverse.energies import line_names
from fmu_bearing.vibration_test.inverse.measured import Measured
from fmu_bearing.vibration_test.inverse.posterior import Draws, Prior
from fmu_bearing.vibration_test.inverse.runs import Spectra

#: Lines that say most about single orders of the races: the first of each.
ASKED = ("f_i - f_r", "f_o")
_UNMET = 9.0  # chi^2 of the best draw: three standard deviations
_EDGE, _SHARE = 0.05, 0.25  # of the exponents near a bound; evenly spread ones have 4 %
_OPEN = 0.6  # of the bounds in ln: a range as wide says nothing
_TOGETHER = 0.8  # correlation
_FEW = 200.0  # independent draws for a range of 95 %
_USUAL_NM = (0.3, 300.0)  # order 12 of a race of any class, by far


def check_met(drawn: Draws, prior: Prior, given: Measured) -> None:
    """Refuse values that no law explains, and those that only a law on the bounds of the search explains.

    Raises
    ------
    ValueError
        With the value that is furthest off, by what factor, and the way out.
    """
    low, high = prior.exponent
    if drawn.best > _UNMET:
        deviations = np.array([value.deviation for value in given.values])
        worst = int(np.abs(drawn.misfit / deviations).argmax())
        window, value = given.windows[worst], given.values[worst]
        raise ValueError(
            f"no exponent from {low:g} to {high:g} meets {given.words}: {window.name} = {value.velocity:.3g} "
            f"um/s is furthest off, the nearest law has {np.exp(drawn.misfit[worst]):.2g} times that; check "
            "the bearing and the unit (um/s rms, or --unit anderon)"
        )
    for end, near in ((low, drawn.exponent < low + _EDGE), (high, drawn.exponent > high - _EDGE)):
        if near.mean() > _SHARE:
            raise ValueError(
                f"{given.words}: the best exponents lie at the end of what is searched, p = {end:g}, with "
                f"A_1 about {np.median(drawn.amplitude_um):.2g} um: a range would mean nothing; check the "
                "bearing and the unit (um/s rms, or --unit anderon)"
            )


def remarks(surface: Surface, drawn: Draws, prior: Prior, given: Measured, found: Spectra) -> Iterator[str]:
    """Yield what to know of a surface, and the line to ask for."""
    law, order = surface.law, surface.order()
    together = float(surface.correlation[0, 1])
    if abs(together) >= _TOGETHER:
        yield (
            f"A_1 and p go together (correlation {together:.2f}): compare bearings by order 12, which has "
            f"{order.median:.3g} nm ({order.low:.3g} to {order.high:.3g})."
        )
    names = {window.name for window in given.windows}
    if surface.order_scatter_seed is not None and (missing := [one for one in ASKED if one not in names]):
        places = line_names(found)
        words = " and ".join(f"{one} ({places[one]:.0f} Hz)" for one in missing)
        yield (
            f"Ask for the {'line' if len(missing) == 1 else 'lines'} {words} of the tester's spectrum, um/s "
            "rms: orders scatter about the law, and a single one often makes the level of a machine."
        )
    ball, (low, high) = law.ball_form_nm, prior.ball_form_nm
    if np.log(ball.high / ball.low) > _OPEN * np.log(high / low):
        yield f"The form of the balls stays open: {ball.low:.3g} to {ball.high:.3g} nm."
    limits = [window.name for window, value in zip(given.windows, given.values, strict=True) if value.at_most]
    if limits:
        yield (
            f"{', '.join(limits)}: a limit is no value. Below it the range rests on assumed bounds: A_1 "
            f"{prior.amplitude_um[0]:.2g} to {prior.amplitude_um[1]:.2g} um, p {prior.exponent[0]:g} to "
            f"{prior.exponent[1]:g}."
        )
    elif "M" in names:
        yield "M counts with a standard deviation of 38 %: loading piece and form of the balls make it."
    if not _USUAL_NM[0] < order.median < _USUAL_NM[1]:
        yield (
            f"Order 12 of the races has {order.median:.2g} nm, as no class has: check the unit of the values "
            "(um/s rms, or --unit anderon)."
        )
    if drawn.effective < _FEW:
        yield f"Few draws agree with the values, {drawn.effective:.0f}: the ranges are rough."
