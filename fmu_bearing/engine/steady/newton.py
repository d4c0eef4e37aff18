"""Newton's method for a pattern, with limited steps that are halved where the balance gets worse."""

import math

from fmu_bearing.engine.dense import eliminate
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import PT, F, P, Q, W
from fmu_bearing.engine.newton.jacobian import is_angle, jacobian
from fmu_bearing.engine.steady.equations import derivatives, out_of_balance, residual
from fmu_bearing.engine.steady.pattern import matrix_at, show, tail

#: What a round of Newton's method comes to.
GOES_ON, SETTLED, FAILED = range(3)

_HALVINGS = 6
# Longest steps: of a ball in its contacts about their approach, along its orbit less than a pocket's
# clearance, of a body some ten approaches, of a spin and a speed three per cent.
_FAR = 3e-6  # m
_ALONG = 2e-5  # m
_WIDE = 3e-5  # m
_TURNED = 0.03
# Steps below this share of the longest end the search: the next one would be the square of it.
_SETTLED = 1e-3
_BALANCED = 1e-4  # N: what may then be out of balance; contacts carry 10 N and more


@kernel
def longest_steps(p, reach, w):
    """Fill ``PT.SCALE`` with the longest steps, in the unknowns' units; ``reach``: see `settle_pattern`."""
    balls = int(p[P.BALLS])
    at = W.PATTERN + PT.SCALE
    unknown = W.PATTERN + PT.UNKNOWNS
    last = tail(p)
    pitch = p[P.PITCH_RADIUS]
    for j in range(balls):
        spin = 1e-3
        for i in range(PT.PLACED, PT.BALL):
            spin += abs(w[unknown + i * balls + j])
        w[at + j] = _FAR
        w[at + balls + j] = _FAR
        w[at + 2 * balls + j] = reach * _ALONG / pitch
        for i in range(PT.PLACED, PT.BALL):
            w[at + i * balls + j] = _TURNED * spin
    for i in range(Q.SIZE):
        w[at + last + i] = _WIDE / (pitch if is_angle(i) else 1.0)
    w[at + last + Q.OUTER + Q.TURN] = 1.0  # rad: no contact knows it
    for i in (PT.ORBIT, PT.WHIRL):
        w[at + last + i] = _TURNED * abs(w[unknown + last + PT.ORBIT]) + 1e-3


@kernel
def solve(p, w):
    """Solve the equations in ``PT.MATRIX``, the right-hand side in their last column, for ``PT.STEP``.

    Returns the step's largest share of the longest one; negative where there is none.
    """
    size = tail(p) + PT.TAIL
    at = matrix_at(p, PT.MATRIX)
    for i in range(size):
        row = at + i * (size + 1)
        largest = 0.0
        for k in range(size):
            w[row + k] *= w[W.PATTERN + PT.SCALE + k]
            largest = max(largest, abs(w[row + k]))
        per = 1.0 / (largest + 1e-300)
        for k in range(size + 1):
            w[row + k] *= per
    if not eliminate(w, at, size):
        return -1.0
    most = 0.0
    for i in range(size):
        share = w[at + i * (size + 1) + size]
        if not (abs(share) < 1e9):
            return -1.0
        most = max(most, abs(share))
        w[W.PATTERN + PT.STEP + i] = share * w[W.PATTERN + PT.SCALE + i]
    return most


@kernel
def move(p, share, w):
    """Go ``share`` of the step in ``PT.STEP``."""
    for i in range(tail(p) + PT.TAIL):
        w[W.PATTERN + PT.UNKNOWNS + i] += share * w[W.PATTERN + PT.STEP + i]


@kernel
def settle_once(p, c, speed, fixed, ahead, whirls, reach, y, w, jac):
    """One round of Newton's method for the pattern in ``PT.UNKNOWNS``: `SETTLED`, `FAILED` or `GOES_ON`.

    ``fixed``: see `equations.is_fixed`; ``ahead``: 1 where balls run to larger phases, -1 to smaller ones;
    ``whirls``: the pattern turns with the cage; ``reach``: how far balls may go along their orbit in a round,
    1 where pockets are as stiff as they are. ``y``: the state of the pattern. ``jac``: scratch.
    """
    f = w[W.F0 : W.F0 + F.SIZE]
    size = tail(p) + PT.TAIL
    at = matrix_at(p, PT.MATRIX)
    show(p, ahead, w, y)
    jacobian(p, c, y, 0.0, speed, 0.0, w, jac)
    before = residual(p, c, y, f, fixed, ahead, whirls, w)
    derivatives(p, c, y, fixed, ahead, whirls, w, jac)
    for i in range(size):
        w[at + i * (size + 1) + size] = -w[W.PATTERN + PT.RESIDUAL + i]
    longest_steps(p, reach, w)
    most = solve(p, w)
    if most < 0.0:
        return FAILED
    share = 1.0 / max(most, 1.0)
    move(p, share, w)
    show(p, ahead, w, y)
    after = out_of_balance(p, c, speed, y, fixed, ahead, whirls, w, f)
    if most < _SETTLED and after < _BALANCED:
        return SETTLED
    for _ in range(_HALVINGS):
        if after < before or most < _SETTLED:
            break
        share *= 0.5
        move(p, -share, w)
        show(p, ahead, w, y)
        after = out_of_balance(p, c, speed, y, fixed, ahead, whirls, w, f)
    return GOES_ON if math.isfinite(after) else FAILED


@kernel
def displace_cage(p, c, speed, offset, ahead, y, w, jac):
    """Move the cage by ``offset`` (m) along z in a whirl about the even state, and the balls as they respond.

    The balls' response is linear; rings stay. False where there is none.
    """
    size = tail(p) + PT.TAIL
    last = tail(p)
    at = matrix_at(p, PT.MATRIX)
    show(p, ahead, w, y)
    jacobian(p, c, y, 0.0, speed, 0.0, w, jac)
    derivatives(p, c, y, 0, ahead, True, w, jac)
    for i in range(size):
        row = at + i * (size + 1)
        if i >= last:
            for k in range(size):
                w[row + k] = 1.0 if i == k else 0.0
        w[row + size] = offset if i == last + Q.CAGE + Q.Z else 0.0
    longest_steps(p, 1.0, w)
    if solve(p, w) < 0.0:
        return False
    move(p, 1.0, w)
    return True
