"""Arrays and numbers of one bearing of a set, and how shaft and housing move its driven rows.

Kernels of sets, here and in ``fidelities``, have these arguments. Arrays are one-dimensional, of float64, in
SI units. A vector is given as an array and the place of its first number: ``x[at:]``, ``out[to:]``.

===================  =====================================================================================
``p``                parameters of all bearings, then the set's block at ``p[P.SET]``; of one: ``pb``
``u``                inputs: ``U.INPUTS``, then ``U.BEARING_INPUTS`` of each bearing
``s``                states of all bearings, then the set's own; of one: ``sb``
``w``                work spaces of all bearings, then the set's own; of one: ``wb``
``z``                outputs of all bearings, then the set's own; of one: ``zb``
``own``, ``ws``      the set's own state and work space (`set_state`, `set_work`); without a shaft: see there
``lv``               what fidelities rings and response keep of one bearing (`condensed`), layout ``L``
``c``, ``y``, ``f``  of one bearing: conditions, state, right-hand side; layouts ``C``, ``Y``, ``F``
``b``                number of a bearing, from 0; ``r``: place of its numbers in ``p`` (`row`)
``n``, ``lanes``     coordinates (`coordinates`), and how many numbers their vectors have (`padded_size`)
``q``, ``v``         where places (m, rad) and rates (m/s, rad/s) of the coordinates begin
``at``               unless said otherwise, begin of a bearing's scratch in ``ws`` (`scratch`)
``bearing_at``       begin of a bearing's numbers in ``own`` (`per_bearing`)
``angle``, ``rate``  of the shaft (rad, rad/s2); ``speed``: rad/s
``h``, ``t``         length of a step (s); time since its begin (s)
``gh``               weight of rates in a stage (s): diagonal entry of the method times ``h``
===================  =====================================================================================

Vectors of the coordinates have ``lanes`` numbers, zero from the n-th on: m and rad, m/s and rad/s, m/s2 and
rad/s2, or N and N m. Matrices of the coordinates have n columns of ``lanes`` numbers in ``p`` and ``own``, n
rows of n numbers in ``ws``. Vectors of a bearing's driven rows have ``SP.LANES`` numbers: inner ring x y z by
bz, then the outer ring's x y z, rotation, by bz where it is driven, then zeros.
"""

from fmu_bearing.engine.choices import FULL
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, splat, store, sum_four
from fmu_bearing.engine.layout import FOUR, SP, H, L, P, Q, S, W


@kernel
def bearing_count(p):
    """Return how many bearings the set has."""
    if not has_shaft(p):
        return 1
    return int(p[int(p[P.SET]) + SP.BEARINGS])


@kernel
def coordinates(p):
    """Return how many coordinates shaft, housing and sliding rings have.

    A single bearing has its rings' own in fidelities rings and response, none in full.
    """
    if not has_shaft(p):
        return 0 if p[P.FIDELITY] == FULL else L.N
    return int(p[int(p[P.SET]) + SP.COUNT])


@kernel
def has_shaft(p):
    """Whether a shaft carries the bearings; a single bearing has no coordinates but its own.

    All kernels ask here: where they are compiled for single bearings alone, each call is ``False``.
    """
    return p[P.ALONE] == 0.0


@kernel
def padded_size(p):
    """Return how many numbers a vector of the coordinates has: whole groups of four."""
    if not has_shaft(p):
        return 0 if p[P.FIDELITY] == FULL else L.COLUMN
    return int(p[int(p[P.SET]) + SP.PADDED_SIZE])


@kernel
def table(p, place):
    """Place in ``p`` of the set's table that ``place`` names, such as ``SP.AT_MASS``."""
    block = int(p[P.SET])
    return block + int(p[block + place])


@kernel
def row(p, b):
    """Place in ``p`` of the numbers ``SP.ROW_P`` and so on of bearing ``b``."""
    return table(p, SP.AT_ROWS) + b * SP.ROW


@kernel
def parameters(p, b):
    """Return the parameters of bearing ``b``."""
    if not has_shaft(p):
        return p
    r = row(p, b)
    return p[int(p[r + SP.ROW_P]) : int(p[r + SP.ROW_P]) + int(p[r + SP.ROW_P_SIZE])]


@kernel
def state(p, s, b):
    """Return the state of bearing ``b``."""
    if not has_shaft(p):
        return s
    r = row(p, b)
    return s[int(p[r + SP.ROW_S]) : int(p[r + SP.ROW_S]) + int(p[r + SP.ROW_S_SIZE])]


