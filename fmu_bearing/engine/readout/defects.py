"""What outputs tell of local defects: which ball is over one, since when, and when it struck.

The ball nearest to a defect is followed from step to step: of a race by its angle on the ring, of a ball by
the angle from the defect to its two contacts. A ball enters where its middle comes over the edge of the
defect, half a length from its middle, and strikes where it last turns round in it: until there it sinks
towards the race. Where it turns round on its way up again, as rings shake, is no impact: a tenth of the way
down is the most that it may have risen. Times are those of straight lines between the ends of a step. None of
it acts on the bearing.
"""

import math

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import DE, P, Q, R, S, Y, Z
from fmu_bearing.engine.mechanics.defects import head_of, table_of, within
from fmu_bearing.engine.mechanics.trigonometry import wrap

_RISEN = 0.1  # of the way down, assumed: further up a ball is on its way out


@kernel
def turned_by(s, race):
    """Angle (rad) by which a ring has turned."""
    return s[S.ANGLE] if race == 0 else s[S.Y + Y.Q0 + Q.OUTER + Q.TURN]


@kernel
def on_ring(p, s, race, j):
    """Angle (rad) of ball ``j`` on a ring; how far it is towards the ring's race (m), and how fast (m/s)."""
    ring = S.Y + Y.Q0 + (0 if race == 0 else Q.OUTER)
    rate = S.Y + Y.V0 + (0 if race == 0 else Q.OUTER)
    angle = s[S.Y + Y.TH + j]
    c = math.cos(angle)
    n = math.sin(angle)
    # of the ball's centre from the ring's: outwards and ahead; at angle 0 a ball orbits towards -y
    out = p[P.PITCH_RADIUS] + s[S.Y + Y.R + j] + n * s[ring + Q.Y] - c * s[ring + Q.Z]
    ahead = c * s[ring + Q.Y] + n * s[ring + Q.Z]
    outwards = s[S.Y + Y.VR + j] + n * s[rate + Q.Y] - c * s[rate + Q.Z]
    side = 1.0 if race == 1 else -1.0
    return angle + ahead / out - turned_by(s, race), side * (out - p[P.PITCH_RADIUS]), side * outwards


@kernel
def nearest_on_race(p, s, head):
    """Ball nearest to a defect of a race: number, place (m) along the track, depth (m) and sinking (m/s)."""
    race = int(p[head + DE.ON])
    there = p[head + DE.ANGLE] + turned_by(s, race)
    near = 0
    least = 1e30
    for j in range(int(p[P.BALLS])):
        away = abs(wrap(s[S.Y + Y.TH + j] - there))
        if away < least:
            near = j
            least = away
    angle, depth, sinking = on_ring(p, s, race, near)
    return near, p[head + DE.RADIUS + race] * wrap(angle - p[head + DE.ANGLE]), depth, sinking


@kernel
def nearest_on_ball(p, s, k):
    """Contact of its ball nearest to a defect: race, place (m) along the track, depth (m) and sinking (m/s).

    The contacts' directions are those of the last communication point. A contact whose track the defect
    misses is as far away as can be.
    """
    head = head_of(p, k)
    j = int(p[head + DE.OF_BALL])
    d = S.DEFECT_AXES + DE.VECTOR * k
    near = 0
    place = 1e30
    depth = 0.0
    sinking = 0.0
    for race in range(2):
        kept = S.CONTACTS + race * R.KEPT + j
        sine = s[kept + R.KEPT_SINA]
        cosine = s[kept + R.KEPT_COSA]
        radius = p[head + DE.RADIUS + race]
        facing = s[d] * sine + s[d + 1] * cosine
        aside = radius * abs(s[d] * cosine - s[d + 1] * sine)
        x = radius * math.atan2(-s[d + 2], facing)
        if table_of(p, head, race) != 0 and aside < p[head + DE.ACROSS + 2 * race + 1]:
            if abs(x) < abs(place):
                near = race
                place = x
                _, depth, sinking = on_ring(p, s, race, j)
    return near, place, depth, sinking


@kernel
def nearest(p, s, k):
    """Ball, or contact of the ball, nearest to defect ``k``: its number, place, depth (m), sinking (m/s)."""
    head = head_of(p, k)
    if p[head + DE.ON] == DE.BALL:
        return nearest_on_ball(p, s, k)
    return nearest_on_race(p, s, head)


@kernel
def watch_defects(p, s, h):
    """Note what the step ``h`` (s) that led to the state ``s`` of a bearing has seen of its defects."""
    for k in range(int(p[P.DEFECTS])):
        at = S.SEEN + k * DE.SEEN_SIZE
        near, place, depth, sinking = nearest(p, s, k)
        before = s[at + DE.PLACE]
        moved = place - before
        head = head_of(p, k)
        half = 0.5 * p[head + DE.LENGTH]
        # beyond it the same ball comes from the other side
        if s[at + DE.NEAR] == near + 1.0 and abs(moved) < 2.0 * p[head + DE.RADIUS + 1]:
            if (before < 0.0) != (place < 0.0):
                s[at + DE.PASSAGES] += 1.0
            edge = -half if moved > 0.0 else half
            if moved * (edge - before) > 0.0 and moved * (place - edge) >= 0.0:
                s[at + DE.ENTRY] = s[S.TIME] - h * (place - edge) / moved
                s[at + DE.ENTERED] = depth
                s[at + DE.DEEPEST] = depth
            deepest = max(s[at + DE.DEEPEST], depth)
            s[at + DE.DEEPEST] = deepest
            near_bottom = not (depth < deepest - _RISEN * (deepest - s[at + DE.ENTERED]))
            sunk = s[at + DE.SINKING]
            turned = sunk > 0.0 and not (sinking > 0.0)
            if turned and near_bottom and abs(place) <= half:
                s[at + DE.IMPACT] = s[S.TIME] + h * sinking / (sunk - sinking)
        s[at + DE.NEAR] = near + 1.0
        s[at + DE.PLACE] = place
        s[at + DE.SINKING] = sinking


@kernel
def observe_defects(p, s, z, to):
    """Fill the outputs of a bearing's local defects, from ``z[to]`` on."""
    for k in range(int(p[P.DEFECTS])):
        head = head_of(p, k)
        at = S.SEEN + k * DE.SEEN_SIZE
        near, place, _, _ = nearest(p, s, k)
        race = int(p[head + DE.ON])
        ball = near
        if race == DE.BALL:
            race = near
            ball = int(p[head + DE.OF_BALL])
        here = to + Z.PER_DEFECT * k
        z[here + Z.DEFECT_PASSAGES] = s[at + DE.PASSAGES]
        z[here + Z.DEFECT_LOAD] = 0.0
        table = table_of(p, head, race)
        if table != 0 and within(p, table, place):
            z[here + Z.DEFECT_LOAD] = s[S.CONTACTS + race * R.KEPT + R.KEPT_LOAD + ball]
        z[here + Z.DEFECT_TIME] = s[S.TIME] - s[at + DE.ENTRY] if s[at + DE.ENTRY] != 0.0 else 0.0
        z[here + Z.DEFECT_ENTRY] = s[at + DE.ENTRY]
        z[here + Z.DEFECT_IMPACT] = s[at + DE.IMPACT]
