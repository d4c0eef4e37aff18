"""Envelope of a defect's vibration: pits of CWRU's 6205, faults of MFPT's bearing under seven loads.

Nothing is fitted. The sensor is an accelerometer on the outer ring, which is held by a pedestal: the
machine's own structure is not known, so levels are not compared. Sizes of MFPT's faults, clearances, preload
and loads of CWRU are not given; ours have a range over them.
"""

import functools
from dataclasses import dataclass

import numpy as np

from benchmarks.measured.sources import Value
from fmu_bearing import Scene, new_scene, record
from fmu_bearing.recording.measurements.envelope import envelope
from fmu_bearing.scene import read_scene_text

#: Directions of a defect of the outer race at a place of the clock, deg.
CLOCK = {3: 90.0, 6: 180.0, 9: 270.0, 12: 0.0}
#: N: load across and preload along the axis of CWRU's bearing, rotor and washer; and the ends of their range.
LOADS = ((300.0, 50.0), (300.0, 150.0), (80.0, 50.0))
#: mm along rolling and across: faults of MFPT's bearing, and the ends of their range.
SIZES = ((1.0, 1.0), (0.5, 0.5), (2.0, 4.0))
#: Hz: band of the envelope of CWRU's records of 12 kHz, and of MFPT's of 48.8 kHz.
CWRU_BAND, MFPT_BAND = (2500.0, 4500.0), (2000.0, 20000.0)
_SETTLE, _LENGTH = 0.1, 1.0  # s
_DEPTH = 279.0  # um: of CWRU's pits, 0.011 inch
#: MFPT's bearing: balls and pitch diameter (mm), and the speed that its inner race's side bands have (r/min).
_MFPT_BALL, _MFPT_PITCH, _MFPT_SPEED = 5.969, 31.623, 1484.0
LEAST = 111.0  # N: of the records of the outer race
_NO_LOAD = 10.0  # N: weight of a shaft where the record has no load


@dataclass(frozen=True)
class Shaken:
    """Line and side bands of the squared envelope, rms and kurtosis of the whole acceleration."""

    over_shaft: float
    """Frequency of the line over that of the shaft."""
    line: float
    """Amplitude, m2/s4."""
    side_bands: float
    """Mean of both at the shaft's frequency, over the line."""
    rms: float
    kurtosis: float


def _sensor(angle: float) -> dict[str, object]:
    return {"name": "DE", "on": "outer ring", "angle_deg": angle, "direction": "radial"}


def shaken(scene: Scene, ring: str, band: tuple[float, float]) -> Shaken:
    """Return what the accelerometer of a scene reads over a defect of a ring, from a run of ``full``."""
    recording = record(scene, _LENGTH, settle=_SETTLE, progress=False)
    signal = recording.acceleration("DE")
    (turning,) = recording.bearing_kinematics()
    shaft = turning.f_r
    passing = turning.f_o if ring == "outer" else turning.f_i
    found = envelope(signal, recording.rate, band)
    at, line, _ = found.at(passing)
    sides = [found.at(at + side)[1] for side in (-shaft, shaft)]
    centred = signal - signal.mean()
    rms = float(np.sqrt(np.mean(centred**2)))
    return Shaken(at / shaft, line, float(np.mean(sides)) / line, rms, float(np.mean(centred**4)) / rms**4)


@functools.cache
def cwru(ring: str, clock: int, size: float, across: float, along: float) -> Shaken:
    """Return what CWRU's 6205 at 1,797 r/min reads at 12 o'clock over a pit (mm) under two loads (N)."""
    text = new_scene(
        "cwru", "6205", clearance="CN", radial_load_N=across, speed_rpm=1797.0, grade="P6", sound=False
    )
    defect: dict[str, object] = {"on": ring, "shape": "pit", "length_mm": size, "depth_um": _DEPTH}
    if ring == "outer":
        defect["angle_deg"] = CLOCK[clock]
    scene = read_scene_text(text).replace(
        {
            "bearing.ball_diameter_mm": 7.94, "bearing.pitch_diameter_mm": 39.04,
            "mounting.preload_N": along, "imperfections.defect": [defect],
            "accelerometer": [_sensor(0.0)], "fidelity.model": "full",
        }
    )  # fmt: skip
    return shaken(scene, ring, CWRU_BAND)


@functools.cache
def mfpt(ring: str, load: float, size: tuple[float, float]) -> Shaken:
    """Return what MFPT's bearing reads in the direction of its load (N) over a spall (mm)."""
    text = new_scene(
        "mfpt",
        "6004",
        clearance="CN",
        radial_load_N=max(load, _NO_LOAD),
        speed_rpm=_MFPT_SPEED,
        grade="P6",
        sound=False,
    )
    scene = read_scene_text(text)
    cage = scene.bearing.cage
    assert cage is not None
    length, width = size
    defect = {"on": ring, "shape": "spall", "length_mm": length, "width_mm": width, "depth_um": _DEPTH}
    scene = scene.replace(
        {
            "bearing.ball_count": 8, "bearing.ball_diameter_mm": _MFPT_BALL,
            "bearing.pitch_diameter_mm": _MFPT_PITCH,
            "bearing.cage.pocket_diameter_mm": _MFPT_BALL * cage.pocket_diameter_mm
            / scene.bearing.ball_diameter_mm,
            "imperfections.defect": [defect], "accelerometer": [_sensor(180.0)], "fidelity.model": "full",
        }
    )  # fmt: skip
    return shaken(scene, ring, MFPT_BAND)


def cwru_value(value: Value, loads: tuple[float, float]) -> float:
    """Return a value of CWRU's 6205 under loads across and along the axis (N)."""
    size = float(value.grade.split()[0])
    if value.quantity.startswith("side bands"):
        return cwru("inner", 0, size, *loads).side_bands
    clock = int(value.quantity.split(" at ")[1].split()[0])
    return cwru("outer", clock, size, *loads).line / cwru("outer", 6, size, *loads).line


def mfpt_value(value: Value, size: tuple[float, float]) -> float:
    """Return a value of MFPT's bearing with a spall (mm)."""
    ring = "inner" if "inner race" in value.quantity else "outer"
    one = mfpt(ring, value.load_N, size)
    if value.quantity.startswith("line"):
        return one.over_shaft
    if value.quantity.startswith("side bands"):
        return one.side_bands
    key = value.quantity.split()[0]
    return float(getattr(one, key) / getattr(mfpt(ring, LEAST, size), key))
