"""What holds skipped tests against a list, and what fixes the draws of tests."""

import pathlib

import hypothesis
import pytest

from tests.conftest import ROOT, Skips

pytest_plugins = ["pytester"]

CODE = """
import pytest

@pytest.mark.skipif(True, reason="no browser on the path")
def test_page(): pass

def test_native():
    pytest.skip("linking broke")

@pytest.mark.xfail(reason="known")
def test_known(): assert False
"""


@pytest.mark.heavy
@pytest.mark.parametrize(
    ("listed", "code", "words"),
    [
        ("test_given.py::test_page: no browser\ntest_given.py::test_native: linking", 0, ""),
        ("test_given.py::test_page: no browser", 1, "not on the list: test_given.py::test_native: "),
        ("test_given.py::test_page: another reason\ntest_given.py::test_native: linking", 1, "test_page: "),
    ],
)
def test_a_skip_that_is_not_listed_fails_the_run(pytester, listed, code, words):
    pytester.makeconftest((ROOT / "tests" / "conftest.py").read_text("utf-8"))
    pytester.makepyfile(test_given=CODE)
    file = pytester.makefile(".txt", skips=listed)
    result = pytester.runpytest_subprocess("-p", "no:xdist", "-m", "", f"--skips={file}", timeout=120)
    assert result.ret == code
    assert words in result.stdout.str()
    result.assert_outcomes(skipped=2, xfailed=1)


def test_the_list_has_a_reason_for_each_test_and_no_test_that_is_gone():
    file = ROOT / "tests" / "skips.txt"
    for node, reason in Skips(file).allowed:
        path, _, name = node.partition("::")
        assert reason and (ROOT / path).exists()
        assert not name or f"def {name}(" in (ROOT / path).read_text("utf-8")


def test_draws_are_fixed_but_for_soaking():
    fixed, soak = (hypothesis.settings.get_profile(name) for name in ("fixed", "soak"))
    assert (fixed.derandomize, fixed.deadline) == (True, None)
    assert (soak.derandomize, soak.deadline) == (False, None)
    makefile = pathlib.Path(ROOT / "Makefile").read_text("utf-8")
    assert "HYPOTHESIS_PROFILE=soak timeout $(SOAK)" in makefile
