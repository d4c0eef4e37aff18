"""``fmu-bearing info``: what a scene is computed with."""

import typer

from fmu_bearing.cli.base import SceneFile, app, refusals
from fmu_bearing.engine import layout as at
from fmu_bearing.prepare.model import prepare
from fmu_bearing.scene import Scene, read_scene


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
