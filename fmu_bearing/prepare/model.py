"""The model: one scene as the flat parameter array of the engine, with the names of its variables."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.special import roots_jacobi

from fmu_bearing.elastic.modes import ring_modes
from fmu_bearing.elastic.section import INNER, OUTER, ring_section
from fmu_bearing.engine.choices import FIDELITIES, GUIDANCES, METHODS, RACE_CONTROLS
from fmu_bearing.engine.layout import DE, FOUR, MAX_DEFECTS, SD, STRIDE, P, Q
from fmu_bearing.formulas.hertz import effective_modulus, point_contact
from fmu_bearing.interface import Variable, variables
from fmu_bearing.interface.inputs import input_values
from fmu_bearing.prepare import bodies, contacts, fits
from fmu_bearing.prepare.accelerometers import sensor_blocks
from fmu_bearing.prepare.defect_blocks import block, of_scene, pass_rate
from fmu_bearing.prepare.flexure import inner_modes, longest_step, mode_table
from fmu_bearing.prepare.imperfections import (
    ball_oversizes,
    ball_waves,
    fastest_wave,
    intervals,
    order_table,
    race_harmonics,
    wave_table,
)
from fmu_bearing.prepare.lengths import Lengths, lengths
from fmu_bearing.prepare.sound_block import sound_blocks
from fmu_bearing.prepare.spindle import as_set_of_one, pack_set, pedestal_axes
from fmu_bearing.prepare.step_limits import turn_rate
from fmu_bearing.prepare.surfaces import form_rows
from fmu_bearing.scene import Scene, SceneError, si
from fmu_bearing.scene.bearing import Cage
from fmu_bearing.scene.material import Material
from fmu_bearing.scene.member import SceneBearing
from fmu_bearing.scene.read import with_fidelity
from fmu_bearing.scene.sound import Sound

# Assumed for the cage (see docs/theory): Hunt-Crossley factor, slip scales, dry stop of the lands.
_POCKET_DAMPING = 5.0  # s/m
_POCKET_SLIP = 0.05  # m/s
_STOP_STIFFNESS = 5e6  # N/m
_STOP_FRACTION = 0.96
_STOP_FRICTION = 0.05
_STOP_SLIP = 0.1  # m/s
_NARROWEST, _WIDEST = 5e-6, 2e-3  # m: clearance of a land, as the scene's key is bounded


@dataclass(frozen=True)
class Model:
    """Input of a run: numbers for the engine and the table of variables.

    Attributes
    ----------
    scene : Scene
    parameters : ndarray
        Flat parameter array ``p`` of the engine, read-only.
    variables : tuple of Variable
    note : str
        Remark for the documentation, such as why its fidelity was chosen.
    """

    scene: Scene
    parameters: NDArray[np.float64]
    variables: tuple[Variable, ...]
    note: str = ""

    @property
    def lengths(self) -> Lengths:
        """Lengths of the engine's other arrays."""
        return lengths(self.parameters)

    @property
    def inputs(self) -> NDArray[np.float64]:
        """Inputs ``u`` at the scene's operating point, inputs of a set that are no variables included."""
        return input_values(self.scene)

    @property
    def left_out(self) -> frozenset[str]:
        """Names of variables that the scene has and this model does not show."""
        return frozenset()

    @property
    def n_balls(self) -> int:
        """Number of balls."""
        return int(self.parameters[P.BALLS])

    @property
    def n_mics(self) -> int:
        """Number of microphones."""
        return int(self.parameters[P.MICS])

    @property
    def n_modes(self) -> int:
        """Number of flexural modes of both rings."""
        return int(self.parameters[P.MODES])


