"""What to know of the figures of a vibration test, in sentences."""

from collections.abc import Iterator, Mapping, Sequence

from fmu_bearing.prepare.surfaces import HIGHEST_BALL_ORDER
from fmu_bearing.scene import Scene
from fmu_bearing.vibration_test.anderon import micrometres
from fmu_bearing.vibration_test.rig import BANDS, bands, by_standard, operation

_APART = 1.2  # between the loading pieces
_SPEED_OFF = (-0.02, 0.01)  # of the speed: ISO 15242-2:2015, 4.1
_LOAD_OFF = 0.1  # of the load: assumed


def remarks(
    scene: Scene, spin: float, means: Mapping[str, Sequence[float]], limits: Mapping[str, float]
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
            unit = micrometres(scene)[name]
            yield (
                f"{name}: {means[name][0]:.3g} um/s on the soft piece ({means[name][0] / unit:.3g} Anderon) "
                f"is above its limit of {limit:.3g} um/s ({limit / unit:.3g} Anderon)."
            )
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
        return
    speed, load = operation(scene)
    least, most = (speed * (1.0 + part) for part in _SPEED_OFF)
    if (
        not least <= abs(scene.operation.speed_rpm) <= most
        or abs(scene.mounted.preload_N - load) > _LOAD_OFF * load
    ):
        yield (
            f"This is no test by the standard, which asks for {speed:g} r/min, and for {load:g} N as is "
            "assumed here."
        )
