"""Every command that computes for long refuses a target that it cannot write before it begins."""

import pytest

from fmu_bearing.instance import Instance


@pytest.fixture
def blocked(tmp_path, monkeypatch):
    """A file where a folder is needed; the beginning of any computation fails the test."""
    for name in ("fmu_bearing.prepare.model.pack", "fmu_bearing.prepare.model.sound_blocks"):
        monkeypatch.setattr(name, lambda *a, **k: pytest.fail("the computation has begun"))
    monkeypatch.setattr(Instance, "initialise", lambda *a: pytest.fail("the run has begun"))
    file = tmp_path / "file"
    file.write_text("")
    return file


@pytest.mark.parametrize(
    "words",
    [
        ("simulate", "{scene}", "-o", "{file}/run.csv"),
        ("sound", "{scene}", "-o", "{file}"),
        ("sound", "{scene}", "-o", "{file}/sub"),
        ("envelope", "{scene}", "-o", "{file}/sub"),
        ("tradeoff", "{scene}", "-o", "{file}/sub"),
        ("tradeoff", "{scene}", "-o", "{folder}/out", "--plot", "{file}/chart.png"),
        ("sensitivity", "{scene}", "-o", "{file}"),
        ("sweep", "{scene}", "-a", "speed=1000,2000", "-o", "{file}"),
        ("compare", "{scene}", "{scene}", "-o", "{file}/tables"),
        ("compare", "{scene}", "{scene}", "-o", "{folder}/tables", "--plot", "{file}/both.png"),
        ("report", "{scene}", "-o", "{file}/page.html"),
        ("report", "{scene}", "-o", "{folder}/page.html", "--keep", "{file}/run.npz"),
        ("build", "{scene}", "-o", "{file}/bearing.fmu"),
        ("identify", "{scene}", "{file}", "-o", "{file}/found.toml"),
    ],
    ids=lambda words: " ".join(words).replace("{", "").replace("}", ""),
)
def test_a_file_in_place_of_the_folder(run, rings_file, blocked, words):
    filled = [word.format(scene=rings_file, file=blocked, folder=blocked.parent) for word in words]
    refused = run(*filled)
    assert refused.exit_code == 2, refused.output
    assert "cannot be written to" in refused.stderr and refused.stderr.count("\n") == 1
    assert [path.name for path in blocked.parent.iterdir()] == ["file"]


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (("tradeoff", "--plot", "chart.bmp"), "a picture is written as .png, .svg or .pdf"),
        (("tradeoff", "--plot", "."), "is a folder"),
        (("report", "--keep", "run.csv"), "a run is written as .npz"),
        (("report", "-o", "."), "is a folder"),
        (("build", "-o", "."), "is a folder"),
    ],
)
def test_a_name_that_cannot_be_written(run, rings_file, blocked, monkeypatch, words, reason):
    monkeypatch.chdir(blocked.parent)
    refused = run(words[0], rings_file, *words[1:])
    assert refused.exit_code == 2 and reason in refused.stderr, refused.output
