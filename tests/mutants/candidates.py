"""Which tests may kill a mutant: files that import its module or are of its room, the cheapest first."""

import ast
import functools
import re
from pathlib import Path

from tests.mutants.entries import ROOT, Mutant
from tests.order import read

#: Tests of pages, of the source's form, of other programs, of the clock, of this list: no mutant is for them.
OTHERS = re.compile(
    r"tests/(mutants|native|interop|compiled|scenes|examples/papers)/|"
    r"test_(docs|readme|learn|page_figures|paper|architecture|structure|maps|recipes|citation|contributing|"
    r"order|oracles|release|files|children|skips|benchmarks|digests|notebooks|gallery|questions|page|pages|"
    r"package|paces|every_result|one_voice|folder_endings|progress|interrupted)\.py"
)
#: Folders and files of tests by room of the engine, where they are not called like it.
ROOMS = {
    "engine/spindle": ("tests/spindle/",),
    "engine/sound": ("tests/acoustics/", "tests/engine/test_response_sound.py"),
    "engine/fidelities/response": (
        "tests/engine/test_response", "tests/engine/test_lines.py", "tests/engine/test_drift.py",
        "tests/engine/test_renewal.py", "tests/engine/test_flexure_lines.py", "tests/engine/test_shift.py",
        "tests/spindle/test_response.py", "tests/acoustics/test_lines.py",
    ),
    "engine/fidelities/rings": (
        "tests/engine/test_rings.py", "tests/engine/test_predictor.py", "tests/spindle/test_rings.py",
    ),
    "engine/fidelities/full": (
        "tests/engine/test_numerics.py", "tests/engine/test_stages.py", "tests/engine/test_impacts.py",
        "tests/engine/test_fidelities.py", "tests/engine/test_start.py",
    ),
    "engine/steady": (
        "tests/engine/test_steady", "tests/engine/test_growth.py", "tests/engine/test_patterns.py",
    ),
    "engine/mechanics": (
        "tests/engine/test_right_hand_side.py", "tests/engine/test_traction.py", "tests/engine/test_inlet.py",
        "tests/engine/test_contact.py", "tests/engine/test_numerics.py", "tests/engine/test_balances.py",
        "tests/engine/test_viscosity.py", "tests/engine/test_fits.py",
        "tests/formulas/test_friction_oracles.py", "tests/extremes/test_cage.py",
    ),
    "engine/statics": (
        "tests/engine/test_quasistatic.py", "tests/engine/test_held.py", "tests/engine/test_start.py",
        "tests/spindle/test_rest.py", "tests/scene/test_set_preload.py",
    ),
    "engine": ("tests/engine/",),
    "design/fit": ("tests/design/test_fit", "tests/cli/test_fits.py", "tests/design/test_fresh.py"),
    "design/torque": ("tests/design/test_torque_range.py", "tests/design/test_grease.py"),
    "design/heat": ("tests/design/test_heat.py", "tests/design/test_temperatures.py"),
    "acoustics/filters/bearings": ("tests/spindle/test_housing_sound.py", "tests/spindle/test_sound.py"),
    "acoustics/filters": ("tests/acoustics/test_shares.py", "tests/acoustics/test_blocks.py"),
    "prepare/contacts": (
        "tests/engine/test_traction.py", "tests/formulas/test_friction_oracles.py", "tests/prepare/",
        "tests/engine/test_contact.py", "tests/engine/test_fidelities.py",
    ),
    "steady/stiffness": (
        "tests/modal/test_stiffness.py", "tests/design/test_set_stiffness.py", "tests/modal/test_static.py",
        "tests/cli/test_set_stiffness.py", "tests/cli/test_stiffness.py",
    ),
    "results/rates": (
        "tests/results/test_rates.py", "tests/run/test_figures.py", "tests/recording/test_places.py",
    ),
    "formulas": ("tests/formulas/", "tests/design/"),
    "prepare": ("tests/prepare/", "tests/engine/test_fits.py"),
    "steady": ("tests/design/test_set", "tests/modal/", "tests/spindle/"),
    "recording/channels": ("tests/recording/",),
    "fmi": ("tests/fmi/",),
    "run": ("tests/run/", "tests/cli/test_realtime.py"),
    "metrology": ("tests/metrology/", "tests/cli/test_error_motion.py"),
    "vibration_test": ("tests/vibration_test/", "tests/cli/test_vibration.py", "tests/cli/test_inverse.py"),
}  # fmt: skip
#: What compares the whole, for mutants of the engine that live.
WHOLE = (
    "tests/test_set_of_one.py",
    "tests/spindle/test_dynamics_oracle.py",
    "tests/engine/test_quick_gates.py",
)


@functools.cache
def _texts() -> dict[str, str]:
    found = {}
    for path in sorted((ROOT / "tests").rglob("test_*.py")):
        name = path.relative_to(ROOT).as_posix()
        if not OTHERS.search(name):
            found[name] = path.read_text("utf-8")
    return found


@functools.cache
def _seconds() -> dict[str, float]:
    return read(ROOT / "tests" / "times" / "quick.txt")


def function_of(one: Mutant) -> str:
    """Name of the outermost function or class that the mutant changes; empty outside of them."""
    source = (ROOT / one.file).read_text("utf-8")
    line = source[: source.index(one.old) + len(one.old)].count("\n") + 1
    for node in ast.parse(source).body:
        if isinstance(node, ast.FunctionDef | ast.ClassDef) and node.lineno <= line <= (node.end_lineno or 0):
            return node.name
    return ""


def candidates(one: Mutant, seconds: float, most: int) -> list[str]:
    """Files of tests in the order in which they are tried, ``most`` and for the engine the ones of the whole.

    Those that take longer than ``seconds`` are left out; near the module two and a half times as long may do.
    """
    inside = Path(one.file).relative_to("fmu_bearing").with_suffix("")
    module, room = inside.as_posix().replace("/", "."), inside.parent.as_posix()
    near = next(
        (ROOMS[name] for name in sorted(ROOMS, key=len)[::-1] if inside.as_posix().startswith(name)), ()
    )
    function = function_of(one)
    package = module.rpartition(".")[0] or module
    imports = re.compile(
        rf"fmu_bearing\.{re.escape(module)}\b|"
        rf"from fmu_bearing\.{re.escape(package)} import [^#]*\b{inside.name}\b"
    )
    found = []
    for name, text in _texts().items():
        score = 4 * bool(imports.search(text))
        score += 3 * bool(function and re.search(rf"\b{function}\b", text))
        score += 3 * name.startswith(near) if near else 2 * name.startswith(f"tests/{room.split('/')[0]}/")
        score += name.startswith(f"tests/{room.split('/')[0]}/")
        cost = _seconds().get(name, 1.0)
        if name.startswith("tests/reports/"):
            cost = 20.0
        if score and cost <= (2.5 if score >= 3 else 1.0) * seconds:
            found.append((score < 3, -(score + 2) / (cost + 4.0), name))
    found.sort()
    names = [name for *_, name in found[:most]]
    return names + [name for name in WHOLE if one.engine and name not in names]
