"""Where a set rests with quasi-static bearings: Newton's method in displacements, an oracle of the engine.

Only the balls of a bearing that is held are the engine's (its entry ``held``, which has oracles of its own).
Preload, offsets, supports, loads and the search for the rest are written here, in matrices. Unknowns are the
coordinates of the shaft, then of what holds the outer rings and gives way: the place of each sliding
ring along its bearing's own axis; six of a housing that moves; x y z and tilts of each ring on a pedestal.
Contacts are springs: a step is judged by the force along it, which must not turn round. Units are SI.
"""

from dataclasses import dataclass, replace

import numpy as np

from fmu_bearing.arrays import REASONS, EngineError
from fmu_bearing.compiled import call
from fmu_bearing.elastic.shaft import ShaftModel, rigid_transform, shaft_model
from fmu_bearing.elastic.shaft.model import FREEDOMS
from fmu_bearing.engine.constants import GRAVITY, REFERENCE_TEMPERATURE, RPM
from fmu_bearing.engine.layout import EQ, SP, C, P, Q, U, W
from fmu_bearing.engine.status import OK
from fmu_bearing.prepare.bodies import inner_ring
from fmu_bearing.prepare.model import pack
from fmu_bearing.prepare.spindle import expansions, housing_of, in_housing
from fmu_bearing.scene import si
from fmu_bearing.scene.assembly import shares
from fmu_bearing.scene.member import HELD, one_of, set_of
from fmu_bearing.scene.read import with_fidelity
from fmu_bearing.scene.units import convert

_CLOSE = 1e-13  # m: places found by bisection
_FAR = 1e-3  # m: no bearing is pushed so far
_TOUCHING = 0.01  # N: without preload the rings are where the balls just touch
_PLANE = [Q.X, Q.Y, Q.Z, Q.BY, Q.BZ]  # of an outer ring's six: its own rotation is left out
_TILTS = (False, False, False, True, True)
_ITERATIONS = 300
_BACKTRACKS = 12
_LONGEST = 5e-6  # m: step of a ring, tilts at the pitch radius; a tenth of the groove centres' distance
_FLOOR = 1.0  # N/m: moves a shaft that nothing holds by the longest step at most


def oracle(scene, force=None, at=None, moment=(0.0, 0.0)):
    """Return the set at rest under a force (N) at a place (m) and a moment (N m), and its weight."""
    assembled = assembly(scene, scene.operation.speed_rpm * RPM)
    given = scene.spindle.load
    force = (given.force_x_N, given.force_y_N, given.force_z_N) if force is None else force
    plane = 1e-3 * given.position_mm if at is None else at
    on_nose = rigid_transform(1.0, plane).T @ np.array([*force, *moment])  # as runs take it
    return rest(assembled, assembled.shaft.nose.T @ on_nose + weight(assembled))


@dataclass(frozen=True)
class Held:
    """A bearing whose rings are held, in its own axes, SI units.

    Attributes
    ----------
    force : ndarray, shape (5,)
        Of the balls on the inner ring: x y z (N), moments about y, z (N m).
    stiffness : ndarray, shape (5, 5)
        Inner ring against outer; centrifugal and friction forces of the balls held.
    loads, angles, pressures : ndarray, shape (2, balls)
        Ball loads (N), contact angles (rad), peak pressures (Pa) at inner and outer race.
    """

    force: np.ndarray
    stiffness: np.ndarray
    loads: np.ndarray
    angles: np.ndarray
    pressures: np.ndarray


