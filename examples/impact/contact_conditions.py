"""Modes of the 7003C whose balls stick or slide (C1 to C4), and what chance makes of matches with peaks.

The modal analysis of Kuan, Chen, Shen and Chang (2026), sections 3.2, 4.3 and 4.4.2: twelve silicon nitride
balls between rings of 52100 steel, bonded or sliding without separation, the outer circumference held or
free. Patches have one radius, which the paper's mesh decides and its text does not give; it is varied here.
Writes

* ``contact_conditions.md`` and ``contact_conditions.csv`` - frequencies, what moves, matches and chance;
* ``contact_conditions.png`` - all of it on one axis, beside the paper's peaks.

Usage: python examples/impact/contact_conditions.py [--output-dir out] [--short]
"""

import datetime
import itertools
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import numpy as np
import typer
from numpy.typing import NDArray

from examples.papers.assembly.basis import ring_basis, wall_limit
from examples.papers.assembly.conditions import BONDED, Condition, ContactModes, bodies, contact_modes
from examples.papers.assembly.free import free_modes
from examples.papers.assembly.patch import normal_stiffness
from examples.papers.chance import best_of, chance
from examples.papers.impact.chain import Sphere
from examples.papers.impact.lamb import spheroidal_frequencies, torsional_frequencies
from examples.papers.impact.row import row_modes
from fmu_bearing import Scene, read_scene
from fmu_bearing.cli.base import refusals
from fmu_bearing.elastic.modes import elastic
from fmu_bearing.elastic.section import INNER, OUTER, RACES, ring_section
from fmu_bearing.extras import need
from fmu_bearing.results.picture_parts import empty
from fmu_bearing.results.table import machine, markdown, show, write_csv
from fmu_bearing.scene import si

Array = NDArray[np.float64]

SCENE = Path(__file__).parents[1] / "scenes" / "7003C-impact.toml"
PATCH = 0.233e-3  # m: k_n = 6.3e7 N/m
#: Patches of matches, m: from half to twice, in steps that move the modes by a match's width of 2 %.
PATCHES = PATCH * 2.0 ** np.linspace(-1.0, 1.0, 21)
SPRINGS = 2.5e7  # N/m between balls: the paper's final choice
TOP = 60e3  # Hz: tables of modes end here
#: Peaks of the sound, kHz, as section 4.4.2 prints them; 9.7 and 9.9 are one peak.
PEAKS = (9.8, 11.8, 12.6, 20.0, 22.5, 29.4, 33.2, 46.0, 67.6)
TOLERANCE = 0.02
RANGE = (9.5e3, 70e3)  # Hz: in which those peaks lie
EDGES = ((9.5e3, 70e3), (8e3, 80e3), (5e3, 70e3), (5e3, 100e3))  # Hz
LIMITS = (150e3, 300e3, 450e3, 600e3, 800e3)  # Hz: where ring modes may end
BALL = Sphere(radius=11.1e-3, density=7900.0, modulus=195e9, poisson=0.3)  # of the three-ball test
ROW_PATCH = 0.2e-3  # m
LOOSE = 1e-18  # m: a patch whose springs are nothing beside those between the balls
#: What the paper states of its modes and peaks, beside what they can be.
CONTRADICTIONS = (
    "A held circumference leaves the outer ring no mode below {held:.0f} kHz. The peak at 54.0 kHz, which "
    "the paper gives to an outer ring mode, is near one of a free ring ({near:.1f} kHz).",
    "First modes of the steel ball: 111.36 and 117.71 kHz in the paper; exact: {twist:.2f} and "
    "{stretch:.2f}. Its mesh makes them {twist_error:.1f} and {stretch_error:.1f} % high.",
    "Responses at 50 to 110 kHz are called similar for springs of 1e5 to 2.5e7 N/m. The balls' chain on "
    "these springs goes with the root of the stiffness: its highest mode lies at {soft:.1f} to {hard:.1f} "
    "kHz.",
    "All peaks from 54.0 to 425.9 kHz are said to match modes of C1 to C4. Bands of 2 % about these modes, "
    "held, cover {covered:.0f} % of that range, so that most peaks match wherever they are.",
    "C4 is a ball joint: the inner ring tilts in two directions and spins without resistance, and each ball "
    "has five motions so. A held bearing then has {zero} motions of 0 Hz.",
    "C1 resists tilt only because a patch of finite size hinders rolling: patches of {patches} mm give "
    "{tilts} kHz. The text gives no patch.",
)