@kernel
def work(p, w, b):
    """Return the work space of bearing ``b``."""
    if not has_shaft(p):
        return w
    r = row(p, b)
    return w[int(p[r + SP.ROW_W]) : int(p[r + SP.ROW_W]) + int(p[r + SP.ROW_W_SIZE])]


@kernel
def condensed(sb):
    """Return ``lv``, what fidelities rings and response keep in a bearing's state: ``L.SIZE`` numbers."""
    return sb[S.CONDENSED : S.CONDENSED + L.SIZE]


@kernel
def outputs(p, z, b):
    """Return the outputs of bearing ``b``."""
    if not has_shaft(p):
        return z
    r = row(p, b)
    return z[int(p[r + SP.ROW_Z]) : int(p[r + SP.ROW_Z]) + int(p[r + SP.ROW_Z_SIZE])]


@kernel
def set_state(p, s):
    """Return the set's own state, ``SP.NOSE`` and so on; of a single bearing from ``S.SET`` on."""
    if not has_shaft(p):
        return s[S.SET :]
    return s[int(p[int(p[P.SET]) + SP.AT_S]) :]


@kernel
def set_work(p, w):
    """Return the set's own work space, ``SP.INPUT`` and so on; of a single bearing from ``W.SET`` on."""
    if not has_shaft(p):
        return w[W.SET :]
    return w[int(p[int(p[P.SET]) + SP.AT_W]) :]


@kernel
def per_bearing(p, b):
    """Place in the set's own state of the numbers ``SP.OFFSET`` and so on of bearing ``b``."""
    return SP.S_HEAD + SP.MOTION * padded_size(p) + b * SP.PER_BEARING


@kernel
def inverse(p):
    """Place in the set's own state of the inverse Newton matrix, by columns."""
    return SP.S_HEAD + SP.MOTION * padded_size(p) + bearing_count(p) * SP.PER_BEARING


@kernel
def march(p):
    """Place in the set's own state of the ``SP.MARCHED`` numbers of its march by Newmark's method."""
    return inverse(p) + coordinates(p) * padded_size(p)


@kernel
def history(p):
    """Place in the set's own state of the march's vectors, ``H.VECTORS`` of them."""
    return march(p) + SP.MARCHED


@kernel
def squares(p):
    """Place in the set's own state of the march's matrix B^-1 J_x (1/s2), by columns."""
    return squares_at(history(p), padded_size(p))


@kernel
def alone(p, b):
    """Place in the set's own state of mean squares (Pa2) of bearing ``b`` alone, one per microphone."""
    return squares(p) + coordinates(p) * padded_size(p) + b * int(p[P.MICS])


@kernel
def lines(p):
    """Place in the set's own state of its lines, `line_size` numbers each (fidelity response)."""
    return alone(p, bearing_count(p))


@kernel
def line_size(p):
    """Return how many numbers a line has."""
    return SP.LINE_REAL + 2 * padded_size(p)


@kernel
def z_mics(p):
    """Place in ``z`` of the microphones, as of a single bearing; behind them the bearings' own levels."""
    return int(p[int(p[P.SET]) + SP.AT_Z]) + SP.Z_FORCES + SP.Z_FORCE * bearing_count(p)


@kernel
def scratch(p, b):
    """Place in the set's own work space of bearing ``b``'s ``SP.SCRATCH`` numbers."""
    return SP.W_HEAD + SP.VECTORS * padded_size(p) + b * SP.SCRATCH


@kernel
def matrix(p):
    """Place in the set's own work space of the matrix of the shaft's equations, or of the start's."""
    return SP.W_HEAD + SP.VECTORS * padded_size(p) + bearing_count(p) * SP.SCRATCH


@kernel
def complex_matrix(p):
    """Places in the set's own work space: imaginary parts of complex equations, then what is free behind.

    Their real parts are at `matrix`, both by padded columns, the right side last.
    """
    size = (coordinates(p) + 1) * padded_size(p)
    return matrix(p) + size, matrix(p) + 2 * size


@kernel
def vector(p, k):
    """Place in the set's own work space of vector ``k``: ``SP.PLACE`` and so on, or a stage's number."""
    return vector_at(padded_size(p), k)


@kernel
def vector_at(lanes, k):
    """As `vector`, for vectors of ``lanes`` numbers: inner loops need not read sizes from ``p`` again."""
    return SP.W_HEAD + k * lanes


