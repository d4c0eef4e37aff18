"""No command replaces a file that is there, unless --force is given; it refuses before it computes."""

import hashlib
import os

import pytest

import fmu_bearing.arrays  # noqa: F401  binds what tests here replace, before they do
from fmu_bearing.instance import Instance

#: Each command that writes: its words, and files that it would replace.
WRITING = {
    "scene new": (("scene", "new", "{folder}/new.toml", "--bearing", "7003C"), ["new.toml"]),
    "build": (("build", "{scene}", "-o", "{folder}/b.fmu"), ["b.fmu"]),
    "simulate": (("simulate", "{scene}", "-o", "{folder}/run.csv"), ["run.csv"]),
    "simulate, picture": (
        ("simulate", "{scene}", "-o", "{folder}/run.csv", "--plot", "{folder}/p.png"), ["p.png"],
    ),
    "plot": (("plot", "{result}"), ["result.png"]),
    "sound": (("sound", "{scene}", "-o", "{folder}"), ["levels.csv", "P1.wav"]),
    "sound, picture": (("sound", "{scene}", "-o", "{folder}", "--plot", "{folder}/p.svg"), ["p.svg"]),
    "envelope": (("envelope", "{scene}", "-o", "{folder}"), ["lines-P1.csv", "signals.uff"]),
    "envelope, picture": (("envelope", "{scene}", "--plot", "{folder}/e.png"), ["e.png"]),
    "compare": (("compare", "{scene}", "{scene}", "-o", "{folder}"), ["levels.csv"]),
    "compare, picture": (("compare", "{scene}", "{scene}", "--plot", "{folder}/p.pdf"), ["p.pdf"]),
    "report": (("report", "{scene}", "-o", "{folder}/page.html"), ["page.html"]),
    "report, run": (
        ("report", "{scene}", "-o", "{folder}/page.html", "--keep", "{folder}/run.npz"), ["run.npz"],
    ),
    "stiffness": (("stiffness", "{scene}", "-o", "{folder}/k.csv"), ["k.csv"]),
    "stiffness, bearings": (("stiffness", "{scene}", "-o", "{folder}/k.csv"), ["k-1.csv", "k-2.csv"]),
    "stiffness, picture": (
        ("stiffness", "{scene}", "-o", "{folder}/k.csv", "--plot", "{folder}/k.png"), ["k.png"],
    ),
    "fits": (("fits", "{scene}", "-o", "{folder}/f.csv"), ["f.csv"]),
    "fits, picture": (("fits", "{scene}", "--plot", "{folder}/f.png"), ["f.png"]),
    "error-motion": (("error-motion", "{scene}", "-o", "{folder}"), ["lines.csv", "polar.png"]),
    "error-motion, picture": (
        ("error-motion", "{scene}", "-o", "{folder}", "--plot", "{folder}/p.png"), ["p.png"],
    ),
    "modes": (("modes", "{scene}", "-o", "{folder}"), ["modes.html"]),
    "modes, picture": (("modes", "{scene}", "--plot", "{folder}/c.png"), ["c.png"]),
    "tradeoff": (("tradeoff", "{scene}", "-o", "{folder}"), ["tradeoff.csv"]),
    "tradeoff, picture": (("tradeoff", "{scene}", "-o", "{folder}", "--plot", "{folder}/t.png"), ["t.png"]),
    "sensitivity": (("sensitivity", "{scene}", "-o", "{folder}"), ["sensitivity.md"]),
    "sensitivity, several": (
        ("sensitivity", "{scene}", "--method", "morris", "--vary", "speed=5000..9000", "--vary",
         "preload=200..500", "-o", "{folder}"), ["sensitivity.png"],
    ),
    "sensitivity, picture": (
        ("sensitivity", "{scene}", "--method", "morris", "--vary", "speed=5000..9000", "--vary",
         "preload=200..500", "-o", "{folder}", "--plot", "{folder}/s.png"), ["s.png"],
    ),
    "sweep": (("sweep", "{scene}", "-a", "speed=5000,9000", "-o", "{folder}"), ["sweep.nc"]),
    "sweep, picture": (
        ("sweep", "{scene}", "-a", "speed=5000,9000", "-o", "{folder}", "--plot", "{folder}/s.png"),
        ["s.png"],
    ),
    "receptance": (("receptance", "{scene}", "-o", "{folder}/g.csv"), ["g.csv"]),
    "receptance, picture": (("receptance", "{scene}", "--plot", "{folder}/g.svg"), ["g.svg"]),
    "lobes": (("lobes", "{scene}", "-o", "{folder}/l.csv"), ["l.csv"]),
    "dataset": (("dataset", "{plan}", "-o", "{folder}"), ["labels.csv", "waveforms.nc"]),
    "identify": (("identify", "{scene}", "{result}", "-f", "x", "-o", "{folder}/i.toml"), ["i.toml"]),
    "identify, folder": (
        ("identify", "{scene}", "{result}", "-f", "x", "-o", "{folder}/i.toml"), ["i/levels.csv"],
    ),
    "realtime": (("realtime", "{scene}", "-o", "{folder}/steps.csv"), ["steps.csv"]),
    "vibration": (("vibration", "{scene}", "--rigid", "-o", "{folder}"), ["bands.png", "lines.csv"]),
}  # fmt: skip


