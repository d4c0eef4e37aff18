"""Operating point, kinematic frequencies, assumptions and choices."""

import math

from fmu_bearing.acoustics.analysis.spectrum import KinematicFrequencies
from fmu_bearing.engine.constants import RPM
from fmu_bearing.prepare.step_limits import longest_internal_step
from fmu_bearing.reports.data.subject import Subject
from fmu_bearing.reports.page.blocks import Absent, Block, Folded, Section, Table, Words
from fmu_bearing.reports.sections.assumptions import assumed_table
from fmu_bearing.reports.sections.kinematic_marks import OTHER_NAMES
from fmu_bearing.scene import Scene
from fmu_bearing.scene.bearing import Cage
from fmu_bearing.scene.member import set_of
from fmu_bearing.scene.words import bearings_words, conditions_words, materials_words

_FIDELITIES = {
    "full": "all bodies move: rings, cage and every ball, with sliding, film, pockets and lands",
    "rings": "rings move in time; each ball is where both contacts balance it, the cage turns with "
    "them; torque and heats are computed at the operating point; no slip, no motion of the cage",
    "response": "linear response of the rings about the steady state, as a sum of lines; no slip, no "
    "motion of the "
    "cage, nothing that a change sets ringing",
}
_MODELS = {
    "bem": "boundary elements on bodies of revolution, everything scattering on everything",
    "compact": "rings, cage and housing as dipoles, balls as spheres on their orbit; no body shields another",
    "paper": "the multi-source paper as printed; energies are added",
    "paper_vector": "the multi-source paper's filters on vectors",
    "paper_contacts": "the sound-field paper's sources at the contact points",
    "table": "the user's transfer functions",
    "recorded": "pressures as they were recorded",
}
_RADIATORS = {
    "bare": "the bare bearing",
    "baffle": "its face, flush in a rigid plane",
    "housing": "the housing",
}
_FREQUENCY_WORDS = {
    "f_r": "turns of the shaft",
    "f_c": "turns of the cage",
    "f_b": "turns of a ball about itself",
    "f_i": "balls passing a place of the inner race",
    "f_o": "balls passing a place of the outer race",
}


def conditions(subject: Subject) -> Section:
    """Operating point and kinematic frequencies."""
    blocks: list[Block] = [_operation(subject), _kinematics(subject)]
    return Section("conditions", "Operating point", blocks)


def _operation(subject: Subject) -> Table:
    scene = subject.scene
    rpm, imperfections = subject.speed / RPM, scene.imperfections
    rows = [
        ["bearing", f"{bearings_words(scene)}: {_sizes(scene)}"],
        ["materials", materials_words(scene)],
        ["shaft speed", f"{rpm:,.0f} r/min" + _variation(subject)],
        *(_on_shaft(scene) if subject.several else _mounted(scene)),
        ["lubrication and temperatures", conditions_words(scene)],
        ["cage", "; ".join(dict.fromkeys(_cage(one.cage) for one in scene.geometries))],
        ["imperfections", "none: a perfect bearing" if imperfections is None else
         f"seed {imperfections.seed}, unbalance {imperfections.unbalance_um:g} um, balls within "
         f"+-{imperfections.ball_diameter_spread_nm:g} nm, waviness orders from {imperfections.lowest_order} "
         f"to {imperfections.highest_order or f'{imperfections.highest_frequency_kHz:g} kHz'}, balls' form "
         f"{imperfections.ball_form_nm:g} nm"],
        *([f"defect {k}", one.words]
          for k, one in enumerate(imperfections.defect if imperfections else (), start=1)),
        ["fidelity", f"{scene.fidelity.model}: {_FIDELITIES.get(scene.fidelity.model, '')}"],
        ["method", _method(scene)],
        ["sound", _sound(subject)],
    ]  # fmt: skip
    return Table("Operating point and method", ["", ""], rows)


