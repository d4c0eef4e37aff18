"""A host that computes in another way than a fresh process: rounding, subnormal numbers as zero."""

import platform
from decimal import Decimal

import pytest

from .test_shim_host import run_host

pytestmark = pytest.mark.skipif(
    platform.machine() not in ("x86_64", "AMD64", "aarch64", "arm64"), reason="no other processor is known"
)
STEP, SPEED, RATE = (Decimal(number) for number in (0.1, 0.3, 0.7))  # all digits: read the same in every mode


def commands(mode, speed=SPEED, rate=RATE):
    """Steps whose sums all round, in a mode of the host; numbers are printed to nearest."""
    get = ("float:nearest", "get:4,5,9", f"float:{mode}")
    steps = [f"step:{STEP}:1", *get] * 5
    return (f"float:{mode}", f"set:0:{speed}", f"rate:0:{rate}", "start", *steps, "terminate")


@pytest.mark.parametrize(
    ("mode", "values"),
    [("up", ()), ("down", ()), ("zero", ()), ("flush", ()), ("flush", (0, Decimal(1e-310)))],
    ids=["up", "down", "zero", "flush", "flush subnormal numbers"],
)
def test_results_and_the_hosts_mode_are_the_same(host, library, resources, mode, values):
    usual = run_host(host, library, resources, *commands("nearest", *values))
    ran = run_host(host, library, resources, *commands(mode, *values))
    assert usual.returncode == ran.returncode == 0, ran.stdout  # 1: a call changed how the host computes
    assert ran.stdout == usual.stdout
