"""Places in the flat arrays have names: no kernel counts them by hand, and no two areas in use share one."""

import ast
import functools
import itertools
import pathlib
import textwrap

import pytest

from fmu_bearing.engine.layout import T, W

ENGINE = pathlib.Path(__file__).parents[1] / "fmu_bearing" / "engine"
#: Files with kernels: not those that name the places, compile, or hash sources.
FILES = sorted(
    path
    for path in ENGINE.rglob("*.py")
    if path.parent.name != "layout" and path.name not in ("__main__.py", "jit.py", "sources.py")
)
LAYOUT = set("A C EQ F FL H J K L LN MO P PT Q R S SD SL SP ST T TAB U W X Y Z".split())
LARGEST = 2  # 0, 1, 2 are components of a vector, neighbours, pairs
#: Functions whose numbers are not places of an array, with the reason.
FREE = {
    "times": "twelve sums by name stay in registers; groups of four take 5 % longer",
    "sort_lines": "gaps of Shell's method, each three times the one before",
    "by_families": "a vector of each of two families",
    "find_away": "a vector of each of two families",
    "prepare_step": "five moments of one step's polynomial",
}


@functools.cache
def parsed(path):
    """Syntax tree of a file."""
    return ast.parse(path.read_text(encoding="utf-8"))


def functions(path):
    """Functions of a file, methods and inner ones included."""
    return [node for node in ast.walk(parsed(path)) if isinstance(node, ast.FunctionDef)]


def short(path):
    """Name of a file within the package."""
    return path.relative_to(ENGINE.parents[1]).as_posix().removeprefix("fmu_bearing/")


def literals(node):
    """Integer literals above `LARGEST` in an index, not within its calls, comparisons and own indices."""
    if isinstance(node, ast.Constant):
        return [node] if type(node.value) is int and node.value > LARGEST else []
    if isinstance(node, ast.Subscript | ast.Call | ast.Compare):
        return []
    return [found for child in ast.iter_child_nodes(node) for found in literals(child)]


def names(node):
    """Names that an index is made of."""
    return {one.id for one in ast.walk(node) if isinstance(one, ast.Name)}


def indices(function):
    """Every index in a function; bounds of slices count."""
    for node in ast.walk(function):
        if isinstance(node, ast.Subscript):
            part = node.slice
            yield from (
                one for one in ([part.lower, part.upper] if isinstance(part, ast.Slice) else [part]) if one
            )


def counted(function):
    """Literals that are places, or added to one: in an index, in what it is made of, beside a named place."""
    found = [one for index in indices(function) for one in literals(index)]
    used = set().union(*(names(index) for index in indices(function)))
    for node in ast.walk(function):
        if isinstance(node, ast.Assign | ast.AugAssign):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            if any(isinstance(one, ast.Name) and one.id in used for one in targets):
                found += literals(node.value)
        elif isinstance(node, ast.BinOp):
            places = [one for one in ast.walk(node) if isinstance(one, ast.Attribute) and names(one) & LAYOUT]
            if places:
                found += literals(node)
    return found


#: Kernels outside the engine, and what lays parameters and names out.
OTHERS = [
    ENGINE.parents[1] / "benchmarks" / "first_order.py",
    *(
        ENGINE.parent / name
        for name in (
            "accuracy/reference.py",
            "interface/bearing_outputs.py",
            "interface/inputs.py",
            "interface/microphones.py",
            "interface/outputs.py",
            "instance.py",
        )
    ),
]


@pytest.mark.lint
def test_no_place_is_counted_by_hand():
    lines = {
        f"{short(path)}:{one.lineno} {function.name}: {one.value}"
        for path in (*FILES, *OTHERS)
        for function in functions(path)
        if function.name not in FREE
        for one in counted(function)
    }
    assert not lines


@pytest.mark.lint
def test_no_star_imports():
    imports = [
        (path, node) for path in FILES for node in ast.walk(parsed(path)) if isinstance(node, ast.ImportFrom)
    ]
    assert not [
        f"{short(path)}:{node.lineno}" for path, node in imports if any(one.name == "*" for one in node.names)
    ]


def copies(tree):
    """Lines that assign to a slice: ``x[a:b] = y``, ``x[:] += 1.0``.

    Compiled ahead of time, a slice from a slice allocates a copy in case both overlap, and raises where sizes
    differ; called by itself, a kernel does so without a word. Slices of one number are refused with them.
    """
    for node in ast.walk(tree):
        targets = node.targets if isinstance(node, ast.Assign) else [getattr(node, "target", None)]
        for target in targets:
            for one in [] if target is None else ast.walk(target):
                if isinstance(one, ast.Subscript) and isinstance(one.ctx, ast.Store):
                    part = one.slice
                    if any(isinstance(axis, ast.Slice) for axis in getattr(part, "elts", [part])):
                        yield one.lineno


@pytest.mark.lint
def test_kernels_copy_number_by_number():
    kernels = [
        (path, one)
        for path in FILES
        for one in functions(path)
        if any(getattr(d, "id", "") == "kernel" for d in one.decorator_list)
    ]
    assert len(kernels) > 100  # the decorator's name is right
    assert not [f"{short(path)}:{line} {kernel.name}" for path, kernel in kernels for line in copies(kernel)]


def test_copies_of_slices_are_found():
    sample = """
    def kernel(x, y, n):
        x[0] = y[1]
        part = x[2:n]
        x[2:n] = y[0:n]
        x[:] = 0.0
        x[1:] += y[1:]
        x[0, :], z = y[0], 1.0
        x[y[0]] = sum(y[1:])
    """
    assert list(copies(ast.parse(textwrap.dedent(sample)))) == [5, 6, 7, 8]


def test_the_engine_is_no_list_of_imports():
    """Import lines, continued ones too, are under 5.5 % of the engine's lines."""
    lines = imports = 0
    for path in ENGINE.rglob("*.py"):
        text = path.read_text(encoding="utf-8")
        lines += len(text.splitlines())
        imports += sum(
            node.end_lineno - node.lineno + 1
            for node in ast.parse(text).body
            if isinstance(node, ast.Import | ast.ImportFrom)
        )
    assert imports < 0.055 * lines, f"{imports} of {lines}"


def test_areas_in_use_together_share_no_place():
    for one, other in itertools.combinations(W.LEDGER + T.LEDGER, 2):
        if one.uses & other.uses:
            apart = one.first + one.size <= other.first or other.first + other.size <= one.first
            assert apart, f"{one.name} and {other.name} overlap in {sorted(one.uses & other.uses)}"
