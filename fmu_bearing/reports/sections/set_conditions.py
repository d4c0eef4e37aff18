"""Of a set: its operating point, what is assumed, and the range of its level."""

from collections.abc import Sequence

from fmu_bearing.progress import Tell
from fmu_bearing.recording.studies.spread import Spread, spread
from fmu_bearing.reports.data.microphones import Microphones
from fmu_bearing.reports.data.subject import Subject
from fmu_bearing.reports.page.blocks import Block, Folded, Table, Words
from fmu_bearing.reports.sections.assumptions import assumed_table
from fmu_bearing.scene import Scene
from fmu_bearing.scene.member import set_of
from fmu_bearing.scene.origins import Origin
from fmu_bearing.scene.words import conditions_words, materials_words


def level_range(run: Subject, microphones: Microphones, tell: Tell) -> Spread | None:
    """Return the range of the level at the loudest microphone; None where there is none."""
    tell("range of the level over seeds and assumed surfaces")
    try:
        name = microphones.names[microphones.loudest]
        return spread(run.recording, [name], radiation_model=run.radiation_model)
    except ValueError:
        return None  # no waviness


def set_conditions(scene: Scene) -> Table:
    """Return bearing, materials, speed, supply and temperatures."""
    b, spindle = scene.bearing, set_of(scene)
    flaws, preload = scene.imperfections, spindle.preload
    rows = [
        ["bearings", f"{len(spindle.bearing)} x {b.designation}, {spindle.arrangement}: {b.bore_mm:g} x "
         f"{b.outside_diameter_mm:g} x {b.width_mm:g} mm, {b.ball_count} balls of {b.ball_diameter_mm:g} mm, "
         f"contact angle {b.contact_angle_deg:g} deg"],
        ["materials", materials_words(scene)],
        ["speed", f"{scene.operation.speed_rpm:,.0f} r/min"],
        ["preload", "none" if preload is None else f"by {preload.kind}s"],
        ["lubrication and temperatures", conditions_words(scene)],
        ["shaft", "bends" if spindle.shaft.flexible else "rigid"],
        ["imperfections", "none: perfect bearings" if flaws is None else f"seed {flaws.seed}, of the sound "
         "and error motion alone"],
        ["fidelity of the run", scene.fidelity.model],
    ]  # fmt: skip
    return Table("Operating point", ["", ""], rows)


def set_assumptions(scene: Scene, whence: Sequence[Origin], text: str) -> list[Block]:
    """Return the assumed values, and the scene itself."""
    return [
        Words("The figures depend on the assumptions listed here."),
        assumed_table(scene, whence),
        Folded("The scene, to run it again", text or scene.to_toml()),
    ]
