"""From measured levels to the numbers of a spindle, with the truth at hand.

A 7003C in its spindle is "measured" at four speeds: sound levels at four microphones, the shaft's line, and
the velocity of the housing. The measured machine is a scene too, with other values than the one the search
starts from and with surfaces of its own (another seed), computed with fidelity ``full``; its levels get 1.5
dB of noise. `identify` sees the levels alone. A fifth speed is not fitted: it checks. Then the identified
values are beside the truth.

All four come out within two standard deviations; fitted values fall from 5.0 to 1.6 dB rms, checked ones from
4.3 to 1.7 dB. Writes

* ``measured.csv`` - the measured levels;
* ``start.toml``, ``identified.toml`` - the scene before and after;
* ``identified/`` - levels before and after, values, slopes, a report;
* ``identification.png`` - levels and values, the truth beside them.

Usage: python examples/identification/spindle.py [--output-dir out/identification] [--quick]
"""

from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer

from fmu_bearing import Scene, identify, read_scene
from fmu_bearing.cli.base import refusals
from fmu_bearing.identification import Identified
from fmu_bearing.identification.data import read_data
from fmu_bearing.identification.files import misfit_words, write_all
from fmu_bearing.identification.model import Levels
from fmu_bearing.identification.picture import identified_picture, save
from fmu_bearing.results.table import show, write_csv

SCENE = Path(__file__).parents[1] / "scenes" / "7003C-spindle.toml"
#: Keys that differ on the measured machine, as factors on the scene's values.
TRUTH = {
    "imperfections.unbalance_um": 3.0,
    "imperfections.*_race_amplitude_um": 0.5,
    "mounting.pedestal_stiffness_N_m": 1.5,
    "mounting.housing.mass_kg": 1.4,
}
FITTED, CHECKED = (9000.0, 14000.0, 20000.0, 27000.0), (17000.0,)  # r/min
SEED, NOISE = 77, 1.5  # of the measured machine; dB
QUANTITIES = ("leq_a", "line[f_r]")  # at each microphone, and at the first


def spindle() -> Scene:
    """Return the scene that the search starts from: compact radiation, which takes no boundary elements."""
    return read_scene(SCENE).replace({"sound.radiation_model": "compact", "sound.details": False})


def measured_machine(scene: Scene) -> Scene:
    """Return the machine that is measured."""
    values = {"imperfections.seed": SEED}
    flaws = scene.imperfections
    assert flaws is not None and flaws.inner_race_amplitude_um is not None
    races = TRUTH["imperfections.*_race_amplitude_um"]
    for key, factor in TRUTH.items():
        if "*" not in key:
            table, _, name = key.rpartition(".")
            part: Any = scene
            for step in table.split("."):
                part = getattr(part, step)
            values[key] = factor * getattr(part, name)
    for race in ("inner", "outer"):
        values[f"imperfections.{race}_race_amplitude_um"] = races * flaws.inner_race_amplitude_um
    return scene.replace(values)


def rows(scene: Scene) -> list[dict[str, Any]]:
    """Return what is measured, levels still blank."""
    found = []
    for speed in (*FITTED, *CHECKED):
        common = {"speed_rpm": speed, "value_dB": 60.0, "std_dB": NOISE,
                  "role": "fit" if speed in FITTED else "check"}  # fmt: skip
        for place in scene.microphones:
            found.append(common | {"microphone": place.name, "quantity": QUANTITIES[0]})
        found.append(common | {"microphone": scene.microphones[0].name, "quantity": QUANTITIES[1]})
        found.append(common | {"microphone": "", "quantity": "velocity[housing.z]"})
    return found


def measure(scene: Scene, folder: Path) -> Path:
    """Measure the machine with noise; return the file of levels."""
    table = rows(scene)
    levels = Levels(measured_machine(scene), read_data(table, scene), ())
    exact = levels.at(np.empty(0), [SEED], scene.fidelity.model, check=True)[0]
    noisy = exact + np.random.default_rng(SEED).normal(0.0, NOISE, len(exact))
    for row, value in zip(table, noisy, strict=True):
        row["value_dB"] = f"{value:.1f}"
    path = folder / "measured.csv"
    write_csv(path, list(table[0]), [[str(cell) for cell in row.values()] for row in table])
    return path


def beside_truth(found: Identified) -> list[list[str]]:
    """Rows of identified values beside the truth."""
    table = []
    for one in found.estimates:
        true = one.free.start * TRUTH[one.key]
        low, high = one.interval()
        inside = "yes" if low <= true <= high else "no"
        table.append([one.key, *(f"{v:.3g}" for v in (one.free.start, true, one.value, low, high)), inside])
    return table


def main(
    output_dir: Annotated[Path, typer.Option(help="Folder for the results.")] = Path("out/identification"),
    quick: Annotated[
        bool, typer.Option("--quick", help="Six starts, three seeds, all in fidelity response.")
    ] = False,
) -> None:
    """Identify a spindle whose truth is known."""
    with refusals():
        output_dir.mkdir(parents=True, exist_ok=True)
        scene = spindle()
        if quick:
            scene = scene.replace({"fidelity.model": "response"})
        (output_dir / "start.toml").write_text(scene.to_toml(), "utf-8")
        data = measure(scene, output_dir)
        settings = {"starts": 6, "seeds": 3} if quick else {}
        found = identify(
            output_dir / "start.toml", data, list(TRUTH), folder=output_dir / "identified", **settings
        )
        write_all(found, output_dir / "identified.toml", output_dir / "start.toml", typer.echo)
        true = {one.key: one.free.start * TRUTH[one.key] for one in found.estimates}
        save(identified_picture(found, true), output_dir / "identification.png")
    heads = ["key", "start", "truth", "identified", "from", "to (2 std)", "truth inside"]
    write_csv(output_dir / "truth.csv", heads, beside_truth(found))
    show("Identified values beside the truth", heads, beside_truth(found))
    typer.echo(misfit_words(found))
    for remark in found.remarks:
        typer.echo(f"* {remark}")


if __name__ == "__main__":
    typer.run(main)
