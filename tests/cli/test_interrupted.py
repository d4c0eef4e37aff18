"""Ctrl-C ends a command with code 130 and one line, whatever it does at that moment."""

import os
import signal
import subprocess
import sys
import time

import pytest

from tests.conftest import EXAMPLES

SCENE = str(EXAMPLES / "7003C-bare.toml")


@pytest.mark.skipif(not hasattr(os, "killpg"), reason="signals of POSIX")
@pytest.mark.parametrize(
    ("words", "seconds"),
    [
        (("simulate", "{scene}", "-t", "10000", "-o", "{folder}/a.csv"), 0.15),  # modules are loaded
        (("simulate", "{scene}", "-t", "10000", "-o", "{folder}/a.csv"), 3.0),
        (("sensitivity", "{scene}", "-o", "{folder}"), 3.0),
    ],
    ids=["loading", "running", "studying"],
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
            _, told = program.communicate(timeout=60)
        finally:
            program.kill()  # what does not end would hold up all other tests
    assert program.returncode == 130, told
    assert "Traceback" not in told
    assert len([line for line in told.splitlines() if "interrupted" in line]) == 1
