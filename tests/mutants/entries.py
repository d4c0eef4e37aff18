"""The list of mutants: one replacement in one source each, what it breaks, and the tests that kill it."""

import tomllib
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).parents[2]
LISTS = Path(__file__).parent / "lists"


@dataclass
class Mutant:
    """One wrong program.

    Attributes
    ----------
    id : str
    file : str
        Source, from the root of the repository.
    old, new : str
        The text that is there exactly once, and what takes its place.
    breaks : str
        What is wrong then.
    killers : list of str
        Tests that fail. The first is the one that a run meets first.
    alive : str
        Why no test kills it: equal or nearly equal to the program.
    seconds : float
        Of a processor that the run took which killed it.
    """

    id: str
    file: str
    old: str
    new: str
    breaks: str
    killers: list[str] = field(default_factory=list)
    alive: str = ""
    seconds: float = 0.0

    @property
    def engine(self) -> bool:
        """Whether kernels have to be compiled for it."""
        return self.file.startswith("fmu_bearing/engine/")

    def to_toml(self) -> str:
        """Its entry of the list."""
        lines = [
            "[[mutant]]",
            f'id = "{self.id}"',
            f"file = {quoted(self.file)}",
            f"old = {quoted(self.old)}",
        ]
        lines += [f"new = {quoted(self.new)}", f"breaks = {quoted(self.breaks)}"]
        if self.killers:
            lines += ["killers = [", *(f"    {quoted(one)}," for one in self.killers), "]"]
        if self.alive:
            lines.append(f"alive = {quoted(self.alive)}")
        if self.seconds:
            lines.append(f"seconds = {self.seconds:.0f}")
        return "\n".join(lines) + "\n"


def quoted(text: str) -> str:
    """Text as TOML has it, without escapes."""
    if "\n" in text or "'" in text:
        return f"'''\n{text}'''"
    return f"'{text}'"


def text_of(source: str, begin: int, end: int, new: str) -> tuple[str, str]:
    """Whole lines about a replacement, as many as make the old text one that is there exactly once."""
    first, last = source.rfind("\n", 0, begin) + 1, source.find("\n", end)
    while True:
        old = source[first:last].lstrip(" ") if source[first:last].count("\n") == 0 else source[first:last]
        at = last - len(old)
        if source.count(old) == 1:
            return old, source[at:begin] + new + source[end:last]
        first = source.rfind("\n", 0, first - 1) + 1


def read(path: Path) -> list[Mutant]:
    """Mutants of one list."""
    return [Mutant(**one) for one in tomllib.loads(path.read_text("utf-8"))["mutant"]]


def mutants() -> list[Mutant]:
    """All of them, list after list."""
    return [one for path in sorted(LISTS.glob("*.toml")) for one in read(path)]