def prepare(
    scene: Scene, *, fidelity: str | None = None, method: str | None = None, max_step: float | None = None,
    note: str = "", samples: bool = False,
) -> Model:  # fmt: skip
    """Turn a scene into a model.

    Parameters
    ----------
    scene : Scene
    fidelity, method : str, optional
        Fidelity and integrator in place of the scene's. A scene whose fidelity is ``auto`` needs
        ``fidelity``, because only runs of the scene show which one is accurate enough.
    max_step : float, optional
        Largest internal step (s) in place of the scene's.
    note : str, optional
        The model's ``note``.
    samples : bool
        Sample the sound in fidelity response, too, where it could be a sum of lines.

    Returns
    -------
    Model
        Its scene is the one computed, with the values given here in its ``fidelity``.

    Raises
    ------
    SceneError
        Where a value is refused, the fidelity is still ``auto``, or the sound cannot be computed.
    """
    keys = {
        "model": fidelity,
        "method": method,
        "max_internal_step_us": None if max_step is None else 1e6 * max_step,
    }
    given = {key: value for key, value in keys.items() if value is not None}
    if given:
        scene = with_fidelity(scene, **given)
    _require_computable(scene)
    try:
        sounds = sound_blocks(scene, lines=False if samples else None)
        sensors = sensor_blocks(scene)
    except ValueError as problem:
        raise SceneError(f"{scene.name}: {problem}") from None
    parameters = pack(scene, *sounds, sensors=sensors)
    parameters.setflags(write=False)
    table = variables(scene, bodies.rotor_inertia(scene), bodies.rings_at_port(scene))
    return Model(scene, parameters, table, note)


def _require_computable(scene: Scene) -> None:
    model = scene.fidelity.model
    if model not in FIDELITIES:
        raise SceneError(
            f"{scene.name}: fidelity.model = '{model}' must be resolved first, to one of "
            + ", ".join(FIDELITIES)
        )


def pack(
    scene: Scene, *sounds: NDArray[np.float64], sensors: Sequence[NDArray[np.float64]] | None = None
) -> NDArray[np.float64]:
    """Parameter array ``p`` for a scene, of a set too, and its sound block (empty: no sound).

    A set has one sound block for each bearing, or a single empty one. ``sensors``: the block of
    accelerometers of each bearing; default: no accelerometers, whatever the scene has.

    Raises
    ------
    SceneError
        If the scene's fidelity is ``auto``.
    """
    _require_computable(scene)
    bearings = scene.bearings()
    blocks = sounds if len(sounds) == len(bearings) else len(bearings) * sounds
    sensing = sensors or [np.zeros(0)] * len(bearings)
    packed = [
        _pack(*own, scene, len(scene.accelerometers) if sensors else 0)
        for own in zip(bearings, blocks, sensing, strict=True)
    ]
    fits.share(packed)
    return pack_set(scene, packed) if scene.assembly.joined else as_set_of_one(packed[0])


def _pack(
    bearing: SceneBearing[Scene],
    sound: NDArray[np.float64],
    sensors: NDArray[np.float64],
    whole: Scene,
    accelerometers: int,
) -> NDArray[np.float64]:
    """Return the parameters of one bearing of the ``whole`` scene, which has microphones and defects.

    ``sensors``: the block of its own accelerometers, of which the scene has so many.
    """
    scene = fits.loose(bearing.scene)
    defects = of_scene(scene, list(whole.defects_of(bearing.number - 1)))
    nodes, weights = roots_jacobi(scene.fidelity.traction_strips, 1.0, 1.0)
    # what the scene leaves out is an empty table: it takes no place, and its offset is 0
    waves = race_harmonics(scene)
    highest = max(max(race.orders, default=0) for race in waves)
    form, axes = ball_waves(scene)
    wavy = any(race.amplitudes.any() for race in waves)
    tables = {
        P.AT_STRIPS: np.concatenate([nodes, weights / weights.sum()]),
        P.AT_OVERSIZE: _lanes(ball_oversizes(scene)),
        P.AT_WAVES: _joined([wave_table(race, intervals(highest)) for race in waves] if wavy else []),
        P.AT_ORDERS: _joined([order_table(race, highest) for race in waves] if wavy else []),
        P.AT_FORM: form_rows(form) if form.size else form,
        P.AT_AXES: _joined([_lanes(row) for row in axes] if form.size else []),
        P.AT_SOUND: sound,
        P.AT_SENSORS: sensors,
        P.AT_MODES: _modes(scene),
        P.AT_DEFECTS: block(defects),
    }
    p = np.zeros(P.TABLES + sum(table.size for table in tables.values()))
    start = P.TABLES
    for place, table in tables.items():
        if table.size:
            p[place] = start
            p[start : start + table.size] = table
            start += table.size
    p[P.BALLS] = scene.bearing.ball_count
    p[P.LANES] = FOUR * math.ceil(scene.bearing.ball_count / FOUR)
    p[P.WAVINESS] = float(tables[P.AT_WAVES].size > 0)
    p[P.BALL_WAVES] = form.size
    p[P.WAVE_INTERVALS] = intervals(highest)
    p[P.WAVE_ORDERS] = highest if wavy else 0
    p[P.WAVE_RATE] = fastest_wave(scene, waves, int(p[P.BALL_WAVES]))
    p[P.DEFECTS] = len(defects)
    p[P.BALL_DEFECTS] = sum(one.on == DE.BALL for one in defects)
    p[P.PASS_RATE] = pass_rate(scene, defects)
    p[P.TURN_RATE] = turn_rate(scene, silent=sound.size == 0 and accelerometers == 0)
    if tables[P.AT_MODES].size:
        p[P.MODES] = tables[P.AT_MODES].size // P.MODE_SIZE
        p[P.INNER_MODES] = inner_modes(tables[P.AT_MODES])
        p[P.MODE_STEP] = longest_step(tables[P.AT_MODES], scene.fidelity.method)
    _fidelity(scene, p)
    _sound(whole, sound, p)
    if accelerometers:
        _sensor_block(whole, sensors, p, accelerometers)
    contacts.oil(scene, p)
    contacts.balls(scene, p)
    contacts.races(scene, p)
    fits.write(scene, p)
    _mounting(scene, p)
    if scene.bearing.cage is not None and scene.materials.cage is not None:
        _cage(scene, scene.bearing.cage, scene.materials.cage, p)
    return p


