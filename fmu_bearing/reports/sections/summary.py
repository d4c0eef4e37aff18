"""The figures at the top of the page, and the warnings."""

import math
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from fmu_bearing.engine.constants import RPM
from fmu_bearing.recording.measurements.measure import strongest
from fmu_bearing.recording.studies.spread import Spread, doubt_of
from fmu_bearing.reports.data.microphones import Microphones
from fmu_bearing.reports.data.subject import Subject
from fmu_bearing.reports.page import look
from fmu_bearing.reports.page.blocks import Absent
from fmu_bearing.run.balls import RACES

Tile = dict[str, Any]
_THIN_FILM = 1.0  # film over roughness: below it, asperities touch
_CANCELS = 1.0  # dB by which a component alone exceeds all together before it is mentioned
_TURNS = 10.0  # of the cage, for a mean worth the name


def tile(key: str, label: str, value: float, unit: str, digits: str) -> Tile:
    """Return one figure of the first screen."""
    return {"key": key, "label": label, "value": value, "unit": unit, "text": format(value, digits)}


def tiles(subject: Subject, microphones: Microphones | None, sure: Spread | None = None) -> list[Tile]:
    """Return the most important figures; figures that the recording does not have are left out."""
    found: list[Tile] = []

    def add(key: str, label: str, unit: str, digits: str, value: Callable[[], float]) -> None:
        try:
            number = value()
        except Absent:
            return
        if math.isfinite(number):
            found.append(tile(key, label, number, unit, digits))

    add("speed_rpm", "shaft speed", "r/min", ",.0f", lambda: subject.speed / RPM)
    add("preload_N", "preload", "N", "g", lambda: subject.scene.mounted.preload_N)
    if microphones is not None:
        k = microphones.loudest
        add(
            "laeq_dB",
            f"loudest, at {microphones.names[k]}"
            + (f"; {sure.low[0]:.0f} to {sure.high[0]:.0f} over {sure.over}" if sure else ""),
            "dB(A)",
            ".1f",
            lambda: float(microphones.levels["A"]["total"][k]),
        )
    for body in ("inner_ring", "outer_ring"):
        add(
            f"{body}_rms_mm_s", f"{look.words(body)}, rms velocity", "mm/s", ".3g",
            partial(_rms, subject, body),
        )  # fmt: skip
    add("torque_N_mm", "friction torque", "N mm", ".3g", lambda: 1e3 * subject.mean("friction_torque"))
    add("loss_W", "friction power", "W", ".3g", lambda: abs(subject.mean("friction_torque") * subject.speed))
    add(
        "pressure_GPa", "largest contact pressure", "GPa", ".3g",
        lambda: 1e-9 * max(_largest(subject, f"contact.{race}.pressure_max") for race in RACES),
    )  # fmt: skip
    add(
        "lambda",
        "thinnest film / roughness",
        "",
        ".3g",
        lambda: float(subject.output("film.lambda_min").min()),
    )
    return found


def _rms(subject: Subject, body: str) -> float:
    """Return the rms velocity (mm/s) of a body's centre about its mean, the three axes together."""
    return 1e3 * math.sqrt(sum(float(np.var(subject.output(f"{body}.velocity.{axis}"))) for axis in "xyz"))


def _largest(subject: Subject, name: str) -> float:
    return float(subject.output(name).max())


def sentences(subject: Subject, microphones: Microphones | None, sure: Spread | None = None) -> list[str]:
    """Describe the loudest component, the strongest line and other main results."""
    if microphones is None:
        return []
    k, found = microphones.loudest, []
    parts = microphones.components[1:]
    if parts:
        ranked = sorted(parts, key=lambda name: -microphones.levels["A"][name][k])
        alone = microphones.levels["A"][ranked[0]][k]
        text = f"At {microphones.names[k]} the {look.words(ranked[0])} is loudest ({alone:.1f} dB(A) alone)"
        if len(ranked) > 1:
            text += f", then the {look.words(ranked[1])} ({microphones.levels['A'][ranked[1]][k]:.1f})"
        total = microphones.levels["A"]["total"][k]
        if alone > total + _CANCELS:
            text += f"; in phase opposition they leave {total:.1f} dB(A) together"
        found.append(text + ".")
    if subject.recording.scene is not None and k in microphones.shown:
        frequency, values = microphones.spectra["total"][microphones.shown.index(k)]
        lines = strongest(subject.recording, frequency, values, 1)
        if lines:
            line = lines[0]
            why = f", {line.words}" if line.name else ", which no kinematic frequency explains"
            if line.nearest:
                why += f" (the nearest, {line.nearest}, is {abs(line.nearest_off):.0f} Hz off)"
            text = f"Its strongest line is at {line.frequency:.0f} Hz with {line.level:.1f} dB{why}"
            if sure is not None:
                kept, drawn = sure.stays
                words = (
                    "it stays the strongest" if sure.line_is_found else "no finding: it stays the strongest"
                )
                text += f"; {words} in {kept} of {drawn} draws"
            found.append(text + ".")
    if sure is not None:
        found.append(
            f"That level lies between {sure.low[0]:.0f} and {sure.high[0]:.0f} dB(A). What decides: "
            f"{sure.decides(0)}. {sure.remark()}"
        )
    return found


def warnings_of(subject: Subject) -> list[str]:
    """Return the limits of the figures, the warnings of the run first."""
    found = list(subject.warnings)
    for race in RACES:
        name = f"contact.{race}.shoulder_margin"
        if subject.has(name) and (margin := float(subject.output(name).min())) < 0.0:
            found.append(
                f"The ellipse of the most loaded contact of the {race} race reaches "
                f"{-math.degrees(margin):.1f} deg beyond "
                "its shoulder: the edge cuts in there, while loads and stiffness are computed for an "
                "unbroken groove."
            )
    if (
        subject.has("film.lambda_min")
        and (film := float(subject.output("film.lambda_min").min())) < _THIN_FILM
    ):
        found.append(
            f"The thinnest film is {film:.2g} times the composite roughness: asperities touch there, while "
            "traction is computed for a full film."
        )
    if doubted := doubt_of(subject.recording):
        found.append(f"{doubted[0].upper()}{doubted[1:]}.")
    found += _reach(subject)
    found += _length(subject)
    return list(dict.fromkeys(found))


def _reach(subject: Subject) -> list[str]:
    """How far in frequency the radiation can be trusted."""
    if subject.recording.scene is None or subject.radiation_model != "compact":
        return []
    scene = subject.recording.scene
    sound_speed = 340.0 if scene.sound is None else scene.sound.sound_speed_m_s
    radius = scene.bearing.outside_diameter_mm / 2e3
    if scene.sound is not None and scene.sound.radiator == "housing" and scene.mounted.housing is not None:
        radius = scene.mounted.housing.diameter_mm / 2e3
    highest = sound_speed / (2.0 * math.pi * radius)
    return [
        "Radiation model compact assumes bodies that are small against the wavelength. Its levels and "
        f"directions lose accuracy above about {0.5 * highest:,.0f} Hz (ka = 0.5). Radiation model bem has "
        "no such limit up to 20 kHz."
    ]


def _length(subject: Subject) -> list[str]:
    """Whether the recording is long enough for means."""
    duration = subject.recording.size / subject.recording.rate
    try:
        cage = subject.kinematics.f_c
    except Absent:
        return []
    if cage > 0.0 and duration * cage < _TURNS:
        return [
            f"The recording holds {duration * cage:.1f} turns of the cage: means over so few depend on "
            f"where it begins; "
            f"{_TURNS:g} turns take {_TURNS / cage:.2g} s."
        ]
    return []
