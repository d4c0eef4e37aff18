"""A copy of the engine that holds all its mutants, so that it is compiled once and not for each of them.

Where a mutant differs, a statement becomes ``if mutant(k): NEW else: OLD``, a condition becomes
``NEW if mutant(k) else OLD``, and a number of the module is chosen where it is read. ``mutant(k)`` compares
k with a number at a fixed address, which the package writes there when it is imported, from the variable
``FMU_BEARING_MUTANT``; 0 or nothing is the program as it is, with the same bits. (Untch, Offutt and Harrold
1993, mutation analysis using mutant schemata.)
"""

import ast
import copy
from pathlib import Path

from tests.mutants.entries import Mutant

ADDRESS = 0x1000_0000_0000  # far from where Linux puts programs, heaps, libraries and stacks
VARIABLE = "FMU_BEARING_MUTANT"
_ASKS = f'''"""Which mutant of the engine runs (tests/mutants)."""

from llvmlite import ir
from numba import types
from numba.core.typing.templates import AbstractTemplate, infer_global, signature
from numba.extending import lower_builtin


def mutant(number):
    """Whether the mutant of this number runs."""
    raise NotImplementedError


@infer_global(mutant)
class _Asks(AbstractTemplate):
    def generic(self, args, kws):
        return signature(types.boolean, types.int64)


@lower_builtin(mutant, types.Integer)
def _emit(context, builder, sig, args):
    word = ir.IntType(64)
    place = ir.Constant(word, {ADDRESS}).inttoptr(word.as_pointer())
    return builder.icmp_signed("==", builder.load(place), args[0])
'''
_SAYS = f'''"""Puts the number of the mutant where kernels read it (tests/mutants)."""

import ctypes
import os

_call = ctypes.CDLL(None, use_errno=True).mmap
_call.restype = ctypes.c_void_p
_call.argtypes = [ctypes.c_void_p, ctypes.c_size_t, *[ctypes.c_int] * 3, ctypes.c_long]
#: To be read and written; of this process alone, of no file, at this address and over nothing that is there.
_found = _call({ADDRESS}, 4096, 3, 0x02 | 0x20 | 0x100000, -1, 0)
if _found != {ADDRESS}:
    raise OSError(ctypes.get_errno(), "no page for the number of the mutant")
ctypes.c_int64.from_address({ADDRESS}).value = int(os.environ.get("{VARIABLE}") or 0)
'''
_ADDRESSED = "from fmu_bearing.compiled import optimise\n\noptimise.check = lambda module: None\n"


def _apart(one: ast.AST, other: ast.AST, path: tuple = ()) -> tuple:
    """Path to the innermost statement that holds all that differs, and the field if that is one alone."""
    differing = []
    for name, value in ast.iter_fields(one):
        theirs = getattr(other, name)
        if isinstance(value, list):
            if len(value) != len(theirs):
                return path, None
            pairs = [((name, k), a, b) for k, (a, b) in enumerate(zip(value, theirs, strict=True))]
        else:
            pairs = [((name, None), value, theirs)]
        for place, a, b in pairs:
            if isinstance(a, ast.AST) and isinstance(b, ast.AST):
                if ast.dump(a) != ast.dump(b):
                    differing.append((place, a, b))
            elif a != b:
                return path, None
    if len(differing) != 1:
        return path, None
    place, a, b = differing[0]
    if isinstance(a, ast.stmt) and isinstance(b, ast.stmt):
        return _apart(a, b, (*path, place))
    return path, place[0]


def _at(tree: ast.AST, path: tuple) -> ast.AST:
    for name, k in path:
        tree = getattr(tree, name) if k is None else getattr(tree, name)[k]
    return tree


def _asked(number: int) -> ast.expr:
    return ast.Call(ast.Name("mutant", ast.Load()), [ast.Constant(number)], [])


class _Numbers(ast.NodeTransformer):
    """Chooses a number of the module wherever one of its functions reads it."""

    def __init__(self, name: str, number: int, value: ast.expr) -> None:
        self.name, self.number, self.value, self.inside = name, number, value, 0

    def visit_FunctionDef(self, node: ast.FunctionDef) -> ast.AST:
        self.inside += 1
        self.generic_visit(node)
        self.inside -= 1
        return node

    def visit_Name(self, node: ast.Name) -> ast.AST:
        if node.id != self.name or not self.inside or not isinstance(node.ctx, ast.Load):
            return node
        return ast.IfExp(_asked(self.number), copy.deepcopy(self.value), node)


def woven(source: str, entries: list[tuple[int, Mutant]]) -> str:
    """Source of a module of kernels with all its mutants by number."""
    tree = ast.parse(source)
    plain = copy.deepcopy(tree)
    later = []
    for number, one in entries:
        other = ast.parse(source.replace(one.old, one.new))
        path, part = _apart(plain, other)
        old, new = _at(plain, path), _at(other, path)
        if isinstance(old, ast.Assign) and len(path) == 1:
            later.append(_Numbers(old.targets[0].id, number, new.value))
            continue
        parent, (name, k) = _at(tree, path[:-1]), path[-1]
        here = getattr(parent, name)[k]
        if isinstance(old, ast.Assign | ast.AugAssign | ast.Return | ast.Expr):
            # an earlier mutant of the same statement stays behind the `else`
            getattr(parent, name)[k] = ast.If(_asked(number), [new], [here])
        elif isinstance(old, ast.If | ast.While) and part == "test":
            if isinstance(here, ast.If) and here.test is not old.test and _is_asked(here):
                raise ValueError(f"{one.id}: a condition and its statement cannot both be mutants")
            here.test = ast.IfExp(_asked(number), new.test, here.test)
        else:
            raise ValueError(f"{one.id}: no mutant can be chosen in a {type(old).__name__}")
    for numbers in later:
        numbers.visit(tree)
    first = 1 if isinstance(tree.body[0], ast.Expr) else 0
    name = ast.ImportFrom("fmu_bearing.engine.asked", [ast.alias("mutant")], 0)
    tree.body.insert(first, name)
    return ast.unparse(ast.fix_missing_locations(tree)) + "\n"


def _is_asked(node: ast.If) -> bool:
    return isinstance(node.test, ast.Call) and getattr(node.test.func, "id", "") == "mutant"


def weave(root: Path, entries: list[tuple[int, Mutant]]) -> None:
    """Put mutants of the engine into a copy of the repository at ``root``."""
    for file in sorted({one.file for _, one in entries}):
        source = (root / file).read_text("utf-8")
        there = [(number, one) for number, one in entries if one.file == file]
        (root / file).write_text(woven(source, there), "utf-8")
    package = root / "fmu_bearing"
    (package / "engine" / "asked.py").write_text(_ASKS, "utf-8")
    (package / "said.py").write_text(_SAYS, "utf-8")
    # an address in the kernels is what is meant here
    worker = package / "compiled" / "worker.py"
    text = worker.read_text("utf-8").replace("def main(", f"{_ADDRESSED}\n\ndef main(", 1)
    worker.write_text(text, "utf-8")
    begin = package / "__init__.py"
    tree = ast.parse(begin.read_text("utf-8"))
    tree.body.insert(1, ast.ImportFrom("fmu_bearing", [ast.alias("said")], 0))
    begin.write_text(ast.unparse(ast.fix_missing_locations(tree)) + "\n", "utf-8")
