"""What the band of excitation costs and gives: levels and speed against ``highest_frequency_kHz``.

``python -m benchmarks.band --output docs/results`` writes ``band.md`` and ``band.csv``. Levels of all
three fidelities, and by how much they move with a quarter of the step; a few minutes of one core.
"""

import argparse
import pathlib
import time
import warnings

import numpy as np

from fmu_bearing.acoustics.analysis.third_octave import third_octave_levels
from fmu_bearing.recording.record import record
from fmu_bearing.results.table import machine, markdown, write_csv
from fmu_bearing.scene import Scene, read_scene
from fmu_bearing.scene.read import with_fidelity

SCENE = pathlib.Path(__file__).parents[1] / "examples" / "scenes" / "7003C-spindle.toml"
SPEEDS = (5000.0, 20000.0, 30000.0)
BANDS = (2.5, 5.0, 10.0, 20.0)  # kHz
FIDELITIES = ("response", "rings", "full")
COLUMNS = (
    "r/min", "band, kHz", "fidelity", "loudest, dB", "loudest, dB(A)", "quietest, dB(A)", "sim/CPU",
    "quarter steps: dB", "dB(A)", "third octaves, dB",
)  # fmt: skip
#: Longest step (us) of a scene that says nothing, and at a band of 1 kHz: radians per step over 2 pi.
_LONGEST = {"rings": (20.0, 159.0), "full": (25.0, 254.0)}
_HEARD = 30.0  # dB below the loudest third octave


def scene_at(scene: Scene, rpm: float, band: float, fidelity: str, **keys: float) -> Scene:
    """The scene at a speed, excited up to ``band`` (kHz)."""
    operation = scene.operation.model_copy(update={"speed_rpm": rpm})
    flaws = scene.imperfections.model_copy(update={"highest_frequency_kHz": band})
    changed = scene.model_copy(update={"operation": operation, "imperfections": flaws})
    return with_fidelity(changed, model=fidelity, **keys)


def row(scene: Scene, rpm: float, band: float, fidelity: str, duration: float = 0.1) -> list[str]:
    """One line of the table."""
    clock = time.thread_time()
    made = record(scene_at(scene, rpm, band, fidelity), duration, settle=0.05, progress=False, outputs=())
    pace = (0.05 + duration) / (time.thread_time() - clock)
    flat, weighted = made.levels(), made.levels(weighting="A")
    cells = [f"{rpm:,.0f}", f"{band:g}", fidelity, f"{flat.max():.1f}", f"{weighted.max():.1f}",
             f"{weighted.min():.1f}", f"{pace:.2g}"]  # fmt: skip
    if fidelity not in _LONGEST:
        return [*cells, "", "", ""]
    own, per_band = _LONGEST[fidelity]
    finer = scene_at(scene, rpm, band, fidelity, max_internal_step_us=0.25 * min(own, per_band / band))
    fine = record(finer, duration, settle=0.05, progress=False, outputs=())
    loudest = [made.positions[int(flat.argmax())]]
    bands = [third_octave_levels(one.pressure(loudest)[0], one.rate)[1] for one in (made, fine)]
    heard = bands[1] > bands[1].max() - _HEARD
    return [
        *cells,
        f"{np.abs(fine.levels() - flat).max():.2f}",
        f"{np.abs(fine.levels(weighting='A') - weighted).max():.2f}",
        f"{np.abs(bands[0] - bands[1])[heard].max():.2f}",
    ]


def main(arguments: list[str] | None = None) -> None:
    """Run the command."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.band", description=__doc__)
    parser.add_argument("--output", type=pathlib.Path, required=True, help="folder of the tables")
    given = parser.parse_args(arguments)
    scene = read_scene(SCENE)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # 20 kHz are beyond what the engine advises
        rows = [row(scene, rpm, band, name) for rpm in SPEEDS for band in BANDS for name in FIDELITIES]
    given.output.mkdir(parents=True, exist_ok=True)
    write_csv(given.output / "band.csv", COLUMNS, rows)
    text = (
        "# Band of excitation\n\n7003C-spindle, four microphones, radiation model `bem`; "
        f"{machine()}; made by `python -m benchmarks.band`.\n\n" + markdown(COLUMNS, rows)
    )
    (given.output / "band.md").write_text(text, "utf-8")


if __name__ == "__main__":
    main()