class Member:
    """A bearing on the shaft: perfect, rigid rings.

    Parameters
    ----------
    scene : Scene
        With a set.
    place : SetBearing
    speed : float
        Of the shaft, rad/s.
    """

    def __init__(self, scene, place, speed):
        self.place = place
        self.sign = float(place.sign)
        self.position = 1e-3 * place.position_mm  # m
        self.inputs = np.zeros(U.SIZE)
        self.inputs[U.SPEED] = speed
        self.inputs[U.PEDESTAL] = HELD
        operation, own = si(scene.operation), si(place)
        self.inputs[U.OIL_T] = operation.oil_temperature
        for index, ring in ((U.INNER_T, "inner_ring_temperature"), (U.OUTER_T, "outer_ring_temperature")):
            given = getattr(own, ring)
            self.inputs[index] = getattr(operation, ring) if given is None else given
        self.parameters = pack(_alone(scene, scene.spindle.bearing.index(place)), np.empty(0))
        self._c, self._out = np.zeros(C.SIZE), np.zeros(EQ.SIZE)
        self._force, self._w = np.zeros(FREEDOMS), np.zeros(W.size(self.parameters))
        self.mirror = np.array([self.sign, 1.0, 1.0, self.sign, self.sign])

    def at(self, own, inputs=None):
        """Return the bearing with its inner ring held at ``own`` (m, rad) in its own axes.

        ``inputs``: of the engine, ``layout.U``; default: the inputs of the operating point.

        Raises
        ------
        EngineError
            Where the balls find no place.
        """
        ring = np.ascontiguousarray(own, dtype=np.float64)
        inputs = self.inputs if inputs is None else inputs
        status = call(
            "forces_at_displacement", self.parameters, inputs, self._c, ring, self._force, self._out, self._w
        )
        if status != OK:
            raise EngineError(f"bearing at {1e3 * self.position:g} mm: {REASONS[status]}")
        balls = int(self.parameters[P.BALLS])
        rows = [self._out[at : at + balls] for at in (EQ.LOAD_I, EQ.LOAD_O, EQ.ANGLE_I, EQ.ANGLE_O)]
        loads = np.array(rows[:2])
        races = [self.parameters[P.RACES + k * P.RACE_SIZE : P.RACES + (k + 1) * P.RACE_SIZE] for k in (0, 1)]
        hertz = np.array([race[P.RACE_STIFFNESS] for race in races])
        peak = np.array([race[P.RACE_PRESSURE] for race in races])
        # Q = K d^1.5 and p = P d^0.5 with the approach d
        pressures = peak[:, None] * np.cbrt(loads / hertz[:, None])
        stiffness = self._out[EQ.STIFFNESS : EQ.STIFFNESS + FREEDOMS**2].reshape(FREEDOMS, FREEDOMS)
        return Held(self._force.copy(), stiffness.copy(), loads, np.array(rows[2:]), pressures)

    def still(self):
        """Return inputs of standstill at the scene's temperatures."""
        inputs = self.inputs.copy()
        inputs[U.SPEED] = 0.0
        return inputs

    def cold(self):
        """Return inputs of standstill at 20 degC."""
        return self.warmer(0.0)

    def warmer(self, rise):
        """Return inputs of standstill at 20 degC with an inner ring that is warmer by ``rise`` (K)."""
        inputs = self.still()
        inputs[[U.OIL_T, U.INNER_T, U.OUTER_T]] = REFERENCE_TEMPERATURE
        inputs[U.INNER_T] += rise
        return inputs

    def carried(self, shift, inputs=None):
        """Axial load (N) that the bearing carries at an axial displacement (m) in its own axes."""
        return -float(self.at(np.array([shift, 0.0, 0.0, 0.0, 0.0]), inputs).force[0])

    def place_under(self, load, inputs=None):
        """Axial displacement (m) under an axial load (N); without load that where the balls just touch."""
        load = max(load, _TOUCHING)
        low, high = self._bracket(load, inputs)
        while high - low > _CLOSE:
            middle = 0.5 * (low + high)
            if self.carried(middle, inputs) < load:
                low = middle
            else:
                high = middle
        return self._polished(0.5 * (low + high), load, inputs)

    def _polished(self, shift, load, inputs):
        """One step of Newton's method, which takes bisection to rounding."""
        here = self.at(np.array([shift, 0.0, 0.0, 0.0, 0.0]), inputs)
        return shift + (load + float(here.force[0])) / max(float(here.stiffness[0, 0]), 1.0)

    def _bracket(self, load, inputs):
        """Displacements (m) that carry nothing, and at least ``load``."""
        low, high = -1e-5, 1e-5
        while self.carried(high, inputs) < load:
            high *= 2.0
            if high > _FAR:
                raise EngineError(f"no bearing of this kind carries {load:g} N along its axis")
        while self.carried(low, inputs) > 0.0:
            low *= 2.0
            if low < -_FAR:
                raise EngineError(
                    "the balls are clamped at any place of the ring: rings far too warm or cold"
                )
        return low, high


def _alone(scene, number):
    """Return the scene of one perfect bearing of the set, from 0."""
    return one_of(with_fidelity(scene, model="full").model_copy(update={"imperfections": None}), number)


