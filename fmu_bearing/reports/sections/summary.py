"""The figures at the top of the page, and the warnings."""

import math
from collections.abc import Callable, Iterable
from functools import partial
from typing import Any

import numpy as np

from fmu_bearing.design.verdict import Verdict, overall, shown_hours
from fmu_bearing.engine.constants import RPM
from fmu_bearing.recording.channels.sources import bodies_of
from fmu_bearing.recording.measurements.measure import strongest
from fmu_bearing.recording.studies.spread import Spread, doubt_of
from fmu_bearing.reports.data.microphones import Microphones
from fmu_bearing.reports.data.subject import Subject
from fmu_bearing.reports.page import look
from fmu_bearing.reports.page.blocks import Absent, Card
from fmu_bearing.results.balls import RACES

Tile = dict[str, Any]
Figure = tuple[str, str, str, str | Callable[[float], str], Callable[[], float]]
_THIN_FILM = 1.0  # film over roughness: below it, asperities touch
_CANCELS = 1.0  # dB by which a component alone exceeds all together before it is mentioned
_TURNS = 10.0  # of the cage, for a mean worth the name


def _tiles(figures: Iterable[Figure]) -> list[Tile]:
    """Return figures as the first screen shows them; those that the recording does not have are left out."""
    tiles = []
    for key, label, unit, digits, value in figures:
        try:
            number = float(value())
        except Absent:
            continue
        if math.isfinite(number):
            text = digits(number) if callable(digits) else format(number, digits)
            tiles.append({"key": key, "label": label, "value": number, "unit": unit, "text": text})
    return tiles


def tiles(subject: Subject, microphones: Microphones | None, sure: Spread | None = None) -> list[Tile]:
    """Return the most important figures of the whole, and of a single bearing its own."""
    figures: list[Figure] = [
        ("speed_rpm", "shaft speed", "r/min", ",.0f", lambda: subject.speed / RPM),
        ("preload_N", "preload", "N", "g", lambda: subject.scene.assembly.preload_N),
    ]
    if microphones is not None:
        k = microphones.loudest
        label = f"loudest, at {microphones.names[k]}"
        label += f"; {sure.low[0]:.0f} to {sure.high[0]:.0f} over {sure.over}" if sure else ""
        figures.append(("laeq_dB", label, "dB(A)", ".1f", lambda: microphones.levels["A"]["total"][k]))
    for body in ("inner_ring", "outer_ring", "shaft.nose", "housing"):
        words = f"{look.words(body)}, rms velocity"
        figures.append((f"{body}_rms_mm_s", words, "mm/s", ".3g", partial(_rms, subject, body)))
    if not subject.several:
        return _tiles([*figures, *_figures(subject, 0)])
    return _tiles([*figures, *_power(subject, ""), *_of_shaft(subject)])


def cards(subject: Subject, judged: Iterable[Verdict]) -> tuple[list[Card], dict[str, float]]:
    """Return a card for each bearing of a set, with the gravest verdict on it, and all figures by name."""
    judged = list(judged)
    shown: list[Card] = []
    named: dict[str, float] = {}
    for number, prefix in enumerate(subject.prefixes.values() if subject.several else ()):
        rows = _tiles(_figures(subject, number))
        named |= {prefix + row["key"]: row["value"] for row in rows}
        gravest = overall(one for one in judged if one.bearing == number + 1)
        cells = [(row["label"], row["text"], row["unit"]) for row in rows]
        shown.append(Card(f"Bearing {number + 1}", gravest, cells))
    return shown, named


def _power(subject: Subject, prefix: str) -> list[Figure]:
    torque = partial(subject.mean, f"{prefix}friction_torque")
    return [
        ("torque_N_mm", "friction torque", "N mm", ".3g", lambda: 1e3 * torque()),
        ("loss_W", "friction power", "W", ".3g", lambda: abs(torque() * subject.speed)),
    ]


def _figures(subject: Subject, number: int) -> list[Figure]:
    """Return the figures of one bearing, from 0: of the run, then of its operating point."""
    prefix = list(subject.prefixes.values())[number]

    def largest(race: str) -> float:
        return float(subject.output(f"{prefix}contact.{race}.pressure_max").max())

    def stiffness(way: int) -> float:
        return 1e-6 * float(subject.point.bearings[number].stiffness[way, way])

    def preload() -> float:
        return subject.point.statics.preloads.get("running", len(subject.prefixes) * [math.nan])[number]

    def life() -> float:
        found = subject.point.bearings[number].life
        return math.nan if found is None else found

    film = f"{prefix}film.lambda_min"
    return [
        *_power(subject, prefix),
        ("pressure_GPa", "largest contact pressure", "GPa", ".3g", lambda: 1e-9 * max(map(largest, RACES))),
        ("lambda", "thinnest film / roughness", "", ".3g", lambda: float(subject.output(film).min())),
        ("axial_N", "axial load", "N", ".1f", lambda: subject.point.bearings[number].axial),
        ("radial_N", "radial load, with weight", "N", ".1f", lambda: subject.point.bearings[number].radial),
        ("preload_at_speed_N", "preload at speed, without load", "N", ".1f", preload),
        ("axial_stiffness", "axial stiffness", "N/um", ".1f", lambda: stiffness(0)),
        ("radial_stiffness", "radial stiffness", "N/um", ".1f", lambda: 0.5 * (stiffness(1) + stiffness(2))),
        ("life_h", "L10r", "h", shown_hours, life),
    ]


