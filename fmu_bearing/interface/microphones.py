"""Variables of microphones: totals are outputs, partial levels are local."""

from fmu_bearing.engine.layout import Z
from fmu_bearing.interface.variable import Variable, read
from fmu_bearing.scene import Scene

_MIC_WORDS = (
    ("pressure", "Sound pressure at microphone {}"),
    ("spl", "Time-weighted sound pressure level at microphone {}"),
    ("spl_a", "Time- and A-weighted sound level at microphone {}"),
    ("leq", "Equivalent level since metering began at microphone {}"),
    ("leq_a", "A-weighted equivalent level since metering began at microphone {}"),
    ("spl_inner_ring", "Time-weighted partial level of the inner ring at microphone {}"),
    (
        "spl_outer_ring",
        "Time-weighted partial level of the outer ring and what moves with it at microphone {}",
    ),
    ("spl_cage", "Time-weighted partial level of the cage at microphone {}"),
    ("spl_balls", "Time-weighted partial level of the balls at microphone {}"),
    ("spl_fast", "Fast sound pressure level at microphone {}"),
    ("spl_fast_a", "Fast A-weighted sound level at microphone {}"),
    ("spl_slow", "Slow sound pressure level at microphone {}"),
    ("spl_slow_a", "Slow A-weighted sound level at microphone {}"),
    ("spl_energy_sum", "Time-weighted level of the bodies' energies added at microphone {}"),
    ("spl_radial", "Time-weighted partial level of the radial motion of rings and cage at microphone {}"),
    ("spl_axial", "Time-weighted partial level of the axial motion of rings and cage at microphone {}"),
    ("spl_rotation", "Time-weighted partial level of the tilting of rings and cage at microphone {}"),
    ("spl_flexure", "Time-weighted partial level of the bending of the rings at microphone {}"),
)
#: Appended to the description of every level.
FLOOR = "; -106 dB: silence, or no metering yet"
_PLAIN = 9  # of these, what every scene has; the rest need sound.details
_PARTIAL = tuple(f"spl_{part}" for part in (
    "inner_ring", "outer_ring", "cage", "balls", "radial", "axial", "rotation", "flexure",
))  # fmt: skip


def microphones(scene: Scene, causality: str, first: int) -> list[Variable]:
    """Return the variables of each microphone, from the place ``first`` in ``z`` on."""
    if scene.sound is None:
        return []
    words_of = _MIC_WORDS if scene.sound.details else _MIC_WORDS[:_PLAIN]
    table = []
    for k, (name, _) in enumerate(scene.microphones):
        for i, (label, words) in enumerate(words_of):
            absent = label == "spl_cage" and all(one.cage is None for one in scene.geometries)
            if absent or (label in _PARTIAL) != (causality == "local"):
                continue
            unit = "Pa" if label == "pressure" else "dB"
            place = first + Z.PER_MIC * k + i
            text = words.format(name) + ("" if label == "pressure" else FLOOR)
            table.append(read(f"mic[{k + 1}].{label}", causality, text, unit, place))
        if causality == "output" and scene.sound.third_octaves:
            table += _third_octaves(k, name, first + Z.PER_MIC * len(scene.microphones) + len(Z.BANDS) * k)
    return table


def _third_octaves(mic: int, name: str, first: int) -> list[Variable]:
    """Return the bands of one microphone, named by their nominal frequency; 31 means 31.5 Hz."""
    return [
        read(
            f"mic[{mic + 1}].third_octave[{int(nominal)}]",
            "output",
            f"Fast third-octave level around {nominal:g} Hz at microphone {name}{FLOOR}",
            "dB",
            first + band,
        )
        for band, nominal in enumerate(Z.BANDS)
    ]