@pytest.mark.parametrize("name", WRITING)
def test_a_file_that_is_there_is_kept(name, run, rings_file, tmp_path, monkeypatch):
    for stage in ("fmu_bearing.prepare.model.pack", "fmu_bearing.prepare.model.sound_blocks"):
        monkeypatch.setattr(stage, lambda *a, **k: pytest.fail("the computation has begun"))
    monkeypatch.setattr(Instance, "initialise", lambda *a: pytest.fail("the run has begun"))
    words, files = WRITING[name]
    folder, result = tmp_path / "out", tmp_path / "result.csv"
    result.write_text("time,friction_torque\n0,1\n1,1\n")
    plan = tmp_path / "plan.toml"
    plan.write_text(
        f'scene = "{os.path.relpath(rings_file, tmp_path)}"\nruns = 1\n[[class]]\nname = "a"\nshare = 1\n'
    )
    there = [tmp_path / file if name == "plot" else folder / file for file in files]
    for file in there:
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text("mine")
    given = {"scene": rings_file, "folder": folder, "result": result, "plan": plan}
    refused = run(*(word.format(**given) for word in words))
    assert refused.exit_code == 2, refused.output
    for file in there:
        assert str(file) in refused.stderr and file.read_text() == "mine"
    verb = "is" if len(there) == 1 else "are"
    assert f"{verb} there already: name another place, or give --force" in refused.stderr
    assert refused.stderr.count("\n") == 1 and refused.stdout == ""
    assert {path for path in folder.rglob("*") if path.is_file()} | {result} == {*there, result} - (
        {tmp_path / "result.png"} if name == "plot" else set()
    )


def test_every_command_that_writes_is_among_them():
    from tests.cli.test_one_voice import WRITE

    assert {name.partition(",")[0] for name in WRITING} == WRITE


@pytest.mark.parametrize(
    ("words", "file"),
    [
        (("simulate", "{scene}", "-t", 1e-3, "-v", "friction_torque", "-o", "{folder}/run.csv"), "run.csv"),
        (("plot", "{result}", "-o", "{folder}/p.svg"), "p.svg"),
        (("stiffness", "{scene}", "--frequencies", "100,200", "-o", "{folder}/k.csv"), "k.csv"),
        (("realtime", "{scene}", "--duration", 2e-3, "--silent", "-o", "{folder}/s.csv"), "s.csv"),
        (("compare", "{result}", "{result}", "-o", "{folder}"), "loads-angles-torque.csv"),
    ],
    ids=lambda value: value[0] if isinstance(value, tuple) else "",
)
def test_force_replaces_it(words, file, run, rings_file, tmp_path):
    folder, result = tmp_path / "out", tmp_path / "result.csv"
    result.write_text("time,friction_torque\n0,1\n1,1\n")
    folder.mkdir()
    (folder / file).write_text("old")
    filled = [str(word).format(scene=rings_file, folder=folder, result=result) for word in words]
    done = run(*filled, "--force")
    assert done.exit_code == 0, done.output
    assert (folder / file).read_text("utf-8") != "old" and (folder / file).stat().st_size > 20


@pytest.mark.heavy
def test_a_sweep_goes_on_in_its_own_folder_and_spares_that_of_another(run, silent_file, tmp_path):
    words = ("sweep", silent_file, "--fidelity", "rings", "--settle", 0, "--window", 1e-3, "-w", 1)
    first = run(*words, "-a", "speed=5000,9000", "-o", tmp_path)
    assert first.exit_code == 0, first.output
    points = {path.name: path.stat().st_mtime_ns for path in (tmp_path / "points").iterdir()}
    again = run(*words, "-a", "speed=5000,9000", "-o", tmp_path)
    assert again.exit_code == 0 and "2 of 2 points" in again.stdout
    assert points == {path.name: path.stat().st_mtime_ns for path in (tmp_path / "points").iterdir()}
    kept = {path: hashlib.md5(path.read_bytes()).digest() for path in tmp_path.iterdir() if path.is_file()}
    other = run(*words, "-a", "speed=6000,9000", "-o", tmp_path)
    assert other.exit_code == 2 and "--force" in other.stderr
    assert kept == {p: hashlib.md5(p.read_bytes()).digest() for p in tmp_path.iterdir() if p.is_file()}