def _sizes(scene: Scene) -> str:
    """Return the sizes of each kind of bearing."""
    return "; ".join(dict.fromkeys(
        f"{b.bore_mm:g} x {b.outside_diameter_mm:g} x {b.width_mm:g} mm, {b.ball_count} balls of "
        f"{b.ball_diameter_mm:g} mm, {b.angle_words}"
        for b in scene.geometries
    ))  # fmt: skip


def _cage(cage: Cage | None) -> str:
    return "none" if cage is None else (
        f"{cage.width_mm:g} mm wide, pockets of {cage.pocket_diameter_mm:g} mm"
    )  # fmt: skip


def _mounted(scene: Scene) -> list[list[str]]:
    """Return what loads and holds a single bearing."""
    m = scene.mounted
    return [
        ["preload", f"{m.preload_N:g} N along the axis, by "
        f"{'a constant force' if m.preload_mode == 'force' else 'rigid distance'}"],
        ["radial load on the inner ring, given", f"y {m.radial_load_y_N:g} N, z {m.radial_load_z_N:g} N"],
        ["misalignment", f"about y {m.misalignment_y_mrad:g} mrad, about z {m.misalignment_z_mrad:g} mrad"],
        ["pedestal stiffness", f"{1e-6 * m.pedestal_stiffness_N_m:.4g} N/um"],
    ]  # fmt: skip


def _on_shaft(scene: Scene) -> list[list[str]]:
    """Return what loads and holds the shaft of a set."""
    spindle, preload = set_of(scene), scene.assembly.preload
    load, housing = spindle.load, spindle.housing
    pedestal = "at rest"
    if housing.pedestal_stiffness_N_m is not None:
        pedestal = f"pedestal stiffness {1e-6 * housing.pedestal_stiffness_N_m:.4g} N/um"
    return [
        ["preload", "none" if preload is None else f"{scene.assembly.preload_N:g} N, by {preload.kind}s"],
        ["load on the shaft", f"x {load.force_x_N:g} N, y {load.force_y_N:g} N, z {load.force_z_N:g} N, "
         f"{load.position_mm:g} mm from the nose"],
        ["shaft", "bends" if spindle.shaft.flexible else "rigid"],
        ["housing", pedestal],
    ]  # fmt: skip


def _variation(subject: Subject) -> str:
    speed = subject.recording.speed
    low, high = float(speed.min()) / RPM, float(speed.max()) / RPM
    return "" if high - low < 0.5 else f" in the mean, from {low:,.0f} to {high:,.0f} r/min"


def _method(scene: Scene) -> str:
    f = scene.fidelity
    name = f"{f.method}, " if f.model == "full" else ""
    return (
        f"{name}internal steps up to {1e6 * longest_internal_step(scene):.3g} us, tolerance {f.tolerance:g}, "
        f"{f.traction_strips} strips per contact"
    )


def _sound(subject: Subject) -> str:
    scene = subject.scene
    radiator = "" if scene.sound is None else f"; radiator: {_RADIATORS[scene.sound.radiator]}"
    return f"radiation model {subject.radiation_model}: {_MODELS.get(subject.radiation_model, '')}{radiator}"


