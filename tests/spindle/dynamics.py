"""Sets in motion by the engine's equations of single bearings, put together by the oracle of dense systems.

``Bearing`` asks the compiled kernels; ``spindle_of`` makes the oracle's system from a scene; ``at_rest`` its
start; ``dense_answer`` the Newton system's answer in the engine's layout.
"""

from dataclasses import replace

import numpy as np

from fmu_bearing.compiled import call
from fmu_bearing.elastic.shaft import shaft_model
from fmu_bearing.engine.constants import RPM
from fmu_bearing.engine.layout import EQ, STRIDE, C, F, J, P, Q, U, W, Y
from fmu_bearing.engine.mechanics.conditions import conditions
from fmu_bearing.engine.mechanics.energy import stored_energy
from fmu_bearing.engine.statics.place import place_balls, place_cage
from fmu_bearing.engine.status import OK
from fmu_bearing.prepare.bodies import inner_ring, outer_ring
from fmu_bearing.prepare.model import pack
from fmu_bearing.scene import si
from fmu_bearing.scene.mounting import Mounting
from fmu_bearing.scene.spindle import SetHousing
from tests.oracles import spindle_dynamics as oracle
from tests.spindle.rest import assembly

_PEDESTAL = slice(C.PEDESTAL, C.VISCOSITY)  # stiffness and damping under the outer ring
_RELATIVE = [0, 1, 2, 4, 5]  # coordinates of the outer ring against which the inner one moves


class Bearing:
    """The engine's kernels of one bearing, as the oracle asks for them.

    ``u``: inputs as of ``layout.U``; ``own``: whether the outer ring is on a pedestal of its own.
    """

    def __init__(self, p, u, own=False):
        if p[P.MODES] or p[P.BALL_WAVES] or (p[P.SPRINGS] and not p[P.CAGE]):
            raise ValueError("rings that bend, balls that wave and springs between them are not known here")
        self.p, self.u = p, np.array(u, dtype=float)
        self.balls, self.caged = int(p[P.BALLS]), bool(p[P.CAGE])
        self.c, self.w = np.zeros(C.SIZE), np.zeros(W.size(p))
        conditions(self.p, self.u, self.u[U.SPEED], self.c)
        if not own:
            self.c[_PEDESTAL] = 0.0
        inner, outer, cage = (
            [p[getattr(P, f"{body}_{name}")] for name in ("MASS", "TRANSVERSE", "POLAR")]
            for body in ("INNER", "OUTER", "CAGE")
        )
        self.masses = np.array(
            [inner[0]] * 3 + [inner[1]] * 2
            + [outer[0]] * 3 + [outer[2]] + [outer[1]] * 2
            + [cage[0]] * 3 + [cage[2]] + [cage[1]] * 2
        )  # fmt: skip

    def state(self, balls, places, rates):
        """The engine's ``y``; spare lanes copy the first ball."""
        y = np.zeros(Y.SIZE)
        rows = y[: Y.Q0].reshape(Y.ROWS, STRIDE)
        rows[:, : self.balls] = balls
        rows[:, self.balls :] = rows[:, :1]
        y[Y.Q0 : Y.V0], y[Y.V0 :] = places, rates
        return y

    def right_hand_side(self, y, angle, speed, speed_rate):
        """The engine's ``f``."""
        f = np.zeros(F.SIZE)
        call("right_hand_side", self.p, self.c, y, self.w, f, angle, speed, speed_rate)
        return f

    def evaluate(self, balls, places, rates, angle, speed, speed_rate):
        """Accelerations, power and heat."""
        f = self.right_hand_side(self.state(balls, places, rates), angle, speed, speed_rate)
        return oracle.Answer(
            f[: F.BODY].reshape(J.BALL, STRIDE)[:, : self.balls],
            f[F.BODY : F.WORK],
            f[F.WORK],
            f[F.HEAT : F.HEAT + 3].sum(),
        )

    def stored(self, balls, places, rates, angle, speed, speed_rate):
        """Stored energy (J)."""
        y = self.state(balls, places, rates)
        self.right_hand_side(y, angle, speed, speed_rate)
        return stored_energy(self.p, self.c, y, self.w)

    def slopes(self, balls, places, rates, angle, speed, speed_rate):
        """Derivatives of all accelerations by places and by rates, from the engine's Jacobian."""
        jac, n = np.full(J.SIZE, np.nan), self.balls
        y = self.state(balls, places, rates)
        call("jacobian", self.p, self.c, y, self.w, jac, angle, speed, speed_rate)
        b = jac[J.B : J.C].reshape(J.BALL, J.STATES, STRIDE)[..., :n]
        c = jac[J.C : J.D].reshape(J.BALL, J.BODIES, STRIDE)[..., :n]
        d = jac[J.D : J.E].reshape(Q.SIZE, J.STATES, STRIDE)[..., :n]
        e = jac[J.E :].reshape(Q.SIZE, J.BODIES)
        size = J.BALL * n
        found = np.zeros((2, size + Q.SIZE, size + Q.SIZE))
        for part, first, columns, bodies in (
            (0, 0, J.PLACED, slice(0, Q.SIZE)),
            (1, J.PLACED, J.BALL, slice(Q.SIZE, None)),
        ):
            for j in range(n):
                own = np.arange(J.BALL) * n + j
                moved = own[:columns]
                found[part][np.ix_(own, moved)] = b[:, first : first + columns, j]
                found[part][own, size:] = c[:, bodies, j]
                found[part][size:, moved] = d[:, first : first + columns, j]
            found[part][size:, size:] = e[:, bodies]
        return found

    def held(self, ring):
        """Force on the inner ring held at ``ring`` against the outer, stiffness, and the kernel's result."""
        force, out = np.zeros(EQ.FREEDOMS), np.zeros(EQ.SIZE)
        c, ring = np.zeros(C.SIZE), np.ascontiguousarray(ring)
        assert call("forces_at_displacement", self.p, self.u, c, ring, force, out, self.w) == OK
        stiffness = out[EQ.STIFFNESS : EQ.STIFFNESS + EQ.FREEDOMS**2].reshape(EQ.FREEDOMS, EQ.FREEDOMS)
        return force, stiffness.copy(), out

    def balanced(self, balls, places, rates, angle, speed):
        """Nine rows of the balls with orbit and spin where their own accelerations end: Newton's method."""
        balls, n = balls.copy(), self.balls
        rate_rows = np.arange(2, J.BALL)  # orbit and spin among a ball's accelerations
        for _ in range(60):
            answer = self.evaluate(balls, places, rates, angle, speed, 0.0)
            slopes = self.slopes(balls, places, rates, angle, speed, 0.0)[1]
            largest = 0.0
            for j in range(n):
                own = rate_rows * n + j
                step = np.linalg.solve(slopes[np.ix_(own, own)], -answer.balls[rate_rows, j])
                spin = np.linalg.norm(balls[6:, j]) + 1e-3
                most = np.abs(step).max() / spin
                balls[5:, j] += step * min(1.0, 2.5e-3 / (most + 1e-300))
                largest = max(largest, most)
            if largest < 1e-12:
                break
        return balls


