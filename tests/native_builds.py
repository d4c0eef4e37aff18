"""What a test does where no native FMU can be built: skip without a compiler, fail with one."""

from typing import NoReturn

import pytest

from fmu_bearing.compiled.errors import BuildError
from fmu_bearing.compiled.platforms import host
from fmu_bearing.fmi.native.link import compiler_for


def no_native_fmu(problem: BuildError | str) -> NoReturn:
    """Skip the test if this machine has no C compiler; fail with the problem if it has one.

    A build that breaks would otherwise skip every test of native FMUs.
    """
    try:
        compiler_for(host())
    except BuildError as missing:
        pytest.skip(f"no native FMU without a C compiler: {missing}")
    pytest.fail(f"there is a C compiler, but no native FMU: {problem}", pytrace=False)