def _modes(scene: Scene) -> NDArray[np.float64]:
    try:
        return mode_table(scene, ring_modes(scene))
    except ValueError as problem:
        raise SceneError(f"{scene.name}: mounting.flexure: {problem}") from None


def _joined(tables: list[NDArray[np.float64]]) -> NDArray[np.float64]:
    """Tables one after the other; empty where there are none."""
    return np.concatenate(tables) if tables else np.empty(0)


def _lanes(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """One value per lane; spare lanes copy ball 0."""
    row = np.full(STRIDE, values[0])
    row[: values.size] = values
    return row


def _fidelity(scene: Scene, p: NDArray[np.float64]) -> None:
    fidelity = si(scene.fidelity)
    p[P.FIDELITY] = FIDELITIES.index(fidelity.model)
    p[P.METHOD] = METHODS[fidelity.method]
    p[P.RACE_CONTROL] = RACE_CONTROLS.index(fidelity.race_control)
    p[P.STRIPS] = fidelity.traction_strips
    p[P.TOLERANCE] = fidelity.tolerance
    p[P.MAX_STEP] = fidelity.max_internal_step
    p[P.IMPERFECTION_SCALE] = 1.0
    p[P.DEFECT_SCALE : P.DEFECT_SCALE + MAX_DEFECTS] = 1.0
    terms = scene.fidelity.terms
    p[P.GRAVITY] = terms.gravity
    p[P.DRAG] = terms.drag
    p[P.ROLLING] = terms.rolling_resistance
    p[P.REDUCTION] = terms.rolling_reduction
    p[P.LAND] = 1.0  # the dry stop stays: without it nothing would carry the cage
    p[P.GYROSCOPIC] = terms.gyroscopic
    p[P.READ_BALLS] = p[P.READ_SOUND] = p[P.READ_SENSORS] = 1.0


def _sound(scene: Scene, sound: NDArray[np.float64], p: NDArray[np.float64]) -> None:
    if scene.sound is not None:
        p[P.TIME_WEIGHTING] = 0.125 if scene.sound.time_weighting == "fast" else 1.0
        p[P.METERING_START] = si(scene.sound).metering_start
    if sound.size:
        p[P.SOUND_SIZE] = sound.size
        p[P.SOUND_STATE] = SD.state_size(sound)
        p[P.SOUND_WORK] = SD.work_size(sound)
        p[P.MICS] = len(scene.microphones)
        p[P.BANDS] = sound[SD.H_BANDS]


def _sensor_block(scene: Scene, sensors: NDArray[np.float64], p: NDArray[np.float64], count: int) -> None:
    """Write places of the accelerometers behind those of the sound; without sound its default begins."""
    if scene.sound is None:
        p[P.METERING_START] = Sound.model_fields["metering_start_s"].default
    p[P.ACCELEROMETERS] = count
    if sensors.size:
        p[P.SENSORS_SIZE] = sensors.size
        p[P.SENSORS_STATE], p[P.SENSORS_WORK] = p[P.SOUND_STATE], p[P.SOUND_WORK]
        p[P.SOUND_STATE] += SD.state_size(sensors)
        p[P.SOUND_WORK] += SD.work_size(sensors)


def _mounting(scene: Scene, p: NDArray[np.float64]) -> None:
    mounting = si(scene.mounted)
    inner = bodies.inner_ring(scene) + bodies.rotor(scene)
    outer = bodies.outer_ring(scene) + bodies.housing(scene)
    p[P.INNER_MASS], p[P.INNER_TRANSVERSE], p[P.INNER_POLAR] = inner.mass, inner.transverse, inner.polar
    p[P.OUTER_MASS], p[P.OUTER_TRANSVERSE], p[P.OUTER_POLAR] = outer.mass, outer.transverse, outer.polar
    p[P.RIGID] = scene.mounted.preload_mode == "rigid"
    p[P.MISALIGNMENT_Y] = mounting.misalignment_y
    p[P.MISALIGNMENT_Z] = mounting.misalignment_z
    p[P.AXIAL_RATIO] = mounting.pedestal_axial_ratio
    p[P.ROTATIONAL_RATIO] = mounting.pedestal_rotational_ratio
    p[P.PEDESTAL_ZETA] = mounting.pedestal_damping_ratio
    p[P.PEDESTAL_Y : P.PEDESTAL_Y + 6] = pedestal_axes(scene.mounted)
    p[P.SEAL_TORQUE] = scene.bearing.seal_torque / 1e3  # N mm
    for support in bodies.supports(scene.mounted, inner.mass, inner.transverse):
        p[P.SUPPORT_STIFFNESS : P.SUPPORT_STIFFNESS + Q.OUTER] += support.stiffness
        p[P.SUPPORT_DAMPING : P.SUPPORT_DAMPING + Q.OUTER] += support.damping
    if p[P.RIGID]:  # the mount holds the ring along the axis
        p[P.SUPPORT_STIFFNESS] = p[P.SUPPORT_DAMPING] = 0.0
    if scene.imperfections is not None:
        p[P.ECCENTRICITY] = si(scene.imperfections).unbalance


def land_clearance(scene: Scene, cage: Cage) -> float:
    """Radial clearance (m) between a cage and the lands that guide it: the scene's, or what the cage leaves.

    The lands are a ring's shoulders, which are where the grooved ring has the mass that its effective
    diameter gives it (`elastic.section`): as good as that diameter is. 0 for a cage that the balls guide.

    Raises
    ------
    SceneError
        Where the scene gives none and the cage leaves none that it can have.
    """
    if cage.guidance == "balls":
        return 0.0
    if cage.land_clearance_mm is not None:
        return float(si(cage).land_clearance)
    absent = f"{scene.name}: bearing.cage.land_clearance_mm is absent, and"
    inside = cage.guidance == "inner"
    try:
        section = ring_section(scene, INNER if inside else OUTER)
    except ValueError as problem:
        raise SceneError(f"{absent} {problem}, or give land_clearance_mm") from None
    if inside:
        key, ring, shoulder = "bore_mm", "above the inner", section.high
        own, effective = cage.bore_mm, "inner_ring_outer_diameter_mm"
        clearance = own / 2e3 - shoulder
    else:
        key, ring, shoulder = "outside_diameter_mm", "below the outer", section.low
        own, effective = cage.outside_diameter_mm, "outer_ring_inner_diameter_mm"
        clearance = shoulder - own / 2e3
    if not _NARROWEST <= clearance <= _WIDEST:
        raise SceneError(
            f"{absent} {key} = {own:g} leaves {1e3 * clearance:.3f} mm {ring} ring's "
            f"shoulders of {2e3 * shoulder:.2f} mm (from {effective} and the groove), not "
            f"{1e3 * _NARROWEST:g} to {1e3 * _WIDEST:g}: give land_clearance_mm, or correct a diameter"
        )
    return clearance


def _cage(scene: Scene, cage_table: Cage, material: Material, p: NDArray[np.float64]) -> None:
    b, c = si(scene.bearing), si(cage_table)
    body = bodies.cage(scene)
    p[P.CAGE] = 1.0
    p[P.CAGE_MASS], p[P.CAGE_TRANSVERSE], p[P.CAGE_POLAR] = body.mass, body.transverse, body.polar
    p[P.CAGE_ECCENTRICITY] = c.mass_eccentricity
    p[P.POCKET_CLEARANCE] = (c.pocket_diameter - b.ball_diameter) / 2
    ball, cage = si(scene.materials.balls), si(material)
    modulus = effective_modulus(
        cage.youngs_modulus, cage.poisson_ratio, ball.youngs_modulus, ball.poisson_ratio
    )
    # ball in a radial bore: closely conforming around the bore, a plain ball along it; in a sphere both ways
    across = 1.0 / (2.0 / b.ball_diameter - 2.0 / c.pocket_diameter)
    along = across if c.guidance == "balls" else b.ball_diameter / 2
    p[P.POCKET_STIFFNESS] = point_contact(along, across, modulus).stiffness
    p[P.POCKET_DAMPING] = _POCKET_DAMPING
    p[P.POCKET_FRICTION] = c.pocket_friction if scene.fidelity.terms.pocket_friction else 0.0
    p[P.POCKET_SLIP] = _POCKET_SLIP
    p[P.POCKET_FILM] = c.pocket_damping
    p[P.GUIDANCE] = GUIDANCES.index(c.guidance)
    if c.guidance == "balls":
        p[P.LAND] = 0.0
        return
    p[P.LAND_CLEARANCE] = clearance = land_clearance(scene, cage_table)
    p[P.LAND_RADIUS] = c.bore / 2 - clearance if c.guidance == "inner" else c.outside_diameter / 2
    p[P.LAND_LENGTH] = (c.width - c.pocket_diameter) / 2
    p[P.LAND_OFFSET] = (c.width + c.pocket_diameter) / 4
    if scene.fidelity.terms.land_film:
        viscosity = scene.lubricant.viscosity_of_lands
        p[P.LAND_VISCOSITY] = viscosity or 0.0
        if viscosity is None:  # the cage turns with the balls, which roll without slip
            gamma = b.ball_diameter * math.cos(scene.bearing.nominal_angle) / b.pitch_diameter
            sliding = 1.0 + gamma if c.guidance == "inner" else 1.0 - gamma
            p[P.LAND_SLIDE] = 0.5 * sliding * p[P.LAND_RADIUS]
    if scene.fidelity.terms.land_growth:
        _land_growth(scene, material, p)
    p[P.LAND_STOP_STIFFNESS] = _STOP_STIFFNESS
    p[P.LAND_STOP_FRACTION] = _STOP_FRACTION
    p[P.LAND_STOP_FRICTION] = _STOP_FRICTION
    p[P.LAND_STOP_SLIP] = _STOP_SLIP


def _land_growth(scene: Scene, material: Material, p: NDArray[np.float64]) -> None:
    """Write by what a land's clearance grows; the cage by rotation as a thin ring, by rho r^3 w^2/E."""
    b, cage = si(scene.bearing), si(material)
    outside = scene.bearing.cage is not None and scene.bearing.cage.guidance == "outer"
    side = 1.0 if outside else -1.0  # of the ring: it is outside of the cage, or inside
    ring = si(scene.materials.outer_ring if outside else scene.materials.inner_ring)
    radius = float(p[P.LAND_RADIUS])
    turning = 0.5 * (1.0 - b.ball_diameter * math.cos(scene.bearing.nominal_angle) / b.pitch_diameter)
    p[P.LAND_BY_RACE] = side
    p[P.LAND_BY_RING] = side * ring.expansion * radius
    p[P.LAND_BY_CAGE] = -side * cage.expansion * radius
    p[P.LAND_BY_SPEED] = -side * cage.density * radius**3 * turning**2 / cage.youngs_modulus
