"""Places in the flat arrays that every kernel shares: one module per array, named by a capital.

After ``from fmu_bearing.engine.layout import P, S, W`` a kernel line shows which array it touches:
``p[P.MU]``, ``s[S.TIME]``, ``w[W.LOSS + j]``.

=================  ====  ============================================================================
module             as    array
=================  ====  ============================================================================
``sizes``                lengths that several arrays share, and `Places`, which hands out places
``q``              Q     the bodies' 17 coordinates, in any array
``y``              Y     positions and velocities of the mechanics: head of ``s``, and each stage
``f``              F     right-hand side: accelerations, power, heat, torque
``c``              C     conditions held over a communication step
``u``              U     inputs
``z``              Z     outputs
``spindle``        SP    a set of bearings on one shaft: its own in ``p``, ``u``, ``s``, ``z``, ``w``
``sound_filters``  SD    sound blocks: parameters ``ps``, state ``ss``, work ``ws``
``sound_lines``    SL    of a sound block of lines (fidelity response): more of ``ss`` and ``ws``
``motion``         MO    one motion sample for the sound kernels
``flexure``        FL    bending rings: their rows and numbers in ``w``, what ``s`` keeps of them
``p``              P     parameters: written once by ``prepare``, read only in the engine
``defect``         DE    a local defect in ``p``: its head and the table of its height
``jacobian``       J     blocks of the Jacobian
``factors``        A     factors of the Newton matrix
``history``        H     what a march of fidelity rings keeps of its coordinates
``condensed``      L     what fidelities rings and response keep in ``s``
``lines``          LN    scratch of fidelity response in ``s`` while it renews its lines
``drift``          DR    what fidelity response keeps of a drift of its inputs in ``s``
``s``              S     state: all that a later step needs, and nothing else
``equilibrium``    EQ    result of the quasi-static kernel
``statics``        ST    work space of the quasi-static kernels
``pattern``        PT    work space of the steady state of unequal balls
``pose``           X     where a ball is in a body's frame: rows of ``w``
``race``           R     contact of the balls with one race: rows of ``w``
``contact``        K     derivatives of a contact by motion: scratch of the Jacobian in ``w``
``w``              W     work space: scratch, no value survives a call; its ledger of overlays
``trial``          T     work space of fidelities rings and response
``tableau``        TAB   coefficients of one Runge-Kutta method
=================  ====  ============================================================================

All arrays are one-dimensional, of float64, in SI units. Per-ball quantities are structures of arrays: the
*row* of a quantity is the place of ball 0, ball j is ``j`` places on, the next row ``STRIDE`` places on;
one loop over balls is then one vector loop. Places are computed from sizes, never counted by hand.
"""

from fmu_bearing.engine.layout import (
    c as C,
    condensed as L,
    contact as K,
    defect as DE,
    drift as DR,
    equilibrium as EQ,
    f as F,
    factors as A,
    flexure as FL,
    history as H,
    jacobian as J,
    lines as LN,
    motion as MO,
    p as P,
    pattern as PT,
    pose as X,
    q as Q,
    race as R,
    s as S,
    sound_filters as SD,
    sound_lines as SL,
    spindle as SP,
    statics as ST,
    tableau as TAB,
    trial as T,
    u as U,
    w as W,
    y as Y,
    z as Z,
)
from fmu_bearing.engine.layout.sizes import FOUR, MAX_BALLS, MAX_DEFECTS, MAX_MODES, STAGES, STRIDE

__all__ = [
    "A", "C", "DE", "DR", "EQ", "F", "FL", "H", "J", "K", "L", "LN", "MO", "P", "PT", "Q", "R", "S", "SD",
    "SL", "SP", "ST", "T", "TAB", "U", "W", "X", "Y", "Z", "FOUR", "MAX_BALLS", "MAX_DEFECTS", "MAX_MODES",
    "STAGES", "STRIDE",
]  # fmt: skip
