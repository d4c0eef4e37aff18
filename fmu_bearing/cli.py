"""The command ``fmu-bearing``: build a scene's FMU, tell what is in it, and study what it rests on."""

from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import track

from fmu_bearing.engine import layout as at
from fmu_bearing.fmi.description import FLAVOURS
from fmu_bearing.fmi.native.optimise import BuildError
from fmu_bearing.fmi.native.platforms import PLATFORMS
from fmu_bearing.fmi.package import BuiltFmu, ChoiceError, check_choice
from fmu_bearing.fmi.package import build as build_fmu
from fmu_bearing.prepare.model import Model, prepare
from fmu_bearing.scene import Scene, SceneError, read_scene
from fmu_bearing.study import choose as choosing
from fmu_bearing.study import sensitivity as moving
from fmu_bearing.study import tradeoff as trading
from fmu_bearing.study.arrays import Refused
from fmu_bearing.study.table import show

app = typer.Typer(help=__doc__, no_args_is_help=True, add_completion=False, pretty_exceptions_enable=False)

SceneFile = Annotated[Path, typer.Argument(metavar="SCENE", help="Scene file (TOML).")]
Output = Annotated[
    Path | None,
    typer.Option("--output", "-o", help="FMU to write; default: Bearing<designation>.fmu here."),
]
Flavour = Annotated[
    str | None,
    typer.Option(
        metavar="|".join(FLAVOURS),
        help="native: compiled, runs without Python; python: runs in the installed package. "
        "Default: native where a library can be made.",
    ),
]
Platforms = Annotated[
    str | None,
    typer.Option(
        metavar="NAME,...",
        help=f"Platforms of a native FMU: {', '.join(PLATFORMS)}, or all; default: this machine's.",
    ),
]
Folder = Annotated[Path, typer.Option("--output", "-o", help="Folder for the results.")]
Quick = Annotated[bool, typer.Option("--quick", help="Few variants, short windows: to see that it works.")]

_errors = Console(stderr=True)
_track = partial(track, console=_errors)  # results alone go to standard output


@contextmanager
def refusals() -> Iterator[None]:
    """Tell refusals in a line of the user's own terms and end with code 2; no traceback."""
    try:
        yield
    except (SceneError, Refused, BuildError, ChoiceError, OSError) as error:
        message = "; ".join(line.strip() for line in str(error).splitlines() if line.strip())
        typer.echo(f"error: {message}", err=True)
        raise typer.Exit(2) from None


def model_of(scene: Scene) -> Model:
    """Model of a scene; one of level ``auto`` is resolved first, told, and noted in the model."""
    if scene.fidelity.level == "auto":
        typer.echo("level auto: probing the scene against level full (kept for the next time)", err=True)
    resolved, choice = choosing.resolve(scene)
    note = "" if choice is None else choice.summary
    if note:
        typer.echo(note)
    return prepare(resolved, note=note)


def build_scene(
    scene: Path, output: Path | None, flavour: str | None = None, platforms: str | None = None
) -> BuiltFmu:
    """Write the FMU of a scene file; see :func:`fmu_bearing.fmi.package.build`.

    ``platforms``: names with commas between, or ``all``.
    """
    names = list(PLATFORMS) if platforms == "all" else [n.strip() for n in (platforms or "").split(",")]
    wanted = [name for name in names if name]
    check_choice(flavour, wanted)
    return build_fmu(model_of(read_scene(scene)), output, flavour, wanted, partial(typer.echo, err=True))


@app.command()
def build(
    scene: SceneFile, output: Output = None, flavour: Flavour = None, platforms: Platforms = None
) -> None:
    """Build the co-simulation FMU (FMI 2.0) of a scene."""
    with refusals():
        typer.echo(f"built {build_scene(scene, output, flavour, platforms)}")


@app.command()
def info(scene: SceneFile) -> None:
    """Tell what a scene is computed with, and its sizes."""
    with refusals():
        found = read_scene(scene)
        auto = found.fidelity.level == "auto"
        model = prepare(found, level="full") if auto else prepare(found)
    p, fidelity = model.parameters, found.fidelity
    # an instance copies the parameters and keeps its last state beside the present one
    places = p.size + 2 * at.state_size(p) + at.work_size(p)
    places += at.z_size(model.n_balls, model.n_mics, model.n_bands, model.n_modes)
    typer.echo(f"scene      {found.name}: {found.bearing.designation}, {found.operation.speed_rpm:g} r/min")
    if auto:
        bounds = fidelity.accuracy
        typer.echo(
            f"level      auto, within {bounds.level_dB:g} dB and {bounds.relative:g} of level full; "
            "`fmu-bearing choose` tells which; sizes are those of full"
        )
    else:
        method = f", method {fidelity.method}" if fidelity.level == "full" else ""
        typer.echo(
            f"level      {fidelity.level}{method}, internal steps up to "
            f"{fidelity.max_internal_step_us:g} us, tolerance {fidelity.tolerance:g}"
        )
    typer.echo(f"balls      {model.n_balls}, traction strips {fidelity.traction_strips}")
    typer.echo(f"sound      {_sound_line(found)}")
    typer.echo(f"variables  {len(model.variables)}")
    typer.echo(f"memory     {8e-6 * places:.2f} MB for the arrays of one instance")


def _sound_line(scene: Scene) -> str:
    if scene.sound is None:
        return "none"
    return f"{scene.sound.rung}, {scene.sound.radiator}, {len(scene.microphones)} microphones"


@app.command()
def choose(scene: SceneFile) -> None:
    """Tell which level, method and step meet the scene's accuracy, and how every candidate did."""
    with refusals():
        choice = choosing.chosen(read_scene(scene))
    show(f"{choice.scene}: errors against level full", choosing.COLUMNS, choice.cells(), width=110)
    typer.echo(choice.summary)


@app.command()
def tradeoff(
    scene: SceneFile,
    output: Folder = Path("out/tradeoff"),
    quick: Quick = False,
    chart: Annotated[
        Path | None, typer.Option(help="Chart to write; default: tradeoff.png in the folder.")
    ] = None,
) -> None:
    """Measure error and speed of levels, methods, steps, strips and terms; write table and chart."""
    from fmu_bearing.study.chart import draw  # Matplotlib loads slowly, and `build` has no use for it

    with refusals():
        bar = partial(_track, description="variants")
        if quick:
            study = trading.tradeoff(
                read_scene(scene), trading.QUICK, warm_up=0.005, window=0.005, budget=0.01, track=bar
            )
        else:
            study = trading.tradeoff(read_scene(scene), track=bar)
        trading.write(study, output)
        chart = chart or output / "tradeoff.png"
        draw(study, chart)
    show(f"{study.scene}: accuracy and cost", trading.COLUMNS, study.cells())
    typer.echo(f"written: {output / 'tradeoff.md'}, {output / 'tradeoff.csv'}, {chart}")


@app.command()
def sensitivity(scene: SceneFile, output: Folder = Path("out/sensitivity"), quick: Quick = False) -> None:
    """Move every assumed value of a scene and tell what changes."""
    with refusals():
        bar = partial(_track, description="moves")
        if quick:
            study = moving.sensitivity(
                read_scene(scene), moving.QUICK, warm_up=0.005, window=0.005, track=bar
            )
        else:
            study = moving.sensitivity(read_scene(scene), track=bar)
        moving.write(study, output)
    show(f"{study.scene}: what rests on assumed values", moving.COLUMNS, study.cells())
    typer.echo(f"written: {output / 'sensitivity.md'}, {output / 'sensitivity.csv'}")