def seat_tilts(one):
    """Tilts y z (mrad) of the seat of a set's bearing in its own axes: a mirror changes their sign."""
    sign = 1.0 if one.carries == "+x" else -1.0
    return sign * one.misalignment_y_mrad, sign * one.misalignment_z_mrad


def bearing_of(scene, number, **parameters):
    """Bearing of a set's scene, from 0; ``parameters`` replace the engine's by their names in ``P``."""
    one, housing = scene.spindle.bearing[number], scene.spindle.housing
    own, tilts = one.seat == "pedestal", seat_tilts(one)
    mounting = Mounting(
        preload_N=0.0,
        pedestal_stiffness_N_m=housing.pedestal_stiffness_N_m if own else 1e8,
        pedestal_stiffness_ratio=housing.pedestal_stiffness_ratio,
        pedestal_axis_angle_deg=housing.pedestal_axis_angle_deg,
        pedestal_axial_ratio=housing.pedestal_axial_ratio,
        pedestal_rotational_ratio_mm2=housing.pedestal_rotational_ratio_mm2,
        pedestal_damping_ratio=housing.pedestal_damping_ratio,
        misalignment_y_mrad=tilts[0] if own else 0.0,
        misalignment_z_mrad=tilts[1] if own else 0.0,
    )
    full = scene.fidelity.model_copy(update={"model": "full"})
    own_tables = {"bearing": scene.geometries[number], "materials": scene.materials_of_each[number]}
    alone = scene.model_copy(
        update={"spindle": None, "mounting": mounting, "fidelity": full, "sound": None} | own_tables
    )
    p = pack(alone.with_rigid_rings(), np.empty(0))
    p[P.ECCENTRICITY] = p[P.RIGID] = 0.0
    for name, value in parameters.items():
        p[getattr(P, name)] = value
    u = np.zeros(U.SIZE)
    u[U.SPEED], u[U.PEDESTAL] = scene.operation.speed_rpm * RPM, mounting.pedestal_stiffness_N_m
    operation, given = si(scene.operation), si(one)
    u[U.OIL_T] = operation.oil_temperature
    for place, ring in ((U.INNER_T, "inner_ring_temperature"), (U.OUTER_T, "outer_ring_temperature")):
        value = getattr(given, ring)
        u[place] = getattr(operation, ring) if value is None else value
    return Bearing(p, u, own)


