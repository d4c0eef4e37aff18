"""Objects of kernels with nothing optimised: made in a tenth of the time, with the same values, slow to run.

For tests of what code does or asks for, not of how fast it is. LLVM neither compiles functions into their
callers nor chooses registers with care; functions that nothing calls are left out, as always.
"""

import functools

import llvmlite.binding as llvm
import pytest

from fmu_bearing.compiled import make, optimise
from fmu_bearing.compiled.platforms import PLATFORMS

__all__ = ["install", "object_of"]


def install(put=setattr):
    """Let `optimise.object_code` make such objects in this process; ``put``: sets an attribute."""
    machine = llvm.Target.create_target_machine
    put(optimise, "_optimise", _drop_unused)
    put(llvm.Target, "create_target_machine", lambda self, **choice: machine(self, **(choice | {"opt": 0})))


def _drop_unused(module, target, speed, loops):
    """In place of LLVM's standard passes."""
    passes = llvm.create_new_module_pass_manager()
    passes.add_global_dead_code_eliminate_pass()
    passes.run(module, llvm.create_pass_builder(target, llvm.create_pipeline_tuning_options(speed_level=0)))


@functools.cache
def object_of(unit, name, suffix):
    """Return such an object of a unit, whose portable code is kept, for an instruction set of a platform."""
    with pytest.MonkeyPatch.context() as patch:
        install(patch.setattr)
        return optimise.object_code(make.bitcode(unit), PLATFORMS[name], suffix, lambda done: None)