@dataclass(frozen=True)
class Supports:
    """Springs behind the outer rings of a set, SI units, for ``m`` coordinates.

    Attributes
    ----------
    rings : tuple of ndarray, shape (5, m)
        Motion of each outer ring, x y z and tilts, in its bearing's own axes.
    stiffness : ndarray, shape (m, m)
    force : ndarray, shape (m,)
        Of springs that push, and weights.
    tilts : ndarray of bool, shape (m,)
        Which coordinates are angles.
    """

    rings: tuple[np.ndarray, ...]
    stiffness: np.ndarray
    force: np.ndarray
    tilts: np.ndarray

    @property
    def count(self):
        """Number of coordinates."""
        return len(self.force)


def supports(scene, spindle, members, spring):
    """Return the supports of a set; ``spring``: force (N) and stiffness (N/m) at each sliding ring."""
    sliding = [k for k, one in enumerate(members) if one.place.seat == "sliding"]
    own = [k for k, one in enumerate(members) if one.place.seat == "pedestal"]
    moves = spindle.housing.moves
    housing = len(sliding)
    first = housing + (SP.HOUSING if moves else 0)
    m = first + FREEDOMS * len(own)
    rings = [np.zeros((FREEDOMS, m)) for _ in members]
    stiffness, force, tilts = np.zeros((m, m)), np.zeros(m), np.zeros(m, dtype=bool)
    if moves:
        tilts[housing + Q.TURN : first] = True
        _feet(scene, stiffness[housing:first, housing:first], force[housing:first])
        for one, ring in zip(members, rings, strict=True):
            ring[:, housing:first] = in_housing(int(one.sign), one.position)[_PLANE]
    push, constant = spring or (0.0, 0.0)
    for place, k in enumerate(sliding):
        pressed = -rings[k][0]  # how far the seat goes from under its ring
        pressed[place] = 1.0
        stiffness += constant * np.outer(pressed, pressed)
        force -= push * pressed
        rings[k][0] = np.eye(m)[place]
    for number, k in enumerate(own):
        at = slice(first + FREEDOMS * number, first + FREEDOMS * (number + 1))
        rings[k][:, at] = np.eye(FREEDOMS)
        stiffness[at, at] = np.diag(_along(spindle.housing)[_PLANE])
        tilts[at] = _TILTS
    if scene.fidelity.terms.gravity:
        for one, ring in zip(members, rings, strict=True):
            force -= GRAVITY * _lying(one) * ring[Q.Z]
    return Supports(tuple(rings), stiffness, force, tilts)


def axial_springs(spindle, spring):
    """Force (N) and stiffness (N/m) behind each outer ring that gives way along its axis by itself."""
    found = {}
    for k, one in enumerate(spindle.bearing):
        if one.seat == "sliding":
            found[k] = spring or (0.0, 0.0)
        elif one.seat == "pedestal":
            found[k] = (0.0, float(_along(spindle.housing)[Q.X]))
    return found


def _along(housing):
    """Stiffness of a pedestal along and about x y z (N/m, N m/rad)."""
    radial, table = housing.pedestal_stiffness_N_m or 0.0, si(housing.model_copy(update={"material": None}))
    axial, turning = table.pedestal_axial_ratio * radial, table.pedestal_rotational_ratio * radial
    return np.array([axial, radial, radial, turning, turning, turning])


def _feet(scene, stiffness, force):
    """Put the pedestal's stiffness and the housing's weight into their parts of matrix and vector."""
    body, middle = housing_of(scene)
    motion = in_housing(1, middle)
    stiffness += motion.T @ np.diag(_along(scene.spindle.housing)) @ motion
    if scene.fidelity.terms.gravity:
        force -= GRAVITY * body.mass * motion[Q.Z]


def _lying(one):
    """Mass (kg) of an outer ring and of what lies in it."""
    p = one.parameters
    cage = p[P.CAGE_MASS] if p[P.CAGE] else 0.0
    return float(p[P.OUTER_MASS] + p[P.BALLS] * p[P.BALL_MASS] + cage)


@dataclass(frozen=True)
class Assembly:
    """Bearings on a shaft.

    Attributes
    ----------
    scene : Scene
    shaft : ShaftModel
    members : tuple of Member
    supports : Supports
        What holds the outer rings and gives way.
    offsets : ndarray
        Axial displacement (m) of each inner ring in its own axes with the shaft at zero, at the scene's
        temperatures.
    warming : ndarray
        What temperatures add to them.
    springs : dict
        Force (N) and stiffness (N/m) behind each outer ring that gives way along its axis by itself, by its
        bearing from 0: sliding ones and those on pedestals.
    """

    scene: object
    shaft: ShaftModel
    members: tuple[Member, ...]
    supports: Supports
    offsets: np.ndarray
    warming: np.ndarray
    springs: dict[int, tuple[float, float]]


