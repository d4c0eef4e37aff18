"""Lines that local defects make: how often balls pass them, and what modulates that."""

import json
from collections.abc import Sequence
from typing import NamedTuple

from fmu_bearing.acoustics.analysis.lines import combination
from fmu_bearing.acoustics.analysis.spectrum import KinematicFrequencies
from fmu_bearing.scene import Scene
from fmu_bearing.scene.defect import Place

#: What passes a defect on a race or a ball (its multiple of a frequency), and what modulates the passing.
#: A ball meets both races in a turn about itself, and its cage takes it round the load.
CARRIERS: dict[Place, tuple[int, str, str]] = {
    "outer": (1, "f_o", "f_r"), "inner": (1, "f_i", "f_r"), "ball": (2, "f_b", "f_c"),
}  # fmt: skip


class DefectLine(NamedTuple):
    """The lines of one local defect.

    Attributes
    ----------
    defect : str
        Which one: ``defect 1``, of a set ``defect 1 of bearing 2``, counted as its outputs are.
    variable : str
        What the names of its outputs begin with: ``defect[1]``, of a set ``bearing[2].defect[1]``.
    words : str
        What it is.
    multiple, carrier, modulator
        Its lines are at n times ``multiple`` times the carrier, plus and minus m times the modulator, each by
        its name as ``f_o``.
    frequency, side : float
        Of the first line, and between it and its side bands (Hz).
    bearing : int
        From 0.
    """

    defect: str
    variable: str
    words: str
    multiple: int
    carrier: str
    modulator: str
    frequency: float
    side: float
    bearing: int

    @property
    def name(self) -> str:
        """Its first line: ``f_o``, ``f_i`` or ``2 f_b``."""
        return combination(self.multiple, self.carrier)


def defect_lines(scene: Scene, each: Sequence[KinematicFrequencies]) -> tuple[DefectLine, ...]:
    """Return the lines of all local defects of a scene; ``each``: frequencies (Hz) of each bearing."""
    found = []
    for k, (bearing, at) in enumerate(zip(scene.bearings(), each, strict=True)):
        flaws = bearing.scene.imperfections
        for number, defect in enumerate(() if flaws is None else flaws.defect, start=1):
            multiple, carrier, modulator = CARRIERS[defect.on]
            of = f" of bearing {bearing.number}" if bearing.prefix else ""
            found.append(
                DefectLine(
                    f"defect {number}{of}", f"{bearing.prefix}defect[{number}]", defect.words, multiple,
                    carrier, modulator, multiple * float(getattr(at, carrier)),
                    float(getattr(at, modulator)), k,
                )
            )  # fmt: skip
    return tuple(found)


def marked(lines: Sequence[DefectLine]) -> dict[str, str]:
    """Return which defects make a line, by its first name: ``{"f_o": "defect 1 and defect 2"}``."""
    names: dict[str, list[str]] = {}
    for line in lines:
        names.setdefault(line.name, []).append(line.defect)
    return {name: " and ".join(defects) for name, defects in names.items()}


def defect_labels(scene: Scene | None) -> dict[str, str]:
    """Return the table of a scene's defects as an attribute of a data file: JSON text; empty without any.

    Of each what its outputs are called, the first line it makes, what modulates it, and its keys in the
    scene.
    """
    if scene is None or not scene.has_defects:
        return {}
    table = []
    for bearing in scene.bearings():
        flaws = bearing.scene.imperfections
        for number, defect in enumerate(() if flaws is None else flaws.defect, start=1):
            multiple, carrier, modulator = CARRIERS[defect.on]
            keys = defect.model_dump(exclude_none=True)
            line = {"line": combination(multiple, carrier), "side_bands": modulator}
            table.append({"defect": f"{bearing.prefix}defect[{number}]", **line, **keys})
    return {"defects": json.dumps(table)}
