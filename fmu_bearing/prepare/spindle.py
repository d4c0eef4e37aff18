"""Parameters of a set of bearings on one shaft: of every bearing, then of the set itself."""

import math

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import block_diag

from fmu_bearing.elastic.shaft import ShaftModel, rigid_transform, shaft_model, shaft_sections
from fmu_bearing.engine.choices import RESPONSE, RINGS
from fmu_bearing.engine.layout import SP, P, Q, S, W, Z
from fmu_bearing.prepare import bodies
from fmu_bearing.scene import Scene, si
from fmu_bearing.scene.assembly import shares
from fmu_bearing.scene.housing import middle_mm
from fmu_bearing.scene.member import one_of, set_of
from fmu_bearing.scene.mounting import Mounting
from fmu_bearing.scene.spindle import SetBearing, SetHousing, Spindle

__all__ = ["expansions", "housing_of", "in_housing", "one_of", "pack_set"]

_SEATS = {"fixed": SP.FIXED, "sliding": SP.SLIDING, "pedestal": SP.PEDESTAL}
_TURN, _OUTER = Q.TURN, Q.OUTER
#: Inertia of the driven rows of each bearing, and their motion by the coordinates, shape (rows, n).
Rows = list[tuple[NDArray[np.float64], NDArray[np.float64]]]


def expansions(scene: Scene) -> tuple[float, float]:
    """Expansion (1/K) of shaft and housing."""
    spindle, materials = set_of(scene), scene.materials
    pairs = ((spindle.shaft.material, materials.inner_ring), (spindle.housing.material, materials.outer_ring))
    first, second = (float(si(own or ring).expansion) for own, ring in pairs)
    return first, second