@dataclass(frozen=True)
class Case:
    """One assembly."""

    condition: Condition
    held: bool
    patch: float = PATCH
    springs: float = 0.0

    @property
    def name(self) -> str:
        """Short name in tables."""
        return f"{self.condition} {'held' if self.held else 'free'}"


ALL = [Case(condition, held) for held in (True, False) for condition in BONDED]


def solved(scene: Scene, case: Case, highest: float | None = None) -> ContactModes:
    """Return the modes of a case."""
    return contact_modes(
        scene, case.condition, case.patch, held=case.held, ball_springs=case.springs, highest=highest
    )


def above(modes: ContactModes) -> Array:
    """Frequencies (Hz) that are not 0."""
    return modes.frequencies[modes.zero_modes :]


def components(scene: Scene) -> dict[str, Array]:
    """Frequencies (Hz) below 100 kHz of the free rings; balls have none there."""
    found = {}
    for body, material in ((INNER, scene.materials.inner_ring), (OUTER, scene.materials.outer_ring)):
        modes = free_modes(ring_section(scene, body), elastic(material), 100e3)
        found[f"{RACES[body]} ring, free"] = np.array([mode.frequency for mode in modes if mode.frequency])
    return found


def modes_table(found: dict[Case, ContactModes]) -> tuple[list[str], list[list[str]]]:
    """Lines of all cases up to `TOP`."""
    rows = []
    for case, modes in found.items():
        for line in modes.lines(TOP):
            shares = ", ".join(f"{part} {100 * share:.0f} %" for part, share in list(line.shares.items())[:2])
            by_body = bodies(line)
            rows.append([
                case.name, f"{line.frequency / 1e3:.3f}", str(line.number),
                *(f"{100 * by_body[key]:.0f}" for key in ("inner ring", "outer ring", "balls")), shares,
            ])  # fmt: skip
    return ["condition", "kHz", "modes", "inner ring, %", "outer ring, %", "balls, %", "what moves"], rows


def short_table(found: dict[Case, ContactModes]) -> tuple[list[str], list[list[str]]]:
    """One row for each case: zero modes, and lines up to `TOP`; many neighbours in brackets."""
    rows = []
    for case, modes in found.items():
        cells = [
            f"{line.frequency / 1e3:.2f}" + (f" x{line.number}" if line.number > 1 else "")
            for line in modes.lines(TOP)
        ]
        rows.append([case.name, str(modes.zero_modes), ", ".join(cells)])
    return ["condition", "zero modes", "kHz"], rows


def varied(scene: Scene, short: bool) -> tuple[list[str], list[list[str]]]:
    """C1 and C4, held: how the patch and the end of the ring modes move the first lines."""
    rows = []
    patches = [(f"patch {1e3 * a:.3f} mm", a, None) for a in (PATCH / 2, PATCH / 2**0.5, PATCH, PATCH * 2)]
    limits = [(f"ring modes to {highest / 1e3:.0f} kHz", PATCH, highest) for highest in (0.0, *LIMITS)]
    for name, patch, highest in patches[2:3] if short else patches + limits:
        cells = []
        for condition, count in (("C1", 4), ("C4", 3)):
            lines = solved(scene, Case(condition, True, patch), highest).lines(80e3)
            lines = [line for line in lines if "balls turning" not in next(iter(line.shares))]
            cells += [f"{line.frequency / 1e3:.2f}" for line in lines[:count]]
            cells += [""] * (count - len(lines[:count]))
        rows.append([name.replace(" to 0 kHz", ": none"), *cells])
    heads = ["", "C1 tilt", "C1 spin", "C1 axial", "C1 radial", "C4 axial", "C4 radial", "C4 third"]
    return heads, rows


