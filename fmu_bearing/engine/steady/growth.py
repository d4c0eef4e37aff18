"""How the whirl of a cage grows about the pattern at rest: one eigenvalue of the linearised equations.

About a pattern at rest places, spins and bodies may move as the real part of q exp(lambda t). A ball's places
then have the rates n D q + lambda q, with the slopes D of the pattern and the orbit n through it, and what is
out of balance is (A + lambda B + lambda^2 N) q: A are the derivatives of the pattern's balance, B holds
damping and running through the pattern, N inertia. The film drives a cage to a whirl at about half of the
speeds of its two sides; contacts, pockets and drag take energy from it. Where this whirl decays, the cage
rests where loads have pushed it; where it grows, the cage leaves that place for its orbit in the lands.
Inverse iteration from a forward whirl of the cage finds the eigenvalue, with one to three eliminations.
"""

import math

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import PT, STRIDE, J, P, Q, W
from fmu_bearing.engine.newton.jacobian import jacobian
from fmu_bearing.engine.steady.equations import ball_weight, body_weight, derivatives, is_fixed
from fmu_bearing.engine.steady.pattern import STENCIL, matrix_at, neighbour, show, slope_weight, tail, take

# Where the eigenvalue is looked for at first, in shares of shaft speed: a whirl by a little less than half of
# it, and sooner one that grows, as the one that decays slowest is asked for. Then beside what was found.
_GROWING = 0.15
_TURNING = 0.45
_BESIDE = 0.02
SHIFTS = 3
NOTHING = -1e300  # 1/s: growth where no whirl was found; the state of a search has to be numbers
_ROUNDS = 8  # with each
_CLOSE = 1e-4  # of shaft speed: what the last round may change


@kernel
def rate_coefficients(p, c, held, ahead, w, jac):
    """Fill ``PT.RATES`` with B: what the balance changes by per rate of the unknowns, running along."""
    balls = int(p[P.BALLS])
    last = tail(p)
    width = last + PT.TAIL + 1
    at = matrix_at(p, PT.RATES)
    through = w[W.PATTERN + PT.UNKNOWNS + last + PT.ORBIT]
    for i in range((last + Q.SIZE) * width):
        w[at + i] = 0.0
    for i in range(PT.BALL):
        factor = ball_weight(p, c, i)
        for j in range(balls):
            row = at + (i * balls + j) * width
            if i < PT.PLACED:
                for k in range(PT.PLACED):
                    by = J.B + (i * J.STATES + PT.PLACED + k) * STRIDE + j
                    w[row + k * balls + j] = factor * jac[by]
                for n in range(STENCIL):
                    near = row + i * balls + neighbour(p, j, n, ahead)
                    w[near] -= 2.0 * factor * through * slope_weight(p, n, ahead)
            else:
                for k in range(PT.PLACED):
                    by = J.B + (i * J.STATES + PT.PLACED + k) * STRIDE + j
                    w[row + k * balls + j] = factor * jac[by]
                w[row + i * balls + j] -= factor
            for k in range(Q.SIZE):
                w[row + last + k] = factor * jac[J.C + (i * J.BODIES + Q.SIZE + k) * STRIDE + j]
    for i in range(Q.SIZE):
        if is_fixed(p, i, held):
            continue
        row = at + (last + i) * width
        factor = body_weight(p, i)
        for k in range(PT.PLACED):
            for j in range(balls):
                by = J.D + (i * J.STATES + PT.PLACED + k) * STRIDE + j
                w[row + k * balls + j] = factor * jac[by]
        for k in range(Q.SIZE):
            w[row + last + k] = factor * jac[J.E + i * J.BODIES + Q.SIZE + k]