def as_set_of_one(p: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the parameters ``p`` of a single bearing with the block of a set on no shaft.

    The arrays of its bearing are the whole ones; what a set keeps of its own has room in them (`S.SET`,
    `W.SET`).
    """
    block = np.zeros(SP.HEAD + SP.ROW)
    block[SP.BEARINGS] = 1.0
    block[SP.AT_ROWS] = SP.HEAD
    row = block[SP.HEAD :]
    row[SP.ROW_SIGN] = 1.0
    row[SP.ROW_SEAT] = SP.PEDESTAL
    row[SP.ROW_MASS : SP.ROW_MASS + SP.DRIVEN] = 1.0  # its equations are for accelerations
    alone = np.concatenate([p, block])
    alone[P.SET] = p.size
    alone[P.ALONE] = 1.0
    return alone


def pack_set(
    scene: Scene, parameters: list[NDArray[np.float64]], shaft: ShaftModel | None = None
) -> NDArray[np.float64]:
    """Return the parameter array ``p`` of a set.

    Parameters
    ----------
    scene : Scene
    parameters : list of ndarray
        Parameters of each bearing, as of a single one of `one_of`, with or without a block of their own.
    shaft : ShaftModel, optional
        In the place of the scene's.
    """
    spindle = set_of(scene)
    shaft = shaft or shaft_model(scene, spindle)
    bearings = [p[: int(p[P.SET]) or p.size].copy() for p in parameters]
    for p in bearings:
        p[P.SET] = p[P.ALONE] = 0.0
        p[P.ECCENTRICITY] = 0.0  # that of all that turns is the set's, see `_matrices`
    seats = [p[P.MISALIGNMENT_Y : P.MISALIGNMENT_Y + 2].copy() for p in bearings]
    for p, seat, bearing in zip(bearings, seats, spindle.bearing, strict=True):
        if bearing.seat == "pedestal":
            seat[:] = 0.0  # its springs tilt the ring
        else:
            _remove_pedestal(p)
    follows = bearings[0][P.FIDELITY] in (RINGS, RESPONSE)
    rows = _rows(spindle, shaft, bearings, follows)
    block = _block(scene, shaft, bearings, rows, seats)
    bearings[0][P.SET] = sum(p.size for p in bearings)
    return np.concatenate([*bearings, block])


def _remove_pedestal(p: NDArray[np.float64]) -> None:
    """Take the pedestal from under an outer ring: its seat holds it."""
    for place in (
        P.PEDESTAL_Y, P.PEDESTAL_Z, P.PEDESTAL_YZ, P.PEDESTAL_DAMPING_Y, P.PEDESTAL_DAMPING_Z,
        P.PEDESTAL_DAMPING_YZ, P.AXIAL_RATIO, P.ROTATIONAL_RATIO, P.MISALIGNMENT_Y, P.MISALIGNMENT_Z,
    ):  # fmt: skip
        p[place] = 0.0


def _driven(one: SetBearing, rings: bool) -> int:
    """Return how many rows of the rings follow the set's coordinates; ``rings``: see `_rows`."""
    return _OUTER if one.seat == "pedestal" and not rings else SP.DRIVEN


def _sliding(spindle: Spindle) -> list[SetBearing]:
    """Bearings whose outer rings slide, in the order of their coordinates."""
    return [bearing for bearing in spindle.bearing if bearing.seat == "sliding"]


def in_housing(sign: int, position: float) -> NDArray[np.float64]:
    """Return the matrix from the housing's six coordinates to a seat's, in the bearing's own axes."""
    matrix = np.diag([sign, 1.0, 1.0, 1.0, sign, sign])
    matrix[Q.Y, Q.BZ], matrix[Q.Z, Q.BY] = position, -position
    return matrix


def _rows(spindle: Spindle, shaft: ShaftModel, bearings: list[NDArray[np.float64]], rings: bool) -> Rows:
    """Return inertia and motion of the driven rows, per bearing.

    ``rings``: of fidelities rings and response, where an outer ring on a pedestal of its own has six
    coordinates of the set.
    """
    moves, sliding = spindle.housing.moves, _sliding(spindle)
    behind = shaft.count + (SP.HOUSING if moves else 0)
    standing = [bearing for bearing in spindle.bearing if rings and bearing.seat == "pedestal"]
    n = behind + len(sliding) + SP.HOUSING * len(standing)
    rows = []
    for bearing, plane, p in zip(spindle.bearing, shaft.planes, bearings, strict=True):
        every = np.zeros((SP.DRIVEN, n))
        every[:_OUTER, : shaft.count] = rigid_transform(bearing.sign, 0.0) @ plane
        if moves:
            every[_OUTER:, shaft.count : behind] = in_housing(bearing.sign, 1e-3 * bearing.position_mm)
        if bearing.seat == "sliding":
            every[_OUTER] = 0.0
            every[_OUTER, behind + sliding.index(bearing)] = 1.0
        if bearing.seat == "pedestal":
            every[_OUTER:] = 0.0
            if rings:
                first = behind + len(sliding) + SP.HOUSING * standing.index(bearing)
                every[_OUTER:, first : first + SP.HOUSING] = np.eye(SP.HOUSING)
        inner, outer = p[P.INNER_MASS], p[P.OUTER_MASS]
        masses = np.array(
            [inner] * 3 + [p[P.INNER_TRANSVERSE]] * 2 + [outer] * 3 + [p[P.OUTER_POLAR]]
            + [p[P.OUTER_TRANSVERSE]] * 2
        )  # fmt: skip
        driven = _driven(bearing, rings)
        rows.append((masses[:driven], every[:driven]))
    return rows


def pedestal_axes(given: Mounting | SetHousing) -> list[float]:
    """Return what a pedestal has along y, along z and between both over its radial stiffness, and damping.

    Along its turned axes y', z' it is as stiff as given, so the damping goes with the root.
    """
    axes, angle = [], math.radians(given.pedestal_axis_angle_deg)
    ratio, c, s = given.pedestal_stiffness_ratio, math.cos(angle), math.sin(angle)
    for along in (ratio, math.sqrt(ratio)):
        axes += [along * c**2 + s**2, along * s**2 + c**2, (along - 1.0) * s * c]
    return axes


def housing_of(scene: Scene) -> tuple[bodies.RigidBody, float]:
    """Return the housing as a body about its middle, and the place (m) of its middle and pedestal."""
    spindle = set_of(scene)
    housing = si(spindle.housing.model_copy(update={"material": None}))
    middle = 1e-3 * middle_mm(spindle)
    if not spindle.housing.moves:
        return bodies.RigidBody(0.0, 0.0, 0.0), middle
    return bodies.of_mass(housing.mass, 0.0, housing.diameter, housing.length), middle


def supports(scene: Scene, shaft: ShaftModel) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return stiffness and damping of springs and dampers from the shaft to ground, SI units.

    Each of shape (n, n) over the shaft's n coordinates. Shaft and inner rings tilt about their centre of
    mass.
    """
    spindle = set_of(scene)
    mass, moment, about = bodies.rings_at_port(scene)
    for section in shaft_sections(scene, spindle.shaft):
        middle = section.start + 0.5 * section.length
        mass, moment = mass + section.mass, moment + section.mass * middle
        about += section.transverse + section.mass * middle**2
    stiffness, damping = np.zeros_like(shaft.stiffness), np.zeros_like(shaft.damping)
    for support in bodies.supports(spindle, mass, about - moment**2 / mass):
        place = spindle.middle_mm if support.position_mm is None else support.position_mm
        plane = shaft.at(1e-3 * place)
        stiffness += plane.T @ (support.stiffness[:, None] * plane)
        damping += plane.T @ (support.damping[:, None] * plane)
    return stiffness, damping


def _matrices(scene: Scene, shaft: ShaftModel, rows: Rows) -> dict[int, NDArray[np.float64]]:
    """Return tables of the block over all coordinates by their places in its head."""
    spindle, n = set_of(scene), rows[0][1].shape[1]
    body, middle = housing_of(scene)
    count = SP.HOUSING if spindle.housing.moves else 0
    here = in_housing(1, middle)
    mass = here.T @ np.diag([body.mass] * 3 + [body.polar] + [body.transverse] * 2) @ here
    sliding = _sliding(spindle)
    behind = shaft.count + count
    free = np.zeros((n - behind, n - behind))
    springs, dampers = supports(scene, shaft)
    wide = [
        block_diag(own, np.zeros((count, count)), free)
        # a housing does not spin
        for own in (shaft.stiffness + springs, shaft.damping + dampers, shaft.gyroscopic)
    ]
    # springs are between sliding rings and housing
    pressed = np.zeros((len(sliding), n))
    for k, one in enumerate(sliding):
        pressed[k, behind + k] = 1.0
        if count:
            pressed[k, shaft.count] = -one.sign
    stiffness = 0.0 if spindle.preload is None else spindle.preload.stiffness_N_m or 0.0
    spots = np.zeros((4, n))
    for spot, plane in zip(spindle.shaft.unbalance, shaft.spots, strict=True):
        amount, angle = si(spot).amount, si(spot).angle
        y, z = amount * plane[Q.Y], amount * plane[Q.Z]
        # heavy spot at 12 o'clock where its angle is zero: direction (0, -sin, cos)
        spots[0, : shaft.count] += -math.sin(angle) * y + math.cos(angle) * z
        spots[1, : shaft.count] += -math.cos(angle) * y - math.sin(angle) * z
    if scene.imperfections is not None:
        along_y, along_z = si(scene.imperfections).unbalance * (
            shaft.across + sum(mass[Q.Y : Q.Z + 1, None] * motion[Q.Y : Q.Z + 1, : shaft.count]
                               for mass, motion in rows)
        )  # fmt: skip
        spots[2, : shaft.count], spots[3, : shaft.count] = along_z, -along_y
    none = np.zeros(n - behind)
    return {
        SP.AT_MASS: block_diag(shaft.mass, mass[:count, :count], free),
        SP.AT_STIFFNESS: wide[0] + stiffness * pressed.T @ pressed,
        SP.AT_DAMPING: wide[1],
        SP.AT_GYROSCOPIC: wide[2],
        SP.AT_HEAVY: np.concatenate([shaft.heavy, (body.mass * here[Q.Z])[:count], none])[:, None],
        SP.AT_NOSE: np.hstack([shaft.nose, np.zeros((SP.PLANE, n - shaft.count))]).T,
        SP.AT_SPRINGS: pressed.sum(axis=0)[:, None],
        SP.AT_UNBALANCE: spots.T,
    }


def _columns(matrix: NDArray[np.float64], lanes: int) -> NDArray[np.float64]:
    """Return a matrix by columns, each filled up to ``lanes`` numbers."""
    wide = np.zeros((matrix.shape[1], lanes))
    wide[:, : matrix.shape[0]] = matrix.T
    return wide.ravel()


def _block(
    scene: Scene,
    shaft: ShaftModel,
    bearings: list[NDArray[np.float64]],
    rows: Rows,
    seats: list[NDArray[np.float64]],
) -> NDArray[np.float64]:
    spindle = set_of(scene)
    count, n = len(bearings), rows[0][1].shape[1]
    tables = _matrices(scene, shaft, rows)
    total = tables[SP.AT_MASS] + sum(motion.T @ np.diag(mass) @ motion for mass, motion in rows)
    tables[SP.AT_SCALE] = np.diag(total)[:, None] / total[0, 0]
    tables[SP.AT_INVERSE] = np.asarray(np.linalg.inv(total), dtype=np.float64)
    lanes = SP.padded_size(n)
    columns = {place: _columns(table, lanes) for place, table in tables.items()}
    motions = [
        (_columns(motion, SP.LANES), np.flatnonzero(motion.any(axis=0)).astype(np.float64))
        for _, motion in rows
    ]
    size = SP.HEAD + sum(table.size for table in columns.values()) + count * SP.ROW
    block = np.zeros(size + sum(one.size for pair in motions for one in pair))
    at = SP.HEAD
    for place, table in columns.items():
        block[place] = at
        block[at : at + table.size] = table
        at += table.size
    block[SP.AT_ROWS] = at
    behind = at + count * SP.ROW
    begin = sum(p.size for p in bearings)
    places = {"P": 0, "S": 0, "W": 0, "Z": 0}
    for k, (p, (mass, _)) in enumerate(zip(bearings, rows, strict=True)):
        row = block[at + k * SP.ROW : at + (k + 1) * SP.ROW]
        outputs = Z.size(int(p[P.BALLS]), 0, 0, int(p[P.MODES]), int(p[P.DEFECTS]))
        sizes = {"P": p.size, "S": S.front(p), "W": W.size(p), "Z": outputs}
        for name, length in sizes.items():
            row[getattr(SP, f"ROW_{name}")] = places[name]
            row[getattr(SP, f"ROW_{name}_SIZE")] = length
            places[name] += length
        one = spindle.bearing[k]
        row[SP.ROW_SIGN] = one.sign
        row[SP.ROW_POSITION] = 1e-3 * one.position_mm
        row[SP.ROW_SEAT] = _SEATS[one.seat]
        row[SP.ROW_SHARE] = shares(spindle)[k]
        row[SP.ROW_STICKOUT] = 1e-6 * one.stickout_um
        row[SP.ROW_SEAT_TILT : SP.ROW_SEAT_TILT + 2] = seats[k]
        row[SP.ROW_DRIVEN] = mass.size
        row[SP.ROW_MASS : SP.ROW_MASS + mass.size] = mass
        for place, table in zip((SP.ROW_AT_T, SP.ROW_AT_COLUMNS), motions[k], strict=True):
            row[place] = begin + behind
            block[behind : behind + table.size] = table
            behind += table.size
        row[SP.ROW_COLUMNS] = motions[k][1].size
    block[SP.BEARINGS], block[SP.SHAFT], block[SP.COUNT], block[SP.PADDED_SIZE] = count, shaft.count, n, lanes
    block[SP.HOUSED] = spindle.housing.moves
    block[SP.SPRUNG] = bool(tables[SP.AT_STIFFNESS].any() or tables[SP.AT_DAMPING].any())
    block[SP.PORT] = spindle.shaft.external
    block[SP.LINED] = bearings[0][P.FIDELITY] == RESPONSE
    if spindle.shaft.external:
        block[SP.PORT_MASS], block[SP.PORT_STATIC], block[SP.PORT_TRANSVERSE] = bodies.rings_at_port(scene)
    block[SP.UNBALANCED] = bool(tables[SP.AT_UNBALANCE].any())
    block[SP.AT_S], block[SP.AT_W], block[SP.AT_Z] = places["S"], places["W"], places["Z"]
    mics, bands = (int(bearings[0][place]) for place in (P.MICS, P.BANDS))
    block[SP.FRONT] = places["S"] + SP.state_size(count, n, mics, bearings[0][P.FIDELITY] == RESPONSE)
    block[SP.SIZE_W] = places["W"] + SP.work_size(count, n)
    sensors = int(bearings[0][P.ACCELEROMETERS])
    block[SP.SIZE_Z] = places["Z"] + SP.output_size(count, mics, bands, sensors)
    _preload(scene, block)
    body, middle = housing_of(scene)
    housing = si(spindle.housing.model_copy(update={"material": None}))
    # The damping ratio counts what lies on the pedestal, as for a single bearing: all outer rings, because
    # the scene refuses pedestals of their own beside a housing that moves. No other housing needs it.
    block[SP.HOUSING_X] = middle
    block[SP.HOUSING_MASS] = body.mass + sum(p[P.OUTER_MASS] for p in bearings)
    block[SP.HOUSING_TRANSVERSE] = body.transverse + sum(p[P.OUTER_TRANSVERSE] for p in bearings)
    block[SP.HOUSING_POLAR] = body.polar + sum(p[P.OUTER_POLAR] for p in bearings)
    block[SP.PEDESTAL_Y : SP.PEDESTAL_Y + 6] = pedestal_axes(spindle.housing)
    block[SP.AXIAL_RATIO] = housing.pedestal_axial_ratio
    block[SP.ROTATIONAL_RATIO] = housing.pedestal_rotational_ratio
    block[SP.PEDESTAL_ZETA] = housing.pedestal_damping_ratio
    return block


def _preload(scene: Scene, block: NDArray[np.float64]) -> None:
    spindle = set_of(scene)
    kinds = {"spacer": SP.SPACER, "spring": SP.SPRING}
    block[SP.PRELOAD_KIND] = SP.TOUCHING if spindle.preload is None else kinds[spindle.preload.kind]
    one_way = len({bearing.sign for bearing in spindle.bearing}) == 1
    block[SP.ONE_WAY] = one_way and not spindle.shaft.external
    block[SP.SHAFT_EXPANSION], block[SP.HOUSING_EXPANSION] = expansions(scene)