def matched(found: dict[str, Array]) -> tuple[list[str], list[list[str]]]:
    """Return matches of the paper's peaks with each set of modes."""
    rows = []
    for name, modes in found.items():
        r = chance(1e3 * np.array(PEAKS), modes, TOLERANCE, *RANGE)
        cells = f"{100 * r.coverage:.0f}", f"{r.expected:.1f}", f"{r.probability:.2f}"
        rows.append([name, f"{r.matches} of {r.peaks}", *cells])
    return ["modes", "matches", "covered, %", "expected by chance", "p"], rows


def sets(found: dict[Case, ContactModes], parts: dict[str, Array]) -> dict[str, Array]:
    """Return the sets of modes that a peak may be matched with, by name."""
    by_case = {case.name: above(modes) for case, modes in found.items()}
    return (
        parts
        | by_case
        | {
            f"C1 to C4, {word}": np.concatenate([f for name, f in by_case.items() if word in name])
            for word in ("held", "free")
        }
        | {
            f"C1 to C4, {word}, and free rings": np.concatenate(
                [*parts.values(), *(f for name, f in by_case.items() if word in name)]
            )
            for word in ("held", "free")
        }
    )


def nearest(found: dict[str, Array]) -> tuple[list[str], list[list[str]]]:
    """Each peak beside the nearest mode of each set: its distance in %."""
    names = [name for name in found if not name.startswith("C1 to")]
    rows = []
    for peak in PEAKS:
        cells = []
        for name in names:
            off = 100.0 * (peak * 1e3 / found[name] - 1.0)
            best = off[np.abs(off).argmin()]
            cells.append(f"**{best:+.1f}**" if abs(best) <= 100 * TOLERANCE else f"{best:+.1f}")
        rows.append([f"{peak:g}", *cells])
    return ["peak, kHz", *names], rows


def chosen(scene: Scene, parts: dict[str, Array]) -> tuple[list[str], list[list[str]]]:
    """Best choice of condition, circumference, components and patch, beside chance's own best choice."""
    choices: dict[str, Array] = {}
    for patch, springs in itertools.product(PATCHES, (0.0, SPRINGS)):
        found = {case: solved(scene, Case(case.condition, case.held, patch, springs)) for case in ALL}
        for name, modes in sets(found, parts).items():
            with_choice = f"{name}, patch {1e3 * patch:.3f} mm, springs {springs:.1e} N/m"
            choices[name if name in parts else with_choice] = modes
    rows = []
    for limits in EDGES:
        names = list(choices)
        peaks = 1e3 * np.array(PEAKS)
        best, probability = best_of(peaks, list(choices.values()), TOLERANCE, *limits)
        alone = chance(peaks, choices[names[best]], TOLERANCE, *limits)
        rows.append([
            f"{limits[0] / 1e3:g} to {limits[1] / 1e3:g}", names[best], f"{alone.matches} of {alone.peaks}",
            f"{alone.probability:.3f}", f"{probability:.2f}",
        ])  # fmt: skip
    return ["range, kHz", f"best of {len(choices)} choices", "matches", "p alone", "p with choice"], rows


