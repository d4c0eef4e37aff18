"""Arrays and numbers of one bearing of a set, and how shaft and housing move its driven rows."""

from fmu_bearing.engine.choices import FULL
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, splat, store, sum_four
from fmu_bearing.engine.layout import FOUR, SP, H, L, P, S, W


@kernel
def count(p):
    """Return how many bearings the set has."""
    if p[P.ALONE] != 0.0:
        return 1
    return int(p[int(p[P.SET]) + SP.BEARINGS])


@kernel
def coordinates(p):
    """Return how many coordinates shaft, housing and sliding rings have.

    A single bearing has those of its rings in fidelities rings and response, none in full.
    """
    if p[P.ALONE] != 0.0:
        return 0 if p[P.FIDELITY] == FULL else L.N
    return int(p[int(p[P.SET]) + SP.COUNT])


@kernel
def has_shaft(p):
    """Whether a shaft carries the bearings; a single bearing has no coordinates but its own."""
    return p[P.ALONE] == 0.0


@kernel
def padded_size(p):
    """Return how many numbers a vector of the coordinates has: whole groups of four."""
    if p[P.ALONE] != 0.0:
        return 0 if p[P.FIDELITY] == FULL else L.COLUMN
    return int(p[int(p[P.SET]) + SP.PADDED_SIZE])


@kernel
def table(p, place):
    """Begin in ``p`` of the set's table that ``place`` of its block tells."""
    block = int(p[P.SET])
    return block + int(p[block + place])


@kernel
def row(p, b):
    """Begin in ``p`` of the numbers of bearing ``b``."""
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
    """Return what fidelity rings keeps of a bearing with the state ``sb``."""
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
    """Return the set's own state."""
    if p[P.ALONE] != 0.0:
        return s[S.SET :]
    return s[int(p[int(p[P.SET]) + SP.AT_S]) :]


@kernel
def set_work(p, w):
    """Return the set's own work space."""
    if p[P.ALONE] != 0.0:
        return w[W.SET :]
    return w[int(p[int(p[P.SET]) + SP.AT_W]) :]


@kernel
def per_bearing(p, b):
    """Begin in the set's own state of what it keeps of bearing ``b``."""
    return SP.S_HEAD + SP.MOTION * padded_size(p) + b * SP.PER_BEARING


@kernel
def inverse(p):
    """Begin in the set's own state of the inverse Newton matrix."""
    return SP.S_HEAD + SP.MOTION * padded_size(p) + count(p) * SP.PER_BEARING


@kernel
def march(p):
    """Begin in the set's own state of what its march by Newmark's method keeps (fidelity rings)."""
    return inverse(p) + coordinates(p) * padded_size(p)


@kernel
def history(p):
    """Begin in the set's own state of the march's vectors."""
    return march(p) + SP.MARCHED


@kernel
def squares(p):
    """Begin in the set's own state of the march's matrix B^-1 J_x."""
    return squares_at(history(p), padded_size(p))


@kernel
def alone(p, b):
    """Begin in the set's own state of mean squares (Pa2) of bearing ``b`` alone, one per microphone."""
    return squares(p) + coordinates(p) * padded_size(p) + b * int(p[P.MICS])


@kernel
def lines(p):
    """Begin in the set's own state of its lines (fidelity response)."""
    return alone(p, count(p))


@kernel
def line_size(p):
    """Return how many numbers a line has."""
    return SP.LINE_REAL + 2 * padded_size(p)


@kernel
def z_mics(p):
    """Place in ``z`` of the microphones, as of a single bearing; behind them the bearings' own levels."""
    return int(p[int(p[P.SET]) + SP.AT_Z]) + SP.Z_FORCES + SP.Z_FORCE * count(p)


@kernel
def scratch(p, b):
    """Begin in the set's own work space of bearing ``b``'s numbers."""
    return SP.W_HEAD + SP.VECTORS * padded_size(p) + b * SP.SCRATCH


@kernel
def matrix(p):
    """Begin in the set's own work space of a matrix of the shaft's equations, or of the start's."""
    return SP.W_HEAD + SP.VECTORS * padded_size(p) + count(p) * SP.SCRATCH


@kernel
def vector(p, k):
    """Begin in the set's own work space of vector ``k``: ``SP.PLACE`` and those behind it."""
    return vector_at(padded_size(p), k)


@kernel
def vector_at(lanes, k):
    """As `vector`, for vectors of ``lanes`` numbers: inner loops need not read places from ``p`` again."""
    return SP.W_HEAD + k * lanes


@kernel
def squares_at(vectors, lanes):
    """As `squares`, for a history at ``x``."""
    return vectors + H.VECTORS * lanes


@kernel
def inverse_at(vectors, n, lanes):
    """As `inverse`, for ``n`` coordinates and a history at ``x``."""
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
def moved(p, b, x, at, out, to):
    """Put what coordinates ``x[at:]`` do to driven rows of bearing ``b`` to ``LANES`` numbers of ``out``."""
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
def pull(p, b, forces, at, out, to):
    """Add to ``out[to:]`` what forces on the driven rows of bearing ``b`` do to the coordinates.

    ``forces[at:]``: ``LANES`` numbers, spare ones zero.
    """
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
