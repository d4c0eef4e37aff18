"""Kernels on four lanes are vector code on every processor, and contract nothing."""

import pytest

from tests.engine import ahead

#: Fused multiply and add, on x86 and ARM: it would round once where other processors round twice.
CONTRACTED = r"vfn?m(add|sub)|\bfml[as]\b|\bfn?m(add|sub)\b"


def multiplications(found):
    """Vector multiplications in the assembly of each processor, in units of four lanes."""
    return {
        "x86-64-v3": ahead.count(found["x86-64-v3"], r"vmulpd\s.*ymm"),
        "x86-64-v2": ahead.count(found["x86-64-v2"], r"\bmulpd\s.*xmm") / 2.0,
        "generic": ahead.count(found["generic"], r"\bfmul\s+v\d+\.2d") / 2.0,
    }


@pytest.mark.heavy
def test_the_solution_is_vector_code_on_every_processor():
    found = ahead.assembly("fmu_bearing.engine.newton.block_arrow", "solve", "aaddaa")
    # 36 for a ball's inverse, six for a body coordinate, six to follow one, and one for the border's inverse
    assert min(multiplications(found).values()) >= 36 + 6 + 6 + 1
    assert not any(ahead.count(code, CONTRACTED) for code in found.values())


#: Multiplications that the formulas have at least, counted in the text of the kernel for one group of balls.
KERNELS = {
    ("race", "normal_contact", "aaaiia"): 45,
    ("race", "traction", "aiia"): 12,
    ("cage", "pocket_forces", "aaaida"): 60,
}


@pytest.mark.heavy  # compiles each on its own
@pytest.mark.parametrize("kernel", KERNELS, ids=lambda kernel: kernel[1])
def test_contacts_are_vector_code_on_every_processor(kernel):
    room, name, kinds = kernel
    found = ahead.assembly(f"fmu_bearing.engine.mechanics.{room}", name, kinds)
    assert min(multiplications(found).values()) >= KERNELS[kernel]
    assert not any(ahead.count(code, CONTRACTED) for code in found.values())
    # roots of four balls, and none of a single one
    assert ahead.count(found["x86-64-v3"], r"vsqrtpd\s.*ymm")
    assert not ahead.count(found["x86-64-v3"], "vsqrtsd")
