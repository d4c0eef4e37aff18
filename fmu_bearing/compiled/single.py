"""Kernels without what only sets of bearings need: a third of the code that a single bearing would carry.

Whether a shaft carries the bearings is asked at run time (`members.has_shaft`), as one library serves every
scene. Here the answer is put into the sources as they are loaded; Python drops the branches never taken.
"""

import ast
import importlib.abc
import importlib.machinery
import sys
from collections.abc import Sequence
from types import CodeType, ModuleType
from typing import Any

__all__ = ["install"]

_KERNELS = "fmu_bearing.engine."


class _Answered(ast.NodeTransformer):
    """Puts the answer in the place of each question."""

    def visit_Call(self, node: ast.Call) -> ast.AST:
        self.generic_visit(node)
        asked = getattr(node.func, "attr", getattr(node.func, "id", "")) == "has_shaft"
        return ast.copy_location(ast.Constant(False), node) if asked else node


class _Loader(importlib.machinery.SourceFileLoader):
    """Compiles a module of kernels in memory."""

    def get_code(self, fullname: str) -> CodeType:
        path = self.get_filename(fullname)
        tree = _Answered().visit(ast.parse(self.get_data(path), path))
        return compile(tree, path, "exec", dont_inherit=True)


class _Finder(importlib.abc.MetaPathFinder):
    """Finds the engine's modules as Python does, and has them loaded by `_Loader`."""

    def find_spec(self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None) -> Any:
        if not fullname.startswith(_KERNELS):
            return None
        spec = importlib.machinery.PathFinder.find_spec(fullname, path, target)
        if spec is not None and isinstance(spec.loader, importlib.machinery.SourceFileLoader):
            spec.loader = _Loader(spec.loader.name, spec.loader.path)
        return spec


def install() -> None:
    """Load kernels for single bearings in this process from now on; none may be loaded yet."""
    if any(isinstance(one, _Finder) for one in sys.meta_path):
        return
    if f"{_KERNELS}jit" in sys.modules:
        raise RuntimeError("kernels are loaded already")
    sys.meta_path.insert(0, _Finder())