def assembly(scene, speed):
    """Return the bearings of a scene's set, preloaded at standstill and 20 degC, at the scene's temperatures.

    Parameters
    ----------
    scene : Scene
    speed : float
        Of the shaft, rad/s.
    """
    spindle = set_of(scene)
    members = tuple(Member(scene, one, speed) for one in spindle.bearing)
    expansion = _strain(scene)
    preload, spring = spindle.preload, None
    asked = 0.0
    if preload is not None:
        asked = preload.force_N if preload.kind == "spring" else preload.preload_N  # type: ignore[assignment]
        spring = (asked, preload.stiffness_N_m or 0.0) if preload.kind == "spring" else None
    loads = [share * asked for share in shares(spindle)]
    springs = axial_springs(spindle, spring)
    one_way = len({one.sign for one in members}) == 1
    places = [
        0.0 if one_way else one.place_under(load, one.cold())
        for one, load in zip(members, loads, strict=True)
    ]
    cold = np.array(
        [place + 1e-6 * one.place.stickout_um for one, place in zip(members, places, strict=True)]
    )
    for k, one in enumerate(members):
        if one.place.seat == "pedestal" and not one_way:
            cold[k] += loads[k] / springs[k][1]
    warming = np.array([one.sign * one.position * expansion for one in members])
    behind = supports(scene, spindle, members, spring)
    return Assembly(scene, shaft_model(scene, spindle), members, behind, cold + warming, warming, springs)


def _strain(scene):
    """Strain of the shaft less that of the housing against 20 degC."""
    spindle, operation = set_of(scene), si(scene.operation)
    given = (
        (spindle.shaft.temperature_degC, operation.inner_ring_temperature),
        (spindle.housing.temperature_degC, operation.outer_ring_temperature),
    )
    rises = [(ring if own is None else convert(own, "_degC")) - REFERENCE_TEMPERATURE for own, ring in given]
    shaft, housing = expansions(scene)
    return float(shaft * rises[0] - housing * rises[1])


def weight(assembled):
    """Return the weight of shaft and inner rings as loads on the shaft's coordinates, N.

    Zero where the scene leaves weight out.
    """
    scene, shaft = assembled.scene, assembled.shaft
    if not scene.fidelity.terms.gravity:
        return np.zeros(shaft.count)
    found = -GRAVITY * shaft.heavy
    for bearing, plane in zip(scene.bearings(), shaft.planes, strict=True):
        found -= GRAVITY * inner_ring(bearing.scene).mass * plane[2]
    return found


@dataclass(frozen=True)
class Rest:
    """A set at rest.

    Attributes
    ----------
    shaft : ndarray, shape (n,)
        Coordinates of the shaft; the first five are x y z (m), tilts about y, z (rad) of its nose.
    apart : tuple of ndarray, shape (5,)
        Displacement of each inner ring against its outer one, in the bearing's own axes.
    held : tuple of Held
        The bearings, in their own axes.
    residual : float
        N; moments over the pitch radius.
    """

    shaft: np.ndarray
    apart: tuple[np.ndarray, ...]
    held: tuple[Held, ...]
    residual: float


def rest(assembled, load, inputs=None):
    """Return the equilibrium of a set.

    Parameters
    ----------
    assembled : Assembly
    load : ndarray, shape (n,)
        On the shaft's coordinates: forces (N), moments (N m).
    inputs : list of ndarray, optional
        Of the engine, per bearing; default: the inputs of the operating point.

    Raises
    ------
    EngineError
        Where there is no equilibrium.
    """
    system = _System(assembled, load, inputs)
    z = system.start()
    force, matrix, held = system.at(z)
    total = system.size(load) + sum(abs(one.force[0]) for one in held)
    limit = 1e-8 + 1e-10 * total
    damping = _FLOOR
    for _ in range(_ITERATIONS):
        size = system.size(force)
        if size <= limit:
            break
        step = system.step(matrix, force, damping)
        ahead = float(step @ force)
        if not ahead > 0.0:
            damping = max(10.0 * damping, 1e3)
            continue
        share = 1.0
        for n in range(_BACKTRACKS):
            trial = system.at(z + share * step)
            after = float(trial[0] @ step)
            if after >= -0.9 * ahead or system.size(trial[0]) < 0.5 * size or n == _BACKTRACKS - 1:
                break
            share *= min(max(ahead / (ahead - after), 0.1), 0.7)
        damping = max(0.3 * damping, _FLOOR) if share > 0.5 else 4.0 * damping
        z = z + share * step
        force, matrix, held = trial
    size = system.size(force)
    if not size <= 1e-6 * (100.0 + total):
        raise EngineError(f"no equilibrium was found, {size:.3g} N stay out of balance")
    for number, one in enumerate(held, start=1):
        if one.force[0] > 1e-6 * (100.0 + total):
            raise EngineError(f"bearing {number} would carry {one.force[0]:.4g} N against its direction")
    count = assembled.shaft.count
    own = [moves @ z for moves in system.moves]
    for k, offset in enumerate(assembled.offsets):
        own[k][0] += offset
    return Rest(z[:count], tuple(own), held, size)


