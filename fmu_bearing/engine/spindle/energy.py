"""Stored energy of a set; its right-hand side is refreshed on the way."""

from fmu_bearing.engine.fidelities.full.progress import total_energy
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import SP, S
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.spindle.follow import accelerate
from fmu_bearing.engine.spindle.shaft import shaft_energy


@kernel
def set_energy(p, s, w):
    """Return the stored energy (J) of the state; accelerations and powers there are computed anew."""
    total = 0.0
    for b in range(members.count(p)):
        total += total_energy(members.parameters(p, b), members.state(p, s, b), members.work(p, w, b))
    own = members.own_state(p, s)
    work, bent, shaken = accelerate(p, s, w, False, 0.0, s[S.ANGLE], s[S.SPEED], s[S.SPEED_RATE])
    own[SP.POWER_NOW] = work
    own[SP.POWER_NOW + 1] = bent
    own[SP.POWER_NOW + 2] = shaken
    n = members.padded(p)
    total += shaft_energy(
        p, own, own, SP.S_HEAD, SP.S_HEAD + n, members.own_work(p, w), members.vector(p, SP.FORCE)
    )
    return total