@kernel
def squares_at(vectors, lanes):
    """As `squares`, for the march's vectors at ``vectors``."""
    return vectors + H.VECTORS * lanes


@kernel
def inverse_at(vectors, n, lanes):
    """As `inverse`, for ``n`` coordinates and the march's vectors at ``vectors``."""
    return vectors - SP.MARCHED - n * lanes


@kernel
def add_columns(m, at, lanes, count, scale, x, first, out, to):
    """``out[to:] += scale M x[first:]``, M by ``count`` columns of ``lanes`` numbers at ``m[at:]``.

    Two groups of lanes go together, so that the sum of one need not wait for that of the other.
    """
    for i in range(0, lanes - FOUR, 2 * FOUR):
        one = splat(0.0)
        two = splat(0.0)
        for k in range(count):
            column = at + k * lanes + i
            one += load(m, column) * x[first + k]
            two += load(m, column + FOUR) * x[first + k]
        store(out, to + i, load(out, to + i) + scale * one)
        store(out, to + i + FOUR, load(out, to + i + FOUR) + scale * two)
    if lanes % (2 * FOUR) != 0:
        i = lanes - FOUR
        total = splat(0.0)
        for k in range(count):
            total += load(m, at + k * lanes + i) * x[first + k]
        store(out, to + i, load(out, to + i) + scale * total)


@kernel
def driven_motion(p, b, x, at, out, to):
    """Put ``T x[at:]``, the motion of bearing ``b``'s driven rows with the coordinates, to ``out[to:]``."""
    if not has_shaft(p):
        for i in range(0, SP.LANES, FOUR):
            store(out, to + i, load(x, at + i))
        return
    r = row(p, b)
    t = int(p[r + SP.ROW_AT_T])
    columns = int(p[r + SP.ROW_AT_COLUMNS])
    one = splat(0.0)
    two = splat(0.0)
    three = splat(0.0)
    for m in range(int(p[r + SP.ROW_COLUMNS])):
        k = int(p[columns + m])
        column = t + k * SP.LANES
        one += load(p, column) * x[at + k]
        two += load(p, column + FOUR) * x[at + k]
        three += load(p, column + 2 * FOUR) * x[at + k]
    store(out, to, one)
    store(out, to + FOUR, two)
    store(out, to + 2 * FOUR, three)


@kernel
def add_seat_tilt(p, b, out, to):
    """Tilt the outer ring of bearing ``b``, of driven rows' places ``out[to:]``, with the seat that holds it.

    A ring on a pedestal of its own is tilted by that.
    """
    if has_shaft(p):
        at = row(p, b) + SP.ROW_SEAT_TILT
        out[to + Q.OUTER + Q.BY] += p[at]
        out[to + Q.OUTER + Q.BZ] += p[at + 1]


@kernel
def place_rows(p, b, own, x, at, out, to):
    """Put the places of bearing ``b``'s driven rows by the coordinates ``x[at:]`` to ``out[to:]``."""
    driven_motion(p, b, x, at, out, to)
    add_seat_tilt(p, b, out, to)
    out[to + Q.X] += own[per_bearing(p, b) + SP.OFFSET]


@kernel
def project_forces(p, b, forces, at, out, to):
    """Add ``T^T forces[at:]``, of bearing ``b``'s driven rows, to the coordinates' forces ``out[to:]``."""
    if not has_shaft(p):
        for i in range(0, SP.LANES, FOUR):
            store(out, to + i, load(out, to + i) + load(forces, at + i))
        return
    r = row(p, b)
    t = int(p[r + SP.ROW_AT_T])
    columns = int(p[r + SP.ROW_AT_COLUMNS])
    one = load(forces, at)
    two = load(forces, at + FOUR)
    three = load(forces, at + 2 * FOUR)
    for m in range(int(p[r + SP.ROW_COLUMNS])):
        k = int(p[columns + m])
        column = t + k * SP.LANES
        total = load(p, column) * one + load(p, column + FOUR) * two + load(p, column + 2 * FOUR) * three
        out[to + k] += sum_four(total)


@kernel
def add_product(p, at, scale, x, first, out, to):
    """``out[to:] += scale M x[first:]``, the matrix of the coordinates' size at ``p[at:]``."""
    add_columns(p, at, padded_size(p), coordinates(p), scale, x, first, out, to)
