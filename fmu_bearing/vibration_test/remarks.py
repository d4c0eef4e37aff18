"""What to know of the figures of a vibration test, in sentences."""

from collections.abc import Iterator, Mapping, Sequence

from fmu_bearing.prepare.surfaces import HIGHEST_BALL_ORDER
from fmu_bearing.scene import Scene
from fmu_bearing.vibration_test.rig import BANDS, bands, by_standard, operation

_APART = 1.2  # between the loading pieces


def remarks(
    scene: Scene,
    spin: float,
    means: Mapping[str, Sequence[float]],
    limits: Mapping[str, float],
) -> Iterator[str]:
    """Yield the remarks on a test.

    Parameters
    ----------
    scene : Scene
        Of the test.
    spin : float
        Of the balls, Hz.
    means : mapping of str to sequence of float
        Rms velocity (um/s) by band: on the soft and on the firm piece.
    limits : mapping of str to float
        Of some bands, um/s.
    """
    for name, limit in limits.items():
        if means[name][0] > limit:
            yield f"{name}: {means[name][0]:.3g} um/s passes its limit of {limit:.3g} um/s."
    for name, (soft, firm) in means.items():
        if max(soft, firm) > _APART * min(soft, firm):
            yield (
                f"{name} is not the bearing's alone: {soft:.3g} um/s on the soft loading piece, {firm:.3g} "
                "um/s on the firm one."
            )
    flaws = scene.imperfections
    end = HIGHEST_BALL_ORDER * spin
    if flaws is not None and flaws.ball_form_nm and end < bands(scene)[BANDS[-1]][1]:
        yield f"The balls have no waves that sound above {1e-3 * end:.2g} kHz, inside H."
    if not scene.bends:
        yield "The rings stay round here, for comparison: a sensor touches a ring that bends."
    if not by_standard(scene):
        yield "The outside diameter is outside the standard's range: this is no test by the standard."
    elif (scene.operation.speed_rpm, scene.mounted.preload_N) != operation(scene):
        speed, load = operation(scene)
        yield f"This is no test by the standard, which asks for {speed:g} r/min and {load:g} N."
