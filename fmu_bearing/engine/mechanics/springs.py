"""Springs and dampers between neighbouring balls in place of a cage (impact-noise paper, 1e5 to 2.5e7 N/m).

Each joins two balls along the pitch circle and is slack where they are 2 pi / Z apart. The pull on the
pitch radius gives both balls the same moment about the bearing's axis, whatever their own radius.
"""

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import F, P, Y
from fmu_bearing.engine.mechanics.trigonometry import TWO_PI, wrap


@kernel
def spring_forces(p, y, f):
    """Add what the springs do to the balls' orbit accelerations in ``f``; returns the power lost (W).

    Spare lanes get what ball 0 gets.
    """
    balls = int(p[P.BALLS])
    pitch = p[P.PITCH_RADIUS]
    stiffness = p[P.SPRINGS]
    damping = p[P.SPRING_DAMPING]
    gap = TWO_PI / balls
    per_mass = pitch * pitch / p[P.BALL_MASS]
    lost = 0.0
    before = 0.0
    for n in range(-1, balls):
        j = n if n >= 0 else balls - 1
        k = j + 1 if j + 1 < balls else 0
        apart = wrap(y[Y.TH + k] - y[Y.TH + j] - gap)
        opening = y[Y.OM + k] - y[Y.OM + j]
        pull = stiffness * apart + damping * opening
        if n >= 0:
            radius = pitch + y[Y.R + j]
            given = (pull - before) * per_mass / (radius * radius)
            f[F.TH + j] += given
            lost += damping * pitch * pitch * opening * opening
            if j == 0:
                for lane in range(balls, int(p[P.LANES])):
                    f[F.TH + lane] += given
        before = pull
    return lost


@kernel
def spring_energy(p, y):
    """Elastic energy (J) of the springs between the balls."""
    balls = int(p[P.BALLS])
    pitch = p[P.PITCH_RADIUS]
    total = 0.0
    for j in range(balls):
        k = j + 1 if j + 1 < balls else 0
        apart = pitch * wrap(y[Y.TH + k] - y[Y.TH + j] - TWO_PI / balls)
        total += 0.5 * p[P.SPRINGS] * apart * apart
    return total
