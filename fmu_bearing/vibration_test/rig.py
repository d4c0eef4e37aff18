"""The rig of the vibration test: arbor, loading piece, speed, load, and the bands that are read.

The inner ring turns on a stiff, heavy arbor. A loading piece of rubber pushes the outer ring along the axis,
and no seat holds that ring: it bends. The bands up to 100 mm are those of ISO 15242-1, the speed there is the
default of ISO 15242-2:2015, 4.1 (1800 r/min, +1 -2 %; contact angles up to 45 deg). All other values of this
module are assumed: the text of the standard with its loads was not at hand.
"""

import math
from typing import Literal

from fmu_bearing.prepare.imperfections import fastest_wave, race_harmonics
from fmu_bearing.scene import Scene, SceneError
from fmu_bearing.scene.exclusions import require
from fmu_bearing.scene.imperfections import RACES

#: What pushes the outer ring: rubber that hardly holds it, or rubber that holds and damps it.
Piece = Literal["soft", "firm"]
PIECES: tuple[Piece, ...] = ("soft", "firm")
#: Radial stiffness (N/m), the same along the axis, and damping ratio of the loading pieces: assumed.
_RUBBER: dict[Piece, tuple[float, float]] = {"soft": (1e5, 0.1), "firm": (1e6, 0.5)}
_TURNING_MM2 = 200.0  # rotational over radial stiffness of a loading piece: assumed
#: Heavy and stiff beside any bearing of the test: assumed.
_ARBOR = {"mass_kg": 1000.0, "length_mm": 500.0, "diameter_mm": 200.0}
_ARBOR_TILT = {"stiffness_N_m_rad": 1e7, "damping_ratio": 0.05}
BENDING = (2, 3, 4)  # orders: 2 to 8 read the same within 2 %, at four times the time
_ROOM_DEGC = 22.0  # assumed: a test runs for seconds
_HIGHEST_KHZ = 10.0  # end of the high band

#: Axial load (N) of angular contact bearings by outside diameter (mm) up to: assumed to be the standard's.
_LOADS = ((25.0, 30.0), (50.0, 100.0), (100.0, 225.0), (140.0, 600.0), (170.0, 975.0), (200.0, 1350.0))
_SMALLEST, _LARGE, _LARGEST = 10.0, 100.0, 200.0  # outside diameters, mm
_SPEED, _SLOW_SPEED = 1800.0, 900.0  # r/min: up to _LARGE, and above (assumed)

#: Communication step (s): bands end at 10 kHz, samples reach to 12.5 kHz.
STEP = 40e-6
_SAMPLED = 0.5 / STEP  # Hz

BANDS = ("L", "M", "H")
_EDGES = (50.0, 300.0, 1800.0, 10e3)  # Hz: ISO 15242-1


def rig(
    scene: Scene,
    *,
    piece: Piece = "soft",
    rigid: bool = False,
    speed_rpm: float | None = None,
    load_N: float | None = None,
) -> Scene:
    """Return the scene of the vibration test of a bearing: geometry, materials, oil, surfaces are kept.

    Of a set of bearings it is the test of the first one, on no shaft; the others differ in their seed alone.

    Parameters
    ----------
    scene : Scene
        Of a single bearing or a set. Its mounting, speed, temperatures, microphones and unbalance are left
        out.
    piece : str
        What loads the outer ring: ``"soft"`` or ``"firm"`` rubber.
    rigid : bool
        Whether the rings stay round. A sensor touches a thin ring, so this is for comparison only.
    speed_rpm, load_N : float, optional
        Speed (r/min) and axial load (N); default: those of the standard for the outside diameter.

    Raises
    ------
    SceneError
        For an outside diameter that the standard does not cover without both values, fidelity ``rings`` or
        ``response`` without ``rigid``, waves too fast to be sampled, and values outside their range.
    """
    if piece not in _RUBBER:
        raise SceneError(f"there is no loading piece '{piece}': choose from {', '.join(_RUBBER)}")
    stiffness, damping = _RUBBER[piece]
    own = scene.bearings()[0].scene
    given_speed, given_load = operation(own, speed_rpm, load_N)
    if not rigid:
        require(own, "vibration test")
    model = own.fidelity.model
    changes = {
        "mounting": {
            "preload_N": given_load,
            "pedestal_stiffness_N_m": stiffness,
            "pedestal_rotational_ratio_mm2": _TURNING_MM2,
            "pedestal_damping_ratio": damping,
            "rotor": _ARBOR,
            "tilt_support": _ARBOR_TILT,
            "flexure": None if rigid else {"outer_ring": BENDING},
        },
        "operation.speed_rpm": given_speed,
        "operation.lowest_speed_rpm": None,
        "operation.oil_temperature_degC": _ROOM_DEGC,
        "operation.inner_ring_temperature_degC": _ROOM_DEGC,
        "operation.outer_ring_temperature_degC": _ROOM_DEGC,
        "fidelity.model": "full" if model == "auto" else model,
        "fidelity.terms.gravity": False,
        "sound": None,
        "fmu": None,
    }
    if own.imperfections is not None:
        changes |= {"imperfections.unbalance_um": 0.0, "imperfections.highest_frequency_kHz": _HIGHEST_KHZ}
    scene_of_test = own.replace(changes)
    _check_waves(scene_of_test)
    return scene_of_test