def chain_table(scene: Scene) -> tuple[list[str], list[list[str]]]:
    """Balls alone on the springs between them: closed form, and the assembly without its contacts."""
    balls = scene.bearing.ball_count
    mass = si(scene.materials.balls).density * np.pi / 6.0 * si(scene.bearing).ball_diameter ** 3
    half, waves = np.pi / balls, range(balls // 2 + 1)
    form = [np.hypot(np.cos(half) * np.sin(j * half), np.sin(half) * np.cos(j * half)) for j in waves]
    rows = []
    for k in (1e5, 5e6, SPRINGS):
        modes = above(contact_modes(scene, "C4", LOOSE, held=False, ball_springs=k, highest=0.0))
        exact = np.sqrt(k / mass) / np.pi * np.array(form)
        off = max(float(np.abs(modes / f - 1.0).min()) for f in exact)
        rows.append(
            [f"{k:g}", *(f"{f / 1e3:.2f}" for f in exact), f"{off:.0e}" if off > 1e-9 else "below 1e-9"]
        )
    return ["springs, N/m", *(f"j = {j}" for j in waves), "the assembly differs by"], rows


def row_table() -> tuple[list[str], list[list[str]]]:
    """Three balls of the impact test, stuck or sliding."""
    rows = []
    for name, bonded, highest in (
        ("no separation, rigid", False, 0.0), ("bonded, rigid", True, 0.0),
        ("either, modes to 125 kHz", True, 125e3), ("either, modes to 250 kHz", True, 250e3),
        ("either, modes to 500 kHz", True, 500e3),
    ):  # fmt: skip
        found = row_modes([BALL] * 3, ROW_PATCH, bonded=bonded, highest=highest)

        def listed(values: Iterable[float]) -> str:
            return ", ".join(f"{f:.0f}" for f in values if f > 0.0) or "0"

        axial = ", ".join(f"{f / 1e3:.3f}" for f in found.axial[1:3])
        rigid = [listed(found.twist), listed(found.transverse), str(found.zero_modes)]
        rows.append([name, axial, *(["", "", ""] if highest else rigid)])
    return [
        "three balls",
        "along, kHz",
        "turning about the row, Hz",
        "n = 1 (each twice), Hz",
        "zero modes",
    ], rows


def contradictions(scene: Scene, parts: dict[str, Array]) -> list[str]:
    """Sentences with their figures."""
    outer = ring_section(scene, OUTER), elastic(scene.materials.outer_ring)
    twist, stretch = torsional_frequencies(BALL, 2)[0] / 1e3, spheroidal_frequencies(BALL, 2)[0] / 1e3
    free = parts["outer ring, free"]
    chains = [float(row[-2]) for row in chain_table(scene)[1]]
    patches = (PATCH / 2.0, PATCH, 2.0 * PATCH)
    tilts = [solved(scene, Case("C1", True, patch)).lines(30e3)[0].frequency / 1e3 for patch in patches]
    stuck = np.concatenate([above(solved(scene, Case(c, True, springs=SPRINGS))) for c in BONDED])
    figures = {
        "held": ring_basis(*outer, held=True).frequency.min() / 1e3,
        "near": free[np.abs(free - 54e3).argmin()] / 1e3,
        "twist": twist, "stretch": stretch,
        "twist_error": 100 * (111.36 / twist - 1), "stretch_error": 100 * (117.71 / stretch - 1),
        "soft": chains[0], "hard": chains[-1],
        "zero": solved(scene, Case("C4", True)).zero_modes,
        "patches": " / ".join(f"{1e3 * patch:.3f}" for patch in patches),
        "tilts": " / ".join(f"{f:.2f}" for f in tilts),
        "covered": 100 * chance([1e5], stuck, TOLERANCE, 54e3, 425.9e3).coverage,
    }  # fmt: skip
    return [line.format(**figures) for line in CONTRADICTIONS]


def draw(path: Path, found: dict[Case, ContactModes], parts: dict[str, Array]) -> None:
    """All modes on one logarithmic axis, coloured by what moves, and the paper's peaks."""
    figure = empty((10.0, 4.6))
    axes = figure.subplots()
    colors = {"inner ring": "#0072B2", "outer ring": "#D55E00", "balls": "#009E73"}
    names = []
    for case, modes in found.items():
        for line in modes.lines(80e3):
            by_body = bodies(line)
            color = colors[max(by_body, key=lambda key: by_body[key])]
            axes.vlines(
                line.frequency / 1e3, len(names) - 0.38, len(names) + 0.38, color=color, linewidth=1.4
            )
        names.append(case.name)
    for name, modes in parts.items():
        color = colors[name.split(",")[0]]
        axes.vlines(
            modes[modes < 80e3] / 1e3, len(names) - 0.38, len(names) + 0.38, color=color, linewidth=1.4
        )
        names.append(name)
    for peak in PEAKS:
        low, high = peak * (1.0 - TOLERANCE), peak * (1.0 + TOLERANCE)
        axes.axvspan(low, high, color="0.82", linewidth=0.0, zorder=0)
    for name, color in colors.items():
        axes.plot([], [], color=color, label=name)
    axes.fill_between([], [], color="0.82", label="the paper's peaks, +-2 %")
    axes.set(xscale="log", xlim=(2.0, 80.0), ylim=(len(names) - 0.4, -0.6), xlabel="frequency [kHz]")
    ticks = (2, 3, 5, 7, 10, 15, 20, 30, 40, 50, 70)
    axes.set_xticks(ticks, [f"{tick}" for tick in ticks])
    axes.minorticks_off()
    axes.set_yticks(range(len(names)), names)
    axes.set_title(f"What moves, patches of {1e3 * PATCH:g} mm", loc="left")
    axes.legend(fontsize=8, frameon=False, ncols=4, loc="lower right", bbox_to_anchor=(1.0, 1.0))
    figure.savefig(path, dpi=90, metadata={"Software": None})


def main(
    output_dir: Annotated[Path, typer.Option(help="Folder for the tables.")] = Path("out"),
    picture: Annotated[Path | None, typer.Option(help="PNG; by default beside the tables.")] = None,
    short: Annotated[bool, typer.Option(help="One patch only.")] = False,
) -> None:
    """Compute all cases, print the lines, write tables and picture."""
    with refusals():  # before minutes of computing
        need("matplotlib", "the picture")
        need("skfem", "elastic rings")
    scene = read_scene(SCENE)
    found = {case: solved(scene, case) for case in ALL}
    parts = components(scene)
    every = sets(
        {case: solved(scene, Case(case.condition, case.held, springs=SPRINGS)) for case in ALL}, parts
    )
    materials = [elastic(scene.materials.inner_ring), elastic(scene.materials.outer_ring)]
    k = normal_stiffness(materials[INNER], elastic(scene.materials.balls), PATCH)
    ends = [wall_limit(ring_section(scene, body), materials[body]) / 1e3 for body in (INNER, OUTER)]
    title = "Modes of the 7003C under contact conditions C1 to C4"
    show(title, *short_table(found))
    heads, rows = modes_table(found)
    page = [
        f"# {title}",
        f"{machine()}; {datetime.datetime.now(datetime.UTC).date()}",
        f"Made by `examples/impact/contact_conditions.py`. Patches of {1e3 * PATCH:g} mm, k_n = {k:.3g} N/m; "
        f"ring modes up to {ends[0]:.0f} kHz (inner) and {ends[1]:.0f} kHz (outer), orders 0 to 12.",
        "## Natural frequencies", markdown(*short_table(found)),
        "## What moves, C1 and C4 (all: `contact_conditions.csv`)",
        markdown(heads, [row for row in rows if row[0][:2] in ("C1", "C4")]),
        "## What the patch and the ring modes decide", markdown(*varied(scene, short)),
        "## Springs between the balls, kHz", markdown(*chain_table(scene)),
        "## Three balls in a row", markdown(*row_table()),
        f"## The paper's peaks beside the nearest mode, with springs of {SPRINGS:.1e} N/m, %",
        markdown(*nearest(every)),
        f"## Matches within 2 %, {RANGE[0] / 1e3:g} to {RANGE[1] / 1e3:g} kHz", markdown(*matched(every)),
        *([] if short else ["## Matches with free choice", markdown(*chosen(scene, parts))]),
        "## Contradictions", "\n".join(f"* {line}" for line in contradictions(scene, parts)),
    ]  # fmt: skip
    output_dir.mkdir(parents=True, exist_ok=True)
    text = "\n\n".join(part.rstrip("\n") for part in page) + "\n"
    (output_dir / "contact_conditions.md").write_text(text, encoding="utf-8")
    write_csv(output_dir / "contact_conditions.csv", heads, rows)
    picture = output_dir / "contact_conditions.png" if picture is None else picture
    draw(picture, found, parts)
    typer.echo(f"wrote contact_conditions.md and contact_conditions.csv in {output_dir}, and {picture}")


if __name__ == "__main__":
    typer.run(main)
