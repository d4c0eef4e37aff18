"""Kernels for single bearings alone: whether a shaft carries the bearings is answered where it is asked."""

import re
import subprocess
import sys

from fmu_bearing.engine.spindle import inputs, members
from tests.conftest import ROOT

#: Loads kernels and calls two as Python functions, without the parameters that would answer the question.
_CALLS = """
from fmu_bearing.compiled import single
single.install()
from fmu_bearing.engine.spindle import inputs, members
print(members.bearing_count.py_func(None), inputs.loads_differ.py_func(None, None, None))
try:
    single.install()
    print("again")
    import sys
    sys.meta_path.pop(0)
    single.install()
except RuntimeError as problem:
    print(problem)
"""


def test_the_answer_is_in_the_kernels():
    ran = subprocess.run(
        [sys.executable, "-c", _CALLS], cwd=ROOT, capture_output=True, text=True, timeout=600
    )
    assert ran.returncode == 0, ran.stderr
    assert ran.stdout.splitlines() == ["1 False", "again", "kernels are loaded already"]


def test_other_kernels_ask_the_parameters():
    for ask in (members.bearing_count.py_func, inputs.loads_differ.py_func):
        assert "has_shaft" in ask.__code__.co_names


def test_the_question_is_asked_in_one_place():
    """A kernel that reads the parameter itself would carry the code of sets along."""
    asking = [
        (file.name, line)
        for file in sorted((ROOT / "fmu_bearing" / "engine").rglob("*.py"))
        for line in file.read_text(encoding="utf-8").splitlines()
        if re.search(r"\bp\w*\[_?P\.ALONE\]", line)
    ]
    assert [name for name, _ in asking] == ["spindle.py", "members.py"]  # the layout, and `has_shaft`
