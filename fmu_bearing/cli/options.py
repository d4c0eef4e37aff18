"""Options that several commands have: each is declared once, so that it means the same everywhere.

``--settle`` has the default `SETTLE` wherever a run is measured at a microphone. Other defaults have their
reason in the help of the command: a result of `simulate` begins at 0, studies take short runs.
"""

from pathlib import Path
from typing import Annotated, Any

import typer

from fmu_bearing.cli.base import refusals
from fmu_bearing.cli.settings import AXIS

#: s: length of a recording, and what is left out before it: by then the start-up has died away.
DURATION, SETTLE = 0.5, 0.1
#: Draws of the surfaces.
SEEDS = 5


def _with_catalogues(context: typer.Context, files: list[Path] | None) -> list[Path] | None:
    """Let the command know the bearings of users' files until it ends."""
    if files:
        from fmu_bearing.scene.entries import using

        context.with_resource(using(files))
    return files


def _picture(path: Path | None) -> Path | None:
    """Refuse a picture that cannot be written, before anything is computed."""
    if path is not None:
        from fmu_bearing.results.picture_parts import check_picture

        with refusals():
            check_picture(path)
    return path


def output(words: str, metavar: str = "FILE") -> Any:
    """Return the declaration of ``--output`` of a command."""
    return typer.Option("--output", "-o", metavar=metavar, help=words)


def settle(words: str) -> Any:
    """Return the declaration of ``--settle``; ``words`` give a default of its own with the reason."""
    return typer.Option("--settle", metavar="S", help=f"Time left out at the beginning, s{words}.")


SceneFile = Annotated[Path, typer.Argument(metavar="SCENE", help="Scene file (TOML).")]
Folder = Annotated[Path, output("Folder for the results.", "FOLDER")]
Force = Annotated[bool, typer.Option("--force", help="Replace files that are there.")]
Json = Annotated[bool, typer.Option("--json", help="Print the result as JSON, for machines.")]
Quick = Annotated[bool, typer.Option("--quick", help="Few variants, short windows: to see that it works.")]
Catalogues = Annotated[
    list[Path] | None,
    typer.Option(
        "--catalogue",
        metavar="FILE",
        callback=_with_catalogues,
        help="TOML file with bearings of your own, which scenes may name; several: one option each. A scene "
        "that names the file itself, under catalogues, needs no option.",
    ),
]
Settings = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        "-s",
        metavar="KEY=VALUE",
        help="Key of the scene (mounting.preload_N=300) or input of the model, in SI units or with a unit "
        "(preload=300, oil_temperature_degC=50), speeds in r/min (shaft_speed_rpm=9000); "
        'a list as in the file, in single quotes: \'KEY=["A","B"]\'; once per key.',
    ),
]
Fidelity = Annotated[
    str | None, typer.Option("--fidelity", metavar="NAME", help="Fidelity in place of the scene's.")
]
RadiationModel = Annotated[
    str | None,
    typer.Option(
        "--radiation-model",
        metavar="NAME",
        help="How sound is radiated, as bem or compact, in place of the scene's.",
    ),
]
Speed = Annotated[
    float | None, typer.Option("--speed", metavar="RPM", help="Shaft speed, r/min, in place of the scene's.")
]
Speeds = Annotated[
    str | None, typer.Option("--speeds", metavar="VALUES", help=f"r/min: {AXIS}; default: the scene's.")
]
Preloads = Annotated[
    str | None, typer.Option("--preloads", metavar="VALUES", help="N, same syntax; default: the scene's.")
]
SurfaceFile = Annotated[
    Path | None,
    typer.Option(
        "--surface",
        metavar="FILE",
        help="Surface found from a vibration test: a scene takes its median law, the range of levels its "
        "draws.",
    ),
]
Step = Annotated[float, typer.Option("--step", metavar="S", help="Communication step, s.")]
Duration = Annotated[
    float, typer.Option("--duration", "-t", metavar="S", help="Length of what is measured, s.")
]
Settle = Annotated[float, settle("")]
Seeds = Annotated[int, typer.Option("--seeds", help="Draws of the surfaces with which levels are compared.")]
Plot = Annotated[
    Path | None,
    typer.Option("--plot", metavar="FILE", callback=_picture, help="Picture to write: .png, .svg or .pdf."),
]
Variables = Annotated[
    list[str] | None,
    typer.Option(
        "--variables",
        "-v",
        metavar="NAME,...",
        help="Variables, with commas between or one option each; * matches any text.",
    ),
]
#: Of a study of many runs.
Figures = Annotated[
    list[str] | None,
    typer.Option(
        "--variables",
        "-v",
        metavar="NAME[:STATISTIC],...",
        help="What is kept, with commas between or one option each, * matches any text; statistics: "
        "mean, rms, min, max, last, 1x.",
    ),
]
Workers = Annotated[
    int | None, typer.Option("--workers", "-w", min=1, help="Processes; default: one per core.")
]
Scheduler = Annotated[
    str | None,
    typer.Option(metavar="ADDRESS", help="Dask scheduler to use in their place, such as tcp://host:8786."),
]
DryRun = Annotated[
    bool, typer.Option("--dry-run", help="Check all runs, time one of them, estimate; run no more.")
]