def offsets_of(scene):
    """Axial place (m) of each inner ring in its own axes with the shaft at zero; force, stiffness of springs.

    Places of statics; on a pedestal of its own the outer ring gives way under the preload, too.
    """
    spindle = scene.spindle
    seats = [
        one.model_copy(update={"seat": "fixed"} if one.seat == "pedestal" else {}) for one in spindle.bearing
    ]
    held = spindle.model_copy(
        update={
            "bearing": tuple(seats),
            "shaft": spindle.shaft.model_copy(update={"flexible": False}),
            "housing": SetHousing(
                material=spindle.housing.material, temperature_degC=spindle.housing.temperature_degC
            ),
        }
    )
    assembled = assembly(scene.model_copy(update={"spindle": held}), 0.0)
    found = assembled.offsets.copy()
    housing = si(spindle.housing)
    for k, one in enumerate(spindle.bearing):
        if one.seat == "pedestal":
            cold = found[k] - assembled.warming[k] - 1e-6 * one.stickout_um
            load = assembled.members[k].carried(cold, assembled.members[k].cold())
            found[k] += load / (housing.pedestal_axial_ratio * housing.pedestal_stiffness)
    sliding = [k for k, one in enumerate(scene.spindle.bearing) if one.seat == "sliding"]
    return found, assembled.springs[sliding[0]] if sliding else (0.0, 0.0)


def housing_of(scene):
    """Housing of a set's scene that moves, or None; zeta counts the outer rings' mass, too."""
    spindle, housing = scene.spindle, si(scene.spindle.housing)
    if not spindle.housing.moves:
        return None
    places = [one.position_mm for one in spindle.bearing]
    rings = [outer_ring(bearing.scene) for bearing in scene.bearings()]
    carried = sum(np.array([ring.mass] * 3 + [ring.polar] + [ring.transverse] * 2) for ring in rings)
    middle = housing.position if housing.position is not None else 0.5e-3 * (places[0] + places[-1])
    return oracle.Housing.cylinder(
        housing.mass, housing.diameter, housing.length, middle, housing.pedestal_stiffness,
        housing.pedestal_axial_ratio, housing.pedestal_rotational_ratio, housing.pedestal_damping_ratio,
        carried, (housing.pedestal_stiffness_ratio, housing.pedestal_axis_angle),
    )  # fmt: skip


def held_upright(scene, shaft):
    """A rigid shaft, or one that is rigid but for its own coordinates, with its support against tilting."""
    given = scene.spindle.tilt_support
    if given is None:
        return shaft
    # the one rigid motion that no force along y or z goes with: about the centre of mass
    rings = [inner_ring(bearing.scene) for bearing in scene.bearings()]
    mass = shaft.mass + sum(
        plane.T @ np.diag([ring.mass] * 3 + [ring.transverse] * 2) @ plane
        for ring, plane in zip(rings, shaft.planes, strict=True)
    )
    heavy, about = mass[2, [2, 3]], mass[3, 3]
    zeta, stiffness = given.damping_ratio, given.stiffness_N_m_rad
    damping = 2.0 * zeta * np.sqrt(stiffness * (about - heavy[1] ** 2 / heavy[0]))
    held = shaft.at(1e-3 * given.position_mm)[3:]
    held = np.hstack([held, np.zeros((2, len(shaft.mass) - held.shape[1]))])
    return replace(
        shaft,
        damping=shaft.damping + damping * held.T @ held,
        stiffness=shaft.stiffness + stiffness * held.T @ held,
    )


