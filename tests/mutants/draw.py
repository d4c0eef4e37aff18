"""Mutants drawn by a seed: one operator at one place of a source, over all lines of a room's modules.

``python -m tests.mutants.draw ROOM COUNT`` prints entries for the list. An operator is drawn first, then one
of its places, so that rare operators are drawn as often as common ones.
"""

import ast
import random
import sys
from pathlib import Path

from tests.mutants.entries import ROOT, Mutant, text_of

SEED = 57
PACKAGE = "fmu_bearing"
#: Modules by room; a folder counts with all below it.
ROOMS = {
    "fits": ("formulas/fits.py", "formulas/tolerances.py", "prepare/fits.py", "design/fits.py",
             "design/fit_curves.py", "design/fit_table.py", "design/fit_verdicts.py"),
    "friction": ("engine/mechanics/inlet.py", "engine/mechanics/traction.py",
                 "engine/mechanics/conditions.py", "engine/newton/traction_slopes.py",
                 "engine/mechanics/cage.py", "engine/readout/losses.py", "design/torque_range.py",
                 "design/heat.py"),
    "metrology": ("metrology",),
    "vibration_test": ("vibration_test",),
    "realtime": ("run/realtime.py", "run/step_times.py", "run/paces.py", "results/rates.py"),
    "statics_of_sets": ("steady", "engine/spindle/rest.py", "engine/spindle/steady.py",
                        "engine/statics/mounted.py", "engine/statics/rigid_preload.py", "engine/steady"),
    "engine": ("engine/mechanics", "engine/newton", "engine/fidelities/full", "engine/fidelities/rings",
               "engine/fidelities/response", "engine/spindle", "engine/readout", "engine/statics"),
    "sound": ("acoustics/filters", "acoustics/radiation", "acoustics/analysis", "engine/sound"),
    "formulas": ("formulas", "prepare", "elastic"),
    "files": ("files.py", "recording/recording.py", "recording/channels", "results/series.py",
              "results/levels.py", "fmi/state.py", "fmi/units.py", "run/input_file.py",
              "acoustics/radiation/table.py", "acoustics/analysis/audio.py"),
}  # fmt: skip
#: Classes that are drawn with signs, factors and exponents alone.
PLAIN = ("engine", "sound", "formulas", "files")
_DRAWING = ("picture", "plot", "drawing")  # in names of modules whose numbers are inks and places on paper
#: Names that kernels give to places.
_PLACES = ("at", "row", "first", "column", "place", "to", "last", "other", "held", "numbers", "half", "p",
           "d", "h", "begin", "end", "own", "size", "count", "lanes", "n")  # fmt: skip
_SWAPPED = {
    ast.Add: ("sign", " - "), ast.Sub: ("sign", " + "),
    ast.Mult: ("factor", " / "), ast.Div: ("factor", " * "),
}  # fmt: skip
_BOUNDARY = {ast.Lt: "<=", ast.LtE: "<", ast.Gt: ">=", ast.GtE: ">"}
_REVERSED = {ast.Lt: ">", ast.LtE: ">=", ast.Gt: "<", ast.GtE: "<=", ast.Eq: "!=", ast.NotEq: "=="}


def _offsets(source: str) -> list[int]:
    """Where each line begins."""
    found = [0]
    for line in source.splitlines(keepends=True):
        found.append(found[-1] + len(line))
    return found


def _counts(node: ast.AST) -> bool:
    """Whether an expression or statement computes a place in an array: as a mutant it crashes."""
    if isinstance(node, ast.Call):
        return isinstance(node.func, ast.Name) and node.func.id in ("range", "load", "store", "gather")
    if isinstance(node, ast.Assign):
        names = [one.id for one in ast.walk(node.targets[0]) if isinstance(one, ast.Name)]
        return any(name in _PLACES for name in names) and isinstance(node.targets[0], ast.Name)
    if not isinstance(node, ast.BinOp):
        return False
    due, plain = [node], []
    while due:
        one = due.pop()
        plain.append(one)
        due += [part for part in ast.iter_child_nodes(one) if not isinstance(one, ast.Subscript)]
    attributes = [one.attr for one in plain if isinstance(one, ast.Attribute)]
    texts = [one for one in plain if isinstance(one, ast.Constant) and isinstance(one.value, str | bytes)]
    texts += [one for one in plain if getattr(one, "id", getattr(one, "attr", "")) in ("name", "prefix")]
    lists = [one for one in plain if isinstance(one, ast.List | ast.Tuple)]
    return bool(texts or lists) or any(name.isupper() for name in attributes)


