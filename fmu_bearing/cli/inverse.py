"""``fmu-bearing vibration --measured``: a surface from values that a supplier measured."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from fmu_bearing.cli.base import Refusal, Writing, check_new, end, print_json, show
from fmu_bearing.files import check_file
from fmu_bearing.progress import steps

if TYPE_CHECKING:
    from fmu_bearing.scene import Scene
    from fmu_bearing.vibration_test.anderon import Unit

FILE = "surface.toml"
Values = Annotated[
    str | None,
    typer.Option(
        "--measured",
        metavar="L=41,M=42,H=54",
        help="Find the surfaces from values of a test, two bands or more, in the unit of --unit; writes "
        f"{FILE} for `sound --surface` and scenes.",
    ),
]
Lines = Annotated[
    list[str] | None,
    typer.Option(
        "--line",
        metavar="NAME=UM/S",
        help='With --measured: line of the tester\'s spectrum, um/s rms, as "f_i - f_r=9"; once per line.',
    ),
]
Deviation = Annotated[
    str | None,
    typer.Option(
        "--std",
        metavar="PERCENT",
        help="With --measured: standard deviation of the values; default: 10 %; M has 38 % at least.",
    ),
]
AtMost = Annotated[
    bool, typer.Option("--at-most", help="With --measured: the bands are limits, which the bearing meets.")
]
ExactLaw = Annotated[
    bool,
    typer.Option(
        "--exact-law", help="With --measured: every order has the law's amplitude, without scatter."
    ),
]


@dataclass(frozen=True)
class Asked:
    """Options of a surface to find, as they were given."""

    measured: str | None
    lines: Sequence[str]
    deviation: str | None
    at_most: bool
    exact_law: bool

    def refuse_alone(self) -> None:
        """Refuse options that belong to ``--measured`` without it."""
        given = {
            "--line": self.lines, "--std": self.deviation, "--at-most": self.at_most,
            "--exact-law": self.exact_law,
        }  # fmt: skip
        for option, value in given.items():
            if value and self.measured is None:
                raise Refusal(f"{option} belongs to --measured: give it too, as --measured L=41,M=42,H=54")


def find(
    bearing: "Scene", asked: Asked, output: Path, force: bool, unit: "Unit", speed: float | None,
    load: float | None, as_json: bool,
) -> None:  # fmt: skip
    """Find a surface, print and write it."""
    from fmu_bearing.scene.surface_file import write_surface
    from fmu_bearing.vibration_test.inverse import surface
    from fmu_bearing.vibration_test.inverse.measured import DEVIATION

    path = output if output.suffix == ".toml" else output / FILE
    check_file(path)
    check_new(force, path)
    bands = _bands(asked.measured or "")
    surfaces = surface(
        bearing, bands.get("L"), bands.get("M"), bands.get("H"), lines=_lines(asked.lines),
        at_most=asked.at_most, unit=unit,
        deviation=DEVIATION if asked.deviation is None else _share(asked.deviation),
        exact_law=asked.exact_law, speed_rpm=speed, load_N=load,
        bar=partial(steps, what="sources of the vibration test, once per bearing", unit="runs"),
    )  # fmt: skip
    with Writing() as files:
        write_surface(surfaces, path)
        files.append(path)
    if as_json:
        law = {name: one._asdict() for name, one in surfaces.law._asdict().items()}
        print_json({
            "bearing": surfaces.bearing, "measured": surfaces.measured, "law": law,
            "order_12_nm": surfaces.order()._asdict(), "correlation": surfaces.correlation,
            "remarks": list(surfaces.remarks), "files": files,
        })  # fmt: skip
        return end(0, files)
    show(f"surfaces of {surfaces.words}", *surfaces.rows())
    for line in surfaces.remarks:
        typer.echo(line)
    end(0, files, named=True)


def _bands(text: str) -> dict[str, float]:
    from fmu_bearing.vibration_test.rig import BANDS

    values = _pairs("--measured", text.split(","), "L=41,M=42,H=54")
    for name in values:
        if name not in BANDS:
            raise Refusal(f"--measured {name}: bands are {', '.join(BANDS)}; lines are given with --line")
    return values


def _lines(given: Sequence[str]) -> dict[str, float]:
    return _pairs("--line", given, "f_i - f_r=9")


def _pairs(option: str, given: Sequence[str], example: str) -> dict[str, float]:
    """Return numbers by name; `Refusal` for text that is none."""
    values: dict[str, float] = {}
    for text in given:
        name, _, number = (part.strip() for part in text.partition("="))
        try:
            value = float(number)
        except ValueError:
            raise Refusal(f'{option} {text}: write name and number, as "{example}"') from None
        if name in values:
            raise Refusal(f"{option} {name} is given twice: keep one")
        values[name] = value
    return values


def _share(text: str) -> float:
    """Return a percentage as a share."""
    try:
        return float(text.strip().removesuffix("%")) / 100.0
    except ValueError:
        raise Refusal(f"--std {text}: write percent, as 10%") from None


def unused(values: Mapping[str, object]) -> None:
    """Refuse options of a test that is run beside ``--measured``; by what was given."""
    for option, value in values.items():
        if value:
            raise Refusal(f"{option} has no use beside --measured, which runs tests of its own: leave it out")
