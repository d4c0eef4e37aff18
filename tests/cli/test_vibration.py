"""The command vibration: what it prints, writes and refuses."""

import pytest

from tests.vibration_test.played import play


@pytest.fixture
def quick(monkeypatch):
    """Runs are played; their scenes."""
    return play(monkeypatch)


def test_the_command_prints_and_writes(quick, run, tmp_path):
    words = ("vibration", "7003C", "--seeds", 2, "--limits", "52,18,18", "-o", tmp_path / "a")
    shown = run(*words)
    assert shown.exit_code == 0, shown.output
    assert "7003C: vibration test, 1800 r/min, 100 N" in shown.stdout
    assert (
        "soft piece, range" in shown.stdout
        and "M: 84 um/s on the soft piece (10.9 Anderon) is above its" in shown.stdout
    )
    assert len(list((tmp_path / "a").iterdir())) == 3
    data = run(*words[:-2], "-o", tmp_path / "b", "--json", "--load", 90, "--grade", "P5").data
    assert data["load_N"] == 90.0 and data["bands"]["M"]["soft_um_s"] == pytest.approx([80.0, 88.0])
    assert data["bands"]["L"]["mean_anderon"] == pytest.approx(31.5 / 7.698, rel=1e-4)
    assert quick[-1].imperfections.ball_form_nm == 130.0


@pytest.mark.parametrize(
    ("words", "refusal"),
    [
        (("--limits", "52,18"), "limits: 2 values: give three, of L, M, H"),
        (("--limits", "52;18;18"), "--limits 52;18;18 is refused: write three numbers, as 52,18,18"),
        (("--unit", "mm/s"), "--unit mm/s is refused: it is um/s or anderon"),
        (("--seeds", "0"), "seeds = 0: give a whole number from 1"),
        (("--fidelity", "rings"), "cannot have a vibration test: its sensor touches the outer ring"),
        (("--speed", "2e5"), "--speed 200000 r/min is refused"),
        (("--set", "imperfections.seeed=3"), "imperfections.seeed"),
        (("--set", "operation.speed_rpm=900"), "speed and temperatures are the rig's here; give --speed"),
    ],
)
def test_the_command_refuses_in_one_line_before_the_first_run(quick, run, words, refusal, tmp_path):
    refused = run("vibration", "7003C", *words, "-o", tmp_path / "a")
    assert refused.exit_code == 2 and refusal in refused.stderr and refused.stderr.count("\n") == 1
    assert not quick and not (tmp_path / "a").exists()