def places(source: str) -> list[tuple[str, int, int, str]]:
    """All mutations of a source: operator, begin and end of the text, what comes in its place."""
    lines, found = _offsets(source), []

    def span(node):
        return lines[node.lineno - 1] + node.col_offset, lines[node.end_lineno - 1] + node.end_col_offset

    def between(left, right, signs, new, kind):
        begin, end = span(left)[1], span(right)[0]
        gap = source[begin:end]
        for sign in signs:
            if gap.count(sign) == 1 and "\n" not in gap and "#" not in gap:
                at = begin + gap.index(sign)
                found.append((kind, at, at + len(sign), new))
                return

    def visit(node, numbers=True):
        if isinstance(node, ast.JoinedStr):
            return
        numbers = numbers and not _counts(node)
        if isinstance(node, ast.BinOp) and numbers:
            if type(node.op) in _SWAPPED and not isinstance(node.left, ast.Constant | ast.JoinedStr) | (
                isinstance(node.left, ast.Constant) and isinstance(node.left.value, str)
            ):
                kind, new = _SWAPPED[type(node.op)]
                sign = {ast.Add: " + ", ast.Sub: " - ", ast.Mult: " * ", ast.Div: " / "}[type(node.op)]
                between(node.left, node.right, [sign], new, kind)
            if isinstance(node.op, ast.Pow) and isinstance(node.right, ast.Constant):
                begin, end = span(node.right)
                value = node.right.value
                found.append(("exponent", begin, end, repr(value + (1 if isinstance(value, int) else 0.1))))
        if (
            isinstance(node, ast.AugAssign)
            and type(node.op) in (ast.Add, ast.Sub)
            and not _counts(node.value)
        ):
            sign, new = ("+=", "-=") if isinstance(node.op, ast.Add) else ("-=", "+=")
            between(node.target, node.value, [sign], new, "sign")
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
            begin = span(node)[0]
            if not isinstance(node.operand, ast.Constant):
                found.append(("sign", begin, begin + 1, ""))
        if isinstance(node, ast.Constant) and isinstance(node.value, float) and node.value != 0.0:
            begin, end = span(node)
            found.append(("factor", begin, end, repr(float(f"{1.1 * node.value:.6g}"))))
        if isinstance(node, ast.Compare) and len(node.ops) == 1:
            op = type(node.ops[0])
            sign = {ast.Lt: " < ", ast.LtE: " <= ", ast.Gt: " > ", ast.GtE: " >= ", ast.Eq: " == ",
                    ast.NotEq: " != "}.get(op)  # fmt: skip
            if op in _BOUNDARY:
                between(node.left, node.comparators[0], [sign], f" {_BOUNDARY[op]} ", "boundary")
            if op in _REVERSED:
                between(node.left, node.comparators[0], [sign], f" {_REVERSED[op]} ", "comparison")
        if isinstance(node, ast.Subscript):
            one = node.slice
            if isinstance(one, ast.Constant) and isinstance(one.value, int):
                begin, end = span(one)
                found.append(("index", begin, end, "1" if one.value == 0 else "0"))
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in ("min", "max"):
            begin, end = span(node.func)
            found.append(("boundary", begin, end, "max" if node.func.id == "min" else "min"))
        for name, child in ast.iter_fields(node):
            if name in ("annotation", "returns"):
                continue
            inner = numbers and not (isinstance(node, ast.Subscript) and name == "slice")
            for one in child if isinstance(child, list) else [child]:
                if isinstance(one, ast.AST):
                    visit(one, inner)

    visit(ast.parse(source))
    return found


def files(room: str) -> list[str]:
    """Sources of a room, as paths from the root of the repository, in a fixed order."""
    found: list[Path] = []
    for name in ROOMS[room]:
        path = ROOT / PACKAGE / name
        found += sorted(path.rglob("*.py")) if path.is_dir() else [path]
    return [
        one.relative_to(ROOT).as_posix() for one in found if not any(word in one.name for word in _DRAWING)
    ]


def draw(room: str, count: int) -> list[Mutant]:
    """``count`` mutants of a room, the same each time for the same sources."""
    chance = random.Random(f"{SEED} {room}")
    known: dict[str, list[tuple[str, str, int, int, str]]] = {}
    for file in files(room):
        for kind, begin, end, new in places((ROOT / file).read_text("utf-8")):
            if room not in PLAIN or kind in ("sign", "factor", "exponent"):
                known.setdefault(kind, []).append((file, kind, begin, end, new))
    found: list[Mutant] = []
    while len(found) < count:
        kind = chance.choice(sorted(known))
        file, kind, begin, end, new = chance.choice(known[kind])
        source = (ROOT / file).read_text("utf-8")
        old_text, new_text = text_of(source, begin, end, new)
        try:
            ast.parse(source.replace(old_text, new_text))
        except SyntaxError:
            continue
        one = Mutant(f"{room}-{len(found) + 1:02d}", file, old_text, new_text, kind)
        if all(one.new != other.new for other in found):
            found.append(one)
    return found


if __name__ == "__main__":
    for one in draw(sys.argv[1], int(sys.argv[2])):
        print(one.to_toml())
