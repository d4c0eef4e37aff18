"""Ctrl-C ends a command with code 130 and one line, whatever it does at that moment."""

import os
import signal
import subprocess
import sys
import time

import pytest

from tests.conftest import EXAMPLES

SCENE = str(EXAMPLES / "7003C-bare.toml")

#: Interrupts the program while it loads its commands, within a text that is executed, as dataclasses do.
WHILE_LOADING = """
import os, signal, sys, time

class Interrupting:
    def find_spec(self, name, path=None, target=None):
        if name == "fmu_bearing.cli":
            sys.meta_path.remove(self)
            exec("os.kill(os.getpid(), signal.SIGINT); time.sleep(10)")

sys.meta_path.insert(0, Interrupting())
"""


@pytest.mark.skipif(not hasattr(os, "killpg"), reason="signals of POSIX")
@pytest.mark.parametrize(
    ("words", "seconds"),
    [
        (("simulate", "{scene}", "-t", "10000", "-o", "{folder}/a.csv"), 3.0),
        (("sensitivity", "{scene}", "-o", "{folder}"), 3.0),
    ],
    ids=["running", "studying"],
)
def test_ctrl_c_is_one_line(tmp_path, words, seconds):
    filled = [word.format(scene=SCENE, folder=tmp_path) for word in words]
    with subprocess.Popen(
        [sys.executable, "-m", "fmu_bearing", *filled], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        text=True, start_new_session=True,
    ) as program:  # fmt: skip
        time.sleep(seconds)
        os.killpg(program.pid, signal.SIGINT)
        try:
            _, reported = program.communicate(timeout=60)
        finally:
            program.kill()  # what does not end would hold up all other tests
    assert program.returncode == 130, reported
    assert "Traceback" not in reported
    assert len([line for line in reported.splitlines() if "interrupted" in line]) == 1


@pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")
def test_ctrl_c_while_modules_are_loaded(tmp_path):
    (tmp_path / "sitecustomize.py").write_text(WHILE_LOADING, encoding="utf-8")
    ended = subprocess.run(
        [sys.executable, "-m", "fmu_bearing", "--version"], capture_output=True, text=True, timeout=60,
        env=os.environ | {"PYTHONPATH": os.pathsep.join([str(tmp_path), *sys.path])},
    )  # fmt: skip
    assert (ended.returncode, ended.stderr, ended.stdout) == (130, "interrupted\n", "")