def spindle_of(scene, shaft=None, offsets=None, bearings=None, speed_rate=0.0, **parameters):
    """The oracle's system of a scene at time 0, the shaft's angle zero.

    ``shaft``, ``offsets`` (m), ``bearings``: in place of the scene's; ``parameters``: as of ``bearing_of``.
    """
    spindle, load = scene.spindle, si(scene.spindle.load)
    shaft = held_upright(scene, shaft_model(scene, spindle) if shaft is None else shaft)
    usual, spring = offsets_of(scene)
    offsets = usual if offsets is None else offsets
    if bearings is None:
        bearings = [bearing_of(scene, k, **parameters) for k in range(len(spindle.bearing))]
    mounted = [
        oracle.Mounted(
            bearings[k], float(one.sign), 1e-3 * one.position_mm, shaft.planes[k], float(offsets[k]),
            one.seat, spring,
            lean=(0.0, 0.0) if one.seat == "pedestal" else tuple(1e-3 * x for x in seat_tilts(one)),
        )
        for k, one in enumerate(spindle.bearing)
    ]  # fmt: skip
    force = np.array([load.force_x, load.force_y, load.force_z, 0.0, 0.0])
    spots = tuple((1e-6 * one.amount_g_mm, np.radians(one.angle_deg)) for one in spindle.shaft.unbalance)
    drive = oracle.Drive(
        scene.operation.speed_rpm * RPM,
        speed_rate=speed_rate,
        nose=oracle.at_plane(1.0, load.position).T @ force,
        spots=spots,
        gravity=scene.fidelity.terms.gravity,
        eccentricity=0.0 if scene.imperfections is None else 1e-6 * scene.imperfections.unbalance_um,
    )
    return oracle.Spindle(mounted, shaft, drive, housing_of(scene))


def place_from(system, parts, carriers):
    """State from the engine's ``y`` of each bearing, and places and rates (2 rows) of shaft and housing."""
    state = np.zeros(2 * system.count + 2)
    places, rates = system.split(state)
    places[system.carriers], rates[system.carriers] = carriers
    for one, own, y in zip(system.mounted, system.own, parts, strict=True):
        n, free = one.bearing.balls, np.array(one.free, dtype=int)
        rows = y[: Y.Q0].reshape(Y.ROWS, STRIDE)[:, :n]
        first = own.start
        places[first : first + 3 * n] = rows[:3].ravel()
        rates[first : first + 6 * n] = rows[3:].ravel()
        places[first + 6 * n : own.stop] = y[Y.Q0 + free]
        rates[first + 6 * n : own.stop] = y[Y.V0 + free]
    return state


def bearing_arrays(system, state, t=0.0):
    """The engine's ``y`` of each bearing."""
    return [one.bearing.state(*system.bearing_state(k, t, state)[:3]) for k, one in enumerate(system.mounted)]


def at_rest(system, limit=1e-7):
    """Quasi-static state: shaft, housing and outer rings in equilibrium, balls rolling, spins balanced."""
    places = _equilibrium(system, limit)
    angle, speed = system.drive.at(0.0)
    parts = []
    state = np.concatenate([places, np.zeros(system.count + 2)])
    for k, one in enumerate(system.mounted):
        bearing = one.bearing
        _, q, v, *_ = system.bearing_state(k, 0.0, state)
        out = bearing.held(_against_outer(q))[2]
        y = np.zeros(Y.SIZE)
        y[Y.Q0 : Y.V0], y[Y.V0 :] = q, v
        place_balls(bearing.p, y, out)
        if bearing.caged:
            place_cage(bearing.p, y, out)
        rows = y[: Y.Q0].reshape(Y.ROWS, STRIDE)[:, : bearing.balls]
        # about an outer ring that is tilted
        lean = np.cos(rows[2]) * q[9] + np.sin(rows[2]) * q[10]
        radius, x = bearing.p[P.PITCH_RADIUS] + rows[1], rows[0] - q[5]
        rows[0] += radius * lean
        rows[1] -= x * lean
        if speed != 0.0:
            rows[:] = bearing.balanced(rows, y[Y.Q0 : Y.V0], y[Y.V0 :], angle, speed)
            if bearing.caged:
                y[Y.V0 + Q.CAGE + Q.TURN] = rows[5].mean()
        parts.append(y)
    return place_from(system, parts, np.array([places[system.carriers], 0.0 * places[system.carriers]]))


def _about(tilts, vector):
    """Change of a vector x y z by small tilts about y and z."""
    return np.cross([0.0, *tilts], vector)


def _against_outer(q):
    """Displacement (5) of the inner ring from the outer one in the axes of that, of 17 coordinates."""
    found = q[:5] - q[5:11][_RELATIVE]
    found[:3] -= _about(q[9:11], found[:3])
    return found


