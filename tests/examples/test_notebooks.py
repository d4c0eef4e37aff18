"""Notebooks run from their first cell to their last, and what they say in words is what they print."""

import re

import pytest

from tests.conftest import ROOT

NOTEBOOKS = sorted((ROOT / "examples" / "notebooks").glob("*.ipynb"))
#: s, of recordings in the tests: long enough to separate the lines that the notebooks name.
SHORT = {"first_result": 0.2, "run_up": 0.3}
#: Notebooks that record nothing.
READ = ("defects",)


def run(name):
    """Run a notebook with short recordings, and return what it printed and how many pictures it drew."""
    nbformat = pytest.importorskip("nbformat")
    nbclient = pytest.importorskip("nbclient", reason="notebooks need nbclient and ipykernel: extra test")
    pytest.importorskip("ipykernel")
    folder = ROOT / "examples" / "notebooks"
    notebook = nbformat.read(folder / f"{name}.ipynb", as_version=4)
    if name not in READ:
        first = next(cell for cell in notebook.cells if cell.cell_type == "code")
        first.source, changed = re.subn(
            r"^DURATION = [\d.]+", f"DURATION = {SHORT[name]}", first.source, flags=re.MULTILINE
        )
        assert changed == 1
    nbclient.NotebookClient(
        notebook, timeout=300, kernel_name="python3", resources={"metadata": {"path": str(folder)}}
    ).execute()
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", ())]
    reported = "".join(output.text for output in outputs if output.output_type == "stream")
    pictures = sum("image/png" in output.get("data", {}) for output in outputs)
    return reported, pictures


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_no_outputs_are_stored(path):
    cells = pytest.importorskip("nbformat").read(path, as_version=4).cells
    assert all(not cell.outputs and cell.execution_count is None for cell in cells if "outputs" in cell)
    assert path.stem in (*SHORT, *READ)


@pytest.mark.heavy
def test_first_result():
    reported, pictures = run("first_result")
    assert pictures == 1
    assert "| f_i - f_r |" in reported
    # the shorter recording moves the level by chance of the cut, a few tenths of a dB
    assert float(re.search(r"total +([\d.]+) dB\(A\)", reported)[1]) == pytest.approx(71.7, abs=0.5)
    assert float(re.search(r"100 N instead of 500 N: ([\d.]+) dB\(A\) less", reported)[1]) > 5.0


@pytest.mark.heavy
def test_run_up():
    reported, pictures = run("run_up")
    assert pictures == 2
    peaks = {
        name: (float(rpm), float(hertz))
        for name, rpm, hertz in re.findall(
            r"^(.+?) +order .* dB at (\d+) r/min, (\d+) Hz", reported, re.MULTILINE
        )
    }
    assert set(peaks) == {"shaft", "f_o", "f_i - f_r"}
    # 107,000 r/min per second pass by a resonance before it has grown: later than its own speed
    assert 27_900.0 < peaks["shaft"][0] < 31_000.0
    for name in ("f_o", "f_i - f_r"):
        assert peaks[name][1] == pytest.approx(1986.0, rel=0.05), name