class _System:
    """Forces on shaft and supports, and their derivatives."""

    def __init__(self, assembled, load, inputs):
        self.members, self.offsets = assembled.members, assembled.offsets
        self.inputs = inputs or [one.inputs for one in self.members]
        self.load, self.supports = load, assembled.supports
        self.lever = float(self.members[0].parameters[P.PITCH_RADIUS])
        self.shaft, self.first = assembled.shaft, assembled.shaft.count
        self.count = self.first + self.supports.count
        self.scale = np.ones(self.count)
        self.scale[np.concatenate([self.shaft.tilts, self.supports.tilts])] = self.lever
        self.moves = [self._moves(k) for k in range(len(self.members))]

    def _moves(self, k):
        """How unknowns move a bearing's inner ring against the outer one, in its own axes."""
        inner = self.members[k].mirror[:, None] * self.shaft.planes[k]
        return np.hstack([inner, -self.supports.rings[k]])

    def start(self):
        """Place the shaft where preloaded bearings are; a set that carries one way, where its load is."""
        z = np.zeros(self.count)
        signs = {one.sign for one in self.members}
        if len(signs) == 1:
            (sign,) = signs
            each = abs(self.load[0]) / len(self.members)
            z[0] = sign * (self.members[0].place_under(each, self.inputs[0]) - float(self.offsets.mean()))
        return z

    def at(self, z):
        """Return forces out of balance, stiffness matrix, and the bearings."""
        force = np.zeros(self.count)
        force[: self.first] = self.load - self.shaft.stiffness @ z[: self.first]
        bearings = []
        for k, (one, inputs) in enumerate(zip(self.members, self.inputs, strict=True)):
            own = self.moves[k] @ z
            own[0] += self.offsets[k]
            # the bearing is held in axes that lean with its outer ring
            rings = self.supports.rings[k]
            lean = np.array([0.0, *(rings @ z[self.first :])[3:]])
            upright = own.copy()
            upright[:3] -= np.cross(lean, own[:3])
            leaning = one.at(upright, inputs)
            pull = leaning.force.copy()
            pull[:3] += np.cross(lean, pull[:3])
            pull[3:] += np.cross(lean, [0.0, *pull[3:]])[1:]
            force += self.moves[k].T @ pull
            # the balls press the outer ring where they are, not at its centre
            about = np.cross(own[:3], pull[:3])[1:]
            force[self.first :] -= rings.T @ np.array([0.0, 0.0, 0.0, *about])
            bearings.append(replace(leaning, force=pull))
        force[self.first :] += self.supports.force - self.supports.stiffness @ z[self.first :]
        return force, self.matrix([one.stiffness for one in bearings]), tuple(bearings)

    def matrix(self, bearings):
        """Return the stiffness matrix of shaft, bearings of these stiffnesses, and supports."""
        found = np.zeros((self.count, self.count))
        found[: self.first, : self.first] = self.shaft.stiffness
        for moves, stiffness in zip(self.moves, bearings, strict=True):
            found += moves.T @ stiffness @ moves
        found[self.first :, self.first :] += self.supports.stiffness
        return found

    def size(self, force):
        """Length of forces (N), moments over the pitch radius."""
        return float(np.linalg.norm(force / self.scale[: len(force)]))

    def step(self, matrix, force, damping):
        """Newton's step, shortened so that no ring moves by more than the longest against the other."""
        scaled = matrix / np.outer(self.scale, self.scale) + damping * np.eye(self.count)
        step = np.linalg.solve(scaled, force / self.scale) / self.scale
        longest = 1e-300
        for moves in self.moves:
            own = moves @ step
            own[3:] *= self.lever
            longest = max(longest, float(np.abs(own).max()))
        return step * min(1.0, _LONGEST / longest)