def _of_shaft(subject: Subject) -> list[Figure]:
    """Return the figures of a shaft at its operating point."""
    try:
        point = subject.point
    except Absent:
        return []
    statics, life = point.statics, math.nan if point.life is None else point.life
    lowest = min(statics.bearings, key=lambda one: one.axial)
    figures: list[Figure] = [
        ("axial_stiffness", "axial stiffness of the shaft", "N/um", ".1f",
         lambda: 1e-6 * statics.axial_stiffness),
        ("nose_stiffness", "radial stiffness at the nose", "N/um", ".1f",
         lambda: 1e-6 * statics.nose_stiffness),
        ("least_axial_N", f"least axial load, bearing {lowest.number}", "N", ".1f", lambda: lowest.axial),
        ("life_h", "L10r of all bearings together", "h", shown_hours, lambda: life),
    ]  # fmt: skip
    if statics.lift_off:
        way, first = min(statics.lift_off.items(), key=lambda pair: abs(pair[1].load))
        words = f"axial load {way} that unloads bearing {first.bearing}"
        figures.append(("lift_off_N", words, "N", ".0f", lambda: abs(first.load)))
    return figures


def _rms(subject: Subject, body: str) -> float:
    """Return the rms velocity (mm/s) of a body's centre about its mean, the three axes together."""
    return 1e3 * math.sqrt(sum(float(np.var(subject.output(f"{body}.velocity.{axis}"))) for axis in "xyz"))


def sentences(subject: Subject, microphones: Microphones | None, sure: Spread | None = None) -> list[str]:
    """Describe the loudest component, the strongest line and other main results."""
    if microphones is None:
        return []
    k, said = microphones.loudest, []
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
        said.append(text + ".")
    if subject.recording.scene is not None and k in microphones.shown:
        frequency, levels = microphones.spectra
        values = levels["total"][microphones.shown.index(k)]
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
            said.append(text + ".")
    if sure is not None:
        said.append(
            f"That level lies between {sure.low[0]:.0f} and {sure.high[0]:.0f} dB(A). What decides: "
            f"{sure.decides(0)}. {sure.remark()}"
        )
    return said


def warnings_of(subject: Subject) -> list[str]:
    """Return the limits of the figures, the warnings of the run first."""
    warnings = list(subject.warnings)
    for words, prefix in subject.prefixes.items():
        whose = words and f" of {words}"
        for race in RACES:
            name = f"{prefix}contact.{race}.shoulder_margin"
            if subject.has(name) and (margin := float(subject.output(name).min())) < 0.0:
                warnings.append(
                    f"The ellipse of the most loaded contact of the {race} race{whose} reaches "
                    f"{-math.degrees(margin):.1f} deg beyond its shoulder: the edge cuts in there, while "
                    "loads and stiffness are computed for an unbroken groove."
                )
        name = f"{prefix}film.lambda_min"
        if subject.has(name) and (film := float(subject.output(name).min())) < _THIN_FILM:
            warnings.append(
                f"The thinnest film{whose} is {film:.2g} times the composite roughness: asperities touch "
                "there, while traction is computed for a full film."
            )
    if doubted := doubt_of(subject.recording):
        warnings.append(f"{doubted[0].upper()}{doubted[1:]}.")
    warnings += _reach(subject)
    warnings += _length(subject)
    return list(dict.fromkeys(warnings))


def _reach(subject: Subject) -> list[str]:
    """How far in frequency the radiation can be trusted."""
    if subject.recording.scene is None or subject.radiation_model != "compact":
        return []
    scene = subject.recording.scene
    sound_speed = 340.0 if scene.sound is None else scene.sound.sound_speed_m_s
    bodies = [body for _, body in bodies_of(scene)]
    diameter = max(body.housing.diameter if body.housing else body.outer_ring.outer for body in bodies)
    highest = sound_speed / (math.pi * diameter)
    return [
        "Radiation model compact assumes bodies that are small against the wavelength. Its levels and "
        f"directions lose accuracy above about {0.5 * highest:,.0f} Hz (ka = 0.5). Radiation model bem has "
        "no such limit up to 20 kHz."
    ]


def _length(subject: Subject) -> list[str]:
    """Whether the recording is long enough for means."""
    duration = subject.recording.size / subject.recording.rate
    try:
        cage = min(one.f_c for one in subject.kinematics.values())
    except Absent:
        return []
    if cage > 0.0 and duration * cage < _TURNS:
        return [
            f"The recording holds {duration * cage:.1f} turns of the cage: means over so few depend on "
            f"where it begins; "
            f"{_TURNS:g} turns take {_TURNS / cage:.2g} s."
        ]
    return []