def operation(
    scene: Scene, speed_rpm: float | None = None, load_N: float | None = None
) -> tuple[float, float]:
    """Return speed (r/min) and axial load (N) of the test, those given or the standard's.

    Raises
    ------
    SceneError
        For an outside diameter that the standard does not cover, unless both are given; for a speed of 0.
    """
    outside = scene.bearing.outside_diameter_mm
    if not by_standard(scene) and (speed_rpm is None or load_N is None):
        raise SceneError(
            f"{scene.name}: bearing.outside_diameter_mm = {outside:g}: the vibration test is for "
            f"{_SMALLEST:g} to {_LARGEST:g} mm; give both --speed and --load (speed_rpm, load_N): "
            "that is no test by the standard then"
        )
    usual_speed = _SPEED if outside <= _LARGE else _SLOW_SPEED
    usual_load = next((load for most, load in _LOADS if outside <= most), _LOADS[-1][1])
    speed, load = speed_rpm or usual_speed, load_N or usual_load
    if speed_rpm == 0.0 or not math.isfinite(speed):
        raise SceneError(f"{scene.name}: a vibration test at {speed_rpm:g} r/min: the inner ring has to turn")
    if load_N is not None and not (math.isfinite(load_N) and load_N > 0.0):
        raise SceneError(
            f"{scene.name}: a vibration test with {load_N:g} N: give an axial load above 0 N, which keeps "
            "the balls on their races"
        )
    return speed, load


def by_standard(scene: Scene) -> bool:
    """Whether the standard covers the outside diameter of a bearing."""
    return _SMALLEST <= scene.bearing.outside_diameter_mm <= _LARGEST


def bands(scene: Scene) -> dict[str, tuple[float, float]]:
    """Return the ends (Hz) of the bands L, M and H; of bearings above 100 mm they are half as high."""
    scale = 1.0 if scene.bearing.outside_diameter_mm <= _LARGE else 0.5
    ends = [scale * edge for edge in _EDGES]
    return {name: (ends[k], ends[k + 1]) for k, name in enumerate(BANDS)}


def _check_waves(scene: Scene) -> None:
    """Refuse waves that pass a ball faster than samples follow: they would appear at other frequencies."""
    flaws = scene.imperfections
    turns = abs(scene.operation.speed_rpm) / 60.0  # per second
    fastest = 0.0 if flaws is None else turns * fastest_wave(scene, race_harmonics(scene), 0)
    if flaws is None or fastest <= _SAMPLED:
        return
    explicit = [f"[[imperfections.{race}_race_harmonic]]" for race in RACES
                if getattr(flaws, f"{race}_race_harmonic")]  # fmt: skip
    way = f"leave out the highest orders of {' and '.join(explicit)}" if explicit else (
        "leave out imperfections.highest_order, so that the bands decide"
    )  # fmt: skip
    raise SceneError(
        f"{scene.name}: waves of the races pass a ball {1e-3 * fastest:.3g} thousand times per second in the "
        f"vibration test, above the {1e-3 * _SAMPLED:g} kHz that it samples; {way}"
    )