def _equilibrium(system, limit):
    """Places of all unknowns where forces on shaft, housing and outer rings end; places of balls are zero."""
    n = system.count
    slow = [np.arange(system.carriers.start, system.carriers.stop)]
    for one, own in zip(system.mounted, system.own, strict=True):
        outer = [body for body in one.free if body < 11]
        first = own.start + 6 * one.bearing.balls
        slow.append(np.arange(first, first + len(outer)))
    slow = np.concatenate(slow)
    places = np.zeros(n)
    for _ in range(200):
        force, matrix = _balance(system, places)
        step = np.zeros(n)
        step[slow] = np.linalg.solve(matrix[np.ix_(slow, slow)], force[slow])
        moved = max(np.abs(one[:, slow] @ step[slow]).max() for one in system.motions)
        step *= min(1.0, 5e-6 / (moved + 1e-300))
        places += step
        if np.abs(force[slow]).max() < limit:
            return places
    raise ValueError(f"{np.abs(force[slow]).max():.3g} N stay out of balance")


def _balance(system, places):
    """Forces on shaft, housing and outer rings with the balls settled, and their stiffness."""
    _, matrix = system.matrices(0.0)
    force = system.outside(0.0) - matrix @ places
    weighs = system.drive.gravity * oracle.GRAVITY
    force -= weighs * system.heavy
    for one, motion in zip(system.mounted, system.motions, strict=True):
        bearing, size = one.bearing, 6 * one.bearing.balls
        inner, outer = motion[size : size + 5], motion[size + 5 : size + 11]
        apart = inner - outer[_RELATIVE]
        q = motion[size:] @ places
        q[0] += one.offset
        pushed, stiffness, _ = bearing.held(_against_outer(q))
        pushed[:3] += _about(q[9:11], pushed[:3])
        force += apart.T @ pushed
        matrix = matrix + apart.T @ stiffness @ apart
        balls = bearing.balls * bearing.p[P.BALL_MASS]
        force -= weighs * (bearing.masses[0] * inner[2] + (bearing.masses[5] + balls) * outer[2])
        if one.seat == "pedestal":
            c = bearing.c
            springs = np.diag([c[C.PEDESTAL_AXIAL], 0.0, 0.0] + [c[C.PEDESTAL_ROTATIONAL]] * 3)
            springs[1:3, 1:3] = [[c[C.PEDESTAL_Y], c[C.PEDESTAL_YZ]], [c[C.PEDESTAL_YZ], c[C.PEDESTAL_Z]]]
            matrix = matrix + outer.T @ springs @ outer
            force -= outer.T @ springs @ (outer @ places)
    for _, stretch, (push, constant), _ in system.springs():
        force -= stretch * (push + constant * (stretch @ places))
        matrix = matrix + constant * np.outer(stretch, stretch)
    return force, matrix


def dense_answer(system, state, residuals, carriers, gh, t=0.0):
    """Solve the Newton system of a whole set with NumPy.

    ``residuals``: an array in the engine's layout ``F`` for each bearing, of which rows of balls (spare lanes
    are not read) and of bodies that move by themselves count: m/s2, rad/s2. Rows of rings that shaft or
    housing carry, or that are held, are not read. ``carriers``: residual of the shaft's n coordinates, then
    of the housing's six, if it moves (N, N m): all forces less total mass times acceleration, with the
    rings' share ``T^T m (a_free - a)``. ``gh`` (s): a change d of accelerations moves rates by ``gh d``,
    places by ``gh^2 d``.

    Returns the increments of accelerations: an array in the layout ``F`` for each bearing, spare lanes zero,
    rows of carried rings ``T`` times the increment of what carries them, of held ones zero; and those of
    shaft and housing in one vector, in the order of ``carriers``.
    """
    right = np.zeros(system.count)
    right[system.carriers] = carriers
    for one, own, r in zip(system.mounted, system.own, residuals, strict=True):
        n, free = one.bearing.balls, np.array(one.free, dtype=int)
        balls = np.asarray(r)[: F.BODY].reshape(J.BALL, STRIDE)[:, :n]
        right[own] = np.concatenate([balls.ravel(), np.asarray(r)[F.BODY + free]])
    d = np.linalg.solve(system.matrix(t, state, gh), right)
    found = []
    for one, motion in zip(system.mounted, system.motions, strict=True):
        rows, n = motion @ d, one.bearing.balls
        out = np.zeros(F.SIZE)
        out[: F.BODY].reshape(J.BALL, STRIDE)[:, :n] = rows[: 6 * n].reshape(J.BALL, n)
        out[F.BODY : F.WORK] = rows[6 * n :]
        found.append(out)
    return found, d[system.carriers]