@kernel
def inertia_of(p, c, i, held):
    """Return the element of N on the diagonal of unknown ``i``; spins, rates themselves, have none."""
    balls = int(p[P.BALLS])
    last = tail(p)
    if i < PT.PLACED * balls:
        return -ball_weight(p, c, i // balls)
    if i < last or is_fixed(p, i - last, held):
        return 0.0
    return -body_weight(p, i - last)


@kernel
def combine(p, c, growth, turning, held, w):
    """Put A + lambda B + lambda^2 N to ``PT.MATRIX`` and ``PT.IMAGINARY``, from A and B there."""
    size = tail(p) + Q.SIZE
    width = tail(p) + PT.TAIL + 1
    real = matrix_at(p, PT.MATRIX)
    imaginary = matrix_at(p, PT.IMAGINARY)
    rates = matrix_at(p, PT.RATES)
    for i in range(size * width):
        w[real + i] += growth * w[rates + i]
        w[imaginary + i] = turning * w[rates + i]
    for i in range(size):
        inertia = inertia_of(p, c, i, held)
        w[real + i * width + i] += (growth * growth - turning * turning) * inertia
        w[imaginary + i * width + i] += 2.0 * growth * turning * inertia


@kernel
def factor_complex(re, im, n, m, order):
    """Factor a complex matrix, rows of ``m`` numbers of which ``n`` count, in place; False if singular.

    Below the diagonal are the factors of the rows; ``order``: the row that each was exchanged with.
    """
    for k in range(n):
        best = 0.0
        pivot = k
        for i in range(k, n):
            size = re[i * m + k] * re[i * m + k] + im[i * m + k] * im[i * m + k]
            if size > best:
                best = size
                pivot = i
        if not (best > 0.0 and best < 1e300):
            return False
        order[k] = pivot
        if pivot != k:
            for j in range(n):
                saved = re[k * m + j]
                re[k * m + j] = re[pivot * m + j]
                re[pivot * m + j] = saved
                saved = im[k * m + j]
                im[k * m + j] = im[pivot * m + j]
                im[pivot * m + j] = saved
        pr = re[k * m + k] / best
        pi = -im[k * m + k] / best
        for i in range(k + 1, n):
            xr = re[i * m + k]
            xi = im[i * m + k]
            if xr == 0.0 and xi == 0.0:
                continue
            fr = xr * pr - xi * pi
            fi = xr * pi + xi * pr
            re[i * m + k] = fr
            im[i * m + k] = fi
            own_re = re[i * m + k + 1 : i * m + n]
            own_im = im[i * m + k + 1 : i * m + n]
            row_re = re[k * m + k + 1 : k * m + n]
            row_im = im[k * m + k + 1 : k * m + n]
            for j in range(n - k - 1):
                own_re[j] -= fr * row_re[j] - fi * row_im[j]
                own_im[j] -= fr * row_im[j] + fi * row_re[j]
    return True


@kernel
def solve_factored(re, im, n, m, order, xr, xi):
    """Solve with what :func:`factor_complex` has left; the right side in ``xr``, ``xi``, then the answer."""
    for k in range(n):
        pivot = int(order[k])
        if pivot != k:
            saved = xr[k]
            xr[k] = xr[pivot]
            xr[pivot] = saved
            saved = xi[k]
            xi[k] = xi[pivot]
            xi[pivot] = saved
    for k in range(n):
        for j in range(k):
            xr[k] -= re[k * m + j] * xr[j] - im[k * m + j] * xi[j]
            xi[k] -= re[k * m + j] * xi[j] + im[k * m + j] * xr[j]
    for k in range(n - 1, -1, -1):
        for j in range(k + 1, n):
            xr[k] -= re[k * m + j] * xr[j] - im[k * m + j] * xi[j]
            xi[k] -= re[k * m + j] * xi[j] + im[k * m + j] * xr[j]
        pr = re[k * m + k]
        pi = im[k * m + k]
        size = pr * pr + pi * pi
        real = (xr[k] * pr + xi[k] * pi) / size
        xi[k] = (xi[k] * pr - xr[k] * pi) / size
        xr[k] = real


@kernel
def right_side(p, c, growth, turning, held, w):
    """Put -(B + lambda N) q - N q' to the right side; eigenvector q and its rates q' are in ``PT.EIGEN``."""
    size = tail(p) + Q.SIZE
    width = tail(p) + PT.TAIL + 1
    rates = matrix_at(p, PT.RATES)
    vector = w[W.PATTERN + PT.EIGEN : W.PATTERN + PT.FIRST_STATE]
    for i in range(size):
        real = 0.0
        imaginary = 0.0
        for k in range(size):
            real += w[rates + i * width + k] * vector[k]
            imaginary += w[rates + i * width + k] * vector[PT.VECTOR_IM + k]
        inertia = inertia_of(p, c, i, held)
        real += inertia * (growth * vector[i] - turning * vector[PT.VECTOR_IM + i] + vector[PT.RATE + i])
        imaginary += inertia * (turning * vector[i] + growth * vector[PT.VECTOR_IM + i])
        imaginary += inertia * vector[PT.RATE_IM + i]
        vector[PT.RIGHT + i] = -real
        vector[PT.RIGHT_IM + i] = -imaginary


@kernel
def begin_growth(p, speed, w):
    """Begin the search for the growth of a whirl with a cage that goes round ahead."""
    ahead = math.copysign(1.0, speed)
    last = tail(p)
    vector = w[W.PATTERN + PT.EIGEN : W.PATTERN + PT.FIRST_STATE]
    growth = _GROWING * abs(speed)
    turning = _TURNING * abs(speed)
    for i in range(PT.RIGHT_IM + PT.MOST):
        vector[i] = 0.0
    y = last + Q.CAGE + Q.Y
    z = last + Q.CAGE + Q.Z
    # y + i z turns ahead
    vector[y] = 1.0
    vector[PT.VECTOR_IM + z] = -ahead
    for i in (y, z):
        vector[PT.RATE + i] = growth * vector[i] - turning * vector[PT.VECTOR_IM + i]
        vector[PT.RATE_IM + i] = growth * vector[PT.VECTOR_IM + i] + turning * vector[i]
    w[W.PATTERN + PT.GROWTH] = growth
    w[W.PATTERN + PT.TURNING] = turning
    w[W.PATTERN + PT.FOUND_GROWTH] = NOTHING
    w[W.PATTERN + PT.FOUND_TURNING] = turning


@kernel
def growth_beside(p, c, speed, held, rest, w, jac):
    """Look beside ``PT.GROWTH`` and ``PT.TURNING`` for the cage's slowest decaying forward whirl.

    About the pattern ``rest``. Whether the search has ended; after `SHIFTS` of them it ends in any case.
    ``PT.FOUND_GROWTH`` (1/s) is `NOTHING` where there is none, ``PT.FOUND_TURNING`` its speed (rad/s,
    along the shaft's).
    """
    ahead = math.copysign(1.0, speed)
    last = tail(p)
    size = last + Q.SIZE
    width = last + PT.TAIL + 1
    re = w[matrix_at(p, PT.MATRIX) : matrix_at(p, PT.IMAGINARY)]
    im = w[matrix_at(p, PT.IMAGINARY) : matrix_at(p, PT.RATES)]
    order = w[W.PATTERN + PT.STEP : W.PATTERN + PT.SCALE]
    vector = w[W.PATTERN + PT.EIGEN : W.PATTERN + PT.FIRST_STATE]
    answer_re = vector[PT.RIGHT : PT.RIGHT_IM]
    answer_im = vector[PT.RIGHT_IM : PT.RIGHT_IM + PT.MOST]
    take(p, rest, 0.0, w)
    show(p, ahead, w, rest)
    jacobian(p, c, rest, 0.0, speed, 0.0, w, jac)
    rate_coefficients(p, c, held, ahead, w, jac)
    y = last + Q.CAGE + Q.Y
    z = last + Q.CAGE + Q.Z
    growth = w[W.PATTERN + PT.GROWTH]
    turning = w[W.PATTERN + PT.TURNING]
    derivatives(p, c, rest, held, ahead, False, w, jac)
    combine(p, c, growth, turning, held, w)
    if not factor_complex(re, im, size, width, order):
        return True
    for _ in range(_ROUNDS):
        right_side(p, c, growth, turning, held, w)
        solve_factored(re, im, size, width, order, answer_re, answer_im)
        # how far the cage goes round ahead: this stays 1
        far_re = 0.5 * (answer_re[y] - ahead * answer_im[z])
        far_im = 0.5 * (answer_im[y] + ahead * answer_re[z])
        far = far_re * far_re + far_im * far_im
        if not (far > 0.0):
            w[W.PATTERN + PT.FOUND_GROWTH] = NOTHING
            return True
        per_re = far_re / far
        per_im = -far_im / far
        for i in range(size):
            # the answer's rates are the vector and lambda times the answer
            rate_re = vector[i] + growth * answer_re[i] - turning * answer_im[i]
            rate_im = vector[PT.VECTOR_IM + i] + growth * answer_im[i] + turning * answer_re[i]
            vector[i] = answer_re[i] * per_re - answer_im[i] * per_im
            vector[PT.VECTOR_IM + i] = answer_re[i] * per_im + answer_im[i] * per_re
            vector[PT.RATE + i] = rate_re * per_re - rate_im * per_im
            vector[PT.RATE_IM + i] = rate_re * per_im + rate_im * per_re
        moved = abs(growth + per_re - w[W.PATTERN + PT.FOUND_GROWTH])
        moved += abs(turning + per_im - w[W.PATTERN + PT.FOUND_TURNING])
        w[W.PATTERN + PT.FOUND_GROWTH] = growth + per_re
        w[W.PATTERN + PT.FOUND_TURNING] = turning + per_im
        if moved < _CLOSE * abs(speed):
            return True
    w[W.PATTERN + PT.GROWTH] = w[W.PATTERN + PT.FOUND_GROWTH] + _BESIDE * abs(speed)
    w[W.PATTERN + PT.TURNING] = w[W.PATTERN + PT.FOUND_TURNING]
    return False
