"""Tests run in the order of the seconds that they took, folders that share results as one."""

import pytest

from tests.conftest import ROOT
from tests.order import read, scope

pytest_plugins = ["pytester"]


def test_what_one_worker_runs():
    assert scope("tests/reports/test_page.py::test_a[b::c]") == "tests/reports/"
    assert scope("tests/test_docs.py::test_a") == "tests/test_docs.py"


@pytest.mark.heavy
@pytest.mark.parametrize(
    "workers", [["-p", "no:xdist"], ["-n1", "--dist=loadfile", "--no-loadscope-reorder"]]
)
def test_the_longest_go_first_and_are_measured(pytester, workers):
    pytester.makeconftest((ROOT / "tests" / "conftest.py").read_text("utf-8"))
    busy = "import time\n\ndef test():\n    end = time.process_time() + {}\n"
    busy += "    while time.process_time() < end: ..."
    pytester.makepyfile(test_a=busy.format(0), test_b=busy.format(2.1), test_c=busy.format(0))
    times = pytester.makefile(".txt", times="# head\n5 test_c.py\n1 test_b.py\n7 gone.py\n3 other.py\n")
    pytester.makefile(".py", other="")  # has no test
    result = pytester.runpytest_subprocess("-v", *workers, f"--times={times}", "--measure-times", timeout=120)
    assert result.ret == 0
    ran = [word for line in result.outlines for word in line.split() if word.endswith(".py::test")]
    assert list(dict.fromkeys(ran)) == ["test_c.py::test", "test_b.py::test", "test_a.py::test"]
    found = read(times)  # two are short, one is gone, one was not run
    assert found.pop("other.py") == 3.0
    assert list(found) == ["test_b.py"] and 2.0 <= found["test_b.py"] < 4.0