def _kinematics(subject: Subject) -> Table:
    recording, kinematics = subject.recording, subject.kinematics.values()
    each, whirls, rows = recording.bearing_kinematics(), recording.whirls(), []
    for name in KinematicFrequencies._fields:
        orders = [f"{getattr(one, name) / one.f_r:.4f}" for one in kinematics if one.f_r]
        order = " / ".join(dict.fromkeys(orders))
        cells = [f"{getattr(one, name):.2f}" for one in each]
        rows.append([name, OTHER_NAMES[name], _FREQUENCY_WORDS[name], *cells, order])
    for line in recording.defect_lines():
        shown = [f"{line.frequency:.2f}" if k == line.bearing else "" for k in range(len(each))]
        order = f"{line.frequency / each[line.bearing].f_r:.4f}" if each[line.bearing].f_r else ""
        words = f"balls past {line.defect}, with side bands by {line.modulator}: {line.words}"
        rows.append([line.name, "", words, *shown, order])
    if not all(map(math.isnan, whirls)):
        cells = ["" if math.isnan(whirl) else f"{whirl:.2f}" for whirl in whirls]
        rows.append(["f_w", "", "turns of the cage about the middle of the inner ring", *cells, ""])
    columns = [f"{words}{words and ', '}frequency, Hz" for words in subject.prefixes]
    if not recording.turning_known:
        kept = any(subject.has(f"{prefix}contact.outer.angle_mean") for prefix in subject.prefixes.values())
        angle = "the mean of the computed contact angles" if kept else "the nominal contact angle"
        note = f"Rolling without sliding at {angle}: the run kept no rates of cage and balls."
    else:
        note = "As cage and balls turned in the mean of the run."
        for one, (words, prefix) in zip(each, subject.prefixes.items(), strict=True):
            if one.f_r and subject.fidelity == "full" and subject.has(f"{prefix}cage.speed_ratio"):
                turned = subject.mean(f"{prefix}cage.speed_ratio")
                slip = 100.0 * (turned * one.f_r / one.f_c - 1.0)
                note += f" The cage{words and f' of {words}'} turned at {turned:.5f} of the shaft's speed, "
                # without the sign of a zero
                note += f"{round(slip, 2) + 0.0:+.2f} % from the balls."
    return Table("Kinematic frequencies", ["", "also called", "counts", *columns, "order"], rows, note=note)


def assumptions(subject: Subject) -> Section:
    """Assumed values, choices, the scene itself."""
    scene = subject.scene
    blocks: list[Block] = [
        Words("The figures depend on the assumptions and choices listed here."),
        assumed_table(scene, subject.origins),
        _choices(subject),
        Folded("The scene, to run it again", subject.scene_text or scene.to_toml()),
    ]
    return Section("assumptions", "Assumptions and choices", blocks)


def _choices(subject: Subject) -> Table:
    scene, recording = subject.scene, subject.recording
    off = [name.replace("_", " ") for name, on in scene.fidelity.terms.model_dump().items() if not on]
    steps = f"{1e6 * subject.step:.4g} us" if subject.time.size > 1 else ""
    rows = [
        ["fidelity", scene.fidelity.model, _FIDELITIES.get(scene.fidelity.model, "")],
        ["radiation", subject.radiation_model, _MODELS.get(subject.radiation_model, "")],
        ["forces left out", ", ".join(off) or "none", "fidelity.terms"],
        ["rings", "bending" if scene.bends else "rigid", f"{scene.assembly.table}.flexure"],
        ["oil", scene.lubricant.viscosity_law, f"viscosity {scene.lubricant.viscosity_Pa_s:g} Pa s at 20 "
        f"degC; "
         f"traction law {scene.lubricant.traction_law}"],
        ["temperatures", "held", "temperatures are constant during the run; the heats do not change them"],
        ["recorded", f"{recording.size / recording.rate:.4g} s", f"after {recording.start:.3g} s in which "
        f"the start dies away"],
        ["communication step", steps, "between the points at which variables were read"],
        ["sound", f"{recording.rate:g} Hz", "20 Hz to 20 kHz; free field unless the scene says otherwise"],
    ]  # fmt: skip
    if scene.sound is not None:
        s = scene.sound
        rows.append(["air", f"{s.air_density_kg_m3:g} kg/m3", f"sound speed {s.sound_speed_m_s:g} m/s"])
    return Table("Choices", ["what", "choice", "which means"], rows, folded=True)


def source_words(subject: Subject) -> str:
    """Bearing and speed in a line."""
    try:
        scene = subject.scene
    except Absent:
        return "a recording without scene"
    speed = f"{subject.speed / RPM:,.0f} r/min"
    return f"{bearings_words(scene)} at {speed}, preload {scene.assembly.preload_N:g} N"
