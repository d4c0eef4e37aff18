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

from fmu_bearing.engine.choices import OUTER_GUIDED
from fmu_bearing.engine.complex_numbers import complex_at, over, pair, real_times, square
from fmu_bearing.engine.dense import swap
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
# Whirls that grow turned with 0.35 to 0.42 of shaft speed on the outer ring, with 0.42 to 0.53 on the inner
# one, of the same bearings: between what the film carries round and the balls, which the pockets press on.
_ON_OUTER = 0.75
SHIFTS = 3
NOTHING = -1e300  # 1/s: growth where no whirl was found; the state of a search has to be numbers
_ROUNDS = 8  # with each
_CLOSE = 1e-4  # of shaft speed: what the last round may change


@kernel
def rate_coefficients(p, c, fixed, ahead, w, jac):
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
        if is_fixed(p, i, fixed):
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
def inertia_of(p, c, i, fixed):
    """Return the element of N on the diagonal of unknown ``i``; spins, rates themselves, have none."""
    balls = int(p[P.BALLS])
    last = tail(p)
    if i < PT.PLACED * balls:
        return -ball_weight(p, c, i // balls)
    if i < last or is_fixed(p, i - last, fixed):
        return 0.0
    return -body_weight(p, i - last)


@kernel
def combine(p, c, growth, turning, fixed, w):
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
        inertia = inertia_of(p, c, i, fixed)
        w[real + i * width + i] += (growth * growth - turning * turning) * inertia
        w[imaginary + i * width + i] += 2.0 * growth * turning * inertia


@kernel
def factor_complex(re, im, n, m, order):
    """Factor a complex matrix, rows of ``m`` numbers of which ``n`` count, in place; False if singular.

    Below the diagonal are the factors of the rows; ``order``: the row that each was exchanged with. Real and
    imaginary parts apart: by complex numbers it takes 1.6 times as long.
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
        swap(re, k * m, pivot * m, n)
        swap(im, k * m, pivot * m, n)
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
def solve_factored(re, im, n, m, order, x):
    """Solve with what :func:`factor_complex` has left; the right side in ``x``, then the answer; complex."""
    for k in range(n):
        swap(x, k, int(order[k]), 1)
    for k in range(n):
        total = x[k]
        for j in range(k):
            total -= complex(re[k * m + j], im[k * m + j]) * x[j]
        x[k] = total
    for k in range(n - 1, -1, -1):
        total = x[k]
        for j in range(k + 1, n):
            total -= complex(re[k * m + j], im[k * m + j]) * x[j]
        x[k] = over(total, complex(re[k * m + k], im[k * m + k]))


@kernel
def eigen_row(w, row):
    """Complex row of the eigenvector: itself, its rates, or the right side; see ``PT.VECTOR``."""
    return complex_at(w, W.PATTERN + PT.EIGEN + row, PT.MOST)


@kernel
def right_side(p, c, rate, fixed, w):
    """Put -(B + lambda N) q - N q' to the right side; ``rate``: lambda.

    The eigenvector q and its rates q' are in ``PT.EIGEN``.
    """
    size = tail(p) + Q.SIZE
    width = tail(p) + PT.TAIL + 1
    rates = matrix_at(p, PT.RATES)
    vector, moving, right = eigen_row(w, PT.VECTOR), eigen_row(w, PT.RATE), eigen_row(w, PT.RIGHT)
    for i in range(size):
        total = real_times(inertia_of(p, c, i, fixed), rate * vector[i] + moving[i])
        for k in range(size):
            total += real_times(w[rates + i * width + k], vector[k])
        right[i] = -total


@kernel
def land_speed(p, speed):
    """Shaft ``speed`` at which a cage on the inner ring would whirl as this one does at ``speed``."""
    return _ON_OUTER * speed if p[P.GUIDANCE] == OUTER_GUIDED else speed


@kernel
def begin_growth(p, speed, w):
    """Begin the search for the growth of a whirl with a cage that goes round ahead."""
    ahead = math.copysign(1.0, speed)
    vector, moving, right = eigen_row(w, PT.VECTOR), eigen_row(w, PT.RATE), eigen_row(w, PT.RIGHT)
    fast = land_speed(p, abs(speed))
    rate = complex(_GROWING * fast, _TURNING * fast)
    for i in range(PT.MOST):
        vector[i], moving[i], right[i] = 0.0, 0.0, 0.0
    y = tail(p) + Q.CAGE + Q.Y
    z = tail(p) + Q.CAGE + Q.Z
    # y + i z turns ahead
    vector[y] = 1.0
    vector[z] = complex(0.0, -ahead)
    for i in (y, z):
        moving[i] = rate * vector[i]
    w[W.PATTERN + PT.GROWTH] = rate.real
    w[W.PATTERN + PT.TURNING] = rate.imag
    w[W.PATTERN + PT.FOUND_GROWTH] = NOTHING
    w[W.PATTERN + PT.FOUND_TURNING] = rate.imag


@kernel
def growth_beside(p, c, speed, fixed, rest, w, jac):
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
    vector, moving, answer = eigen_row(w, PT.VECTOR), eigen_row(w, PT.RATE), eigen_row(w, PT.RIGHT)
    take(p, rest, 0.0, w)
    show(p, ahead, w, rest)
    jacobian(p, c, rest, 0.0, speed, 0.0, w, jac)
    rate_coefficients(p, c, fixed, ahead, w, jac)
    y = last + Q.CAGE + Q.Y
    z = last + Q.CAGE + Q.Z
    rate = pair(w, W.PATTERN + PT.GROWTH)
    derivatives(p, c, rest, fixed, ahead, False, w, jac)
    combine(p, c, rate.real, rate.imag, fixed, w)
    if not factor_complex(re, im, size, width, order):
        return True
    for _ in range(_ROUNDS):
        right_side(p, c, rate, fixed, w)
        solve_factored(re, im, size, width, order, answer)
        # how far the cage goes round ahead: this stays 1
        far = 0.5 * (answer[y] + complex(0.0, ahead) * answer[z])
        if not (square(far) > 0.0):
            w[W.PATTERN + PT.FOUND_GROWTH] = NOTHING
            return True
        per = over(complex(1.0, 0.0), far)
        for i in range(size):
            # the answer's rates are the vector and lambda times the answer
            moving[i] = (vector[i] + rate * answer[i]) * per
            vector[i] = answer[i] * per
        found = rate + per
        moved = abs(found.real - w[W.PATTERN + PT.FOUND_GROWTH])
        moved += abs(found.imag - w[W.PATTERN + PT.FOUND_TURNING])
        w[W.PATTERN + PT.FOUND_GROWTH] = found.real
        w[W.PATTERN + PT.FOUND_TURNING] = found.imag
        if moved < _CLOSE * abs(speed):
            return True
    w[W.PATTERN + PT.GROWTH] = w[W.PATTERN + PT.FOUND_GROWTH] + _BESIDE * abs(speed)
    w[W.PATTERN + PT.TURNING] = w[W.PATTERN + PT.FOUND_TURNING]
    return False
