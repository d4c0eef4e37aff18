"""The table of extreme cases. A fidelity or a method that arrives later joins ``COMPUTED`` and runs them all.

Each case: a scene, changes to it, inputs at the start, then legs (duration in s, new inputs, communication
step in s). Every fidelity and method finishes it but those in ``refused``. ``per_ms`` bounds the internal
steps, accepted and rejected, in any leg per simulated ms. It is about three times what ESDIRK4 needs, so that
a step control that rejects too often fails on any machine.
"""

from dataclasses import dataclass, field

from tests.extremes.bearings import PERFECT, SILENT

#: Fidelities and methods that the engine computes at present.
COMPUTED = (
    ("full", "esdirk4"),
    ("full", "trbdf2"),
    ("rings", "esdirk4"),
    ("response", "esdirk4"),
)
FULL = tuple(pair for pair in COMPUTED if pair[0] == "full")
#: Explicit steps are as short as 0.1 us: a few cases, in the heavy tests.
EXPLICIT = ("full", "rk4")
RINGS = ("rings", "esdirk4")
#: Their internal steps against ESDIRK4's: TR-BDF2 is of second order and needs up to five times as many.
WORK = {
    ("full", "esdirk4"): 1.0,
    ("full", "trbdf2"): 5.0,
    ("full", "rk4"): 300.0,  # 20 ns at standstill
    ("rings", "esdirk4"): 30.0,  # on a very stiff pedestal the outer ring's mode sets the step
    ("response", "esdirk4"): 1.0,
}
#: Differences between runs of the same case: TR-BDF2 damps the rings' modes where its steps are long.
SLACK = {"trbdf2": 3.0}

# What a refusal says.
UNSOLVED = "the equations could not be solved"
NO_START = "no quasi-static equilibrium was found"


@dataclass(frozen=True)
class Refusal:
    """How a case ends that a fidelity or method does not carry.

    Attributes
    ----------
    reason : str
        Pattern of what the refusal says.
    legs : int
        Legs that are computed before it.
    """

    reason: str
    legs: int = 0


# Where cases are hard for fidelity rings or explicit steps, speed, loads and temperatures were moved at
# random by 1e-12 to 1e-6 of themselves, a dozen times: no verdict changed, so rounding (1e-16), which differs
# between machines, turns none.

#: Fidelity rings balances each ball between both races: a ball that leaves the inner one has no place there.
#: The same for all balls from the start on. Rounding decides whether the start or the first leg says so.
ALL_LIFTED = Refusal(f"{NO_START}|{UNSOLVED}")
#: Sliding friction at rest, as stiff as load over mass of a ball: steps of 12 ns on the 7003C, of which the
#: 7,000 that a call of 100 us may take reach 81 us. The 7009C's balls, less loaded and heavier, allow 120 ns.
TOO_STIFF = Refusal(UNSOLVED)

DRY = {"fidelity.terms.land_film": False, "bearing.cage.pocket_damping_N_s_m": 0.0}
#: Oil that fills inlets and lands: in the cold it holds the cage by 20,000 times the mist's viscosity.
JET = {
    "lubricant.supply": "jet",
    "lubricant.rolling_law": None,
    "lubricant.replenishment_constant": None,
    "lubricant.land_viscosity_Pa_s": None,
}
#: Traction in oil that it heats, between bodies that conduct.
HEATED = {"fidelity.terms.thermal_traction": True} | {
    f"materials.{body}.{key}": value
    for body in ("inner_ring", "outer_ring", "balls")
    for key, value in (("conductivity_W_mK", 25.0), ("specific_heat_J_kgK", 500.0))
}
#: Surfaces that both run forwards through a contact slide by no more than twice their mean speed.
FORWARDS = 2.0


@dataclass(frozen=True)
class Case:
    """One extreme case."""

    name: str
    scene: str = "7003C-bare"
    changes: dict = field(default_factory=dict)
    start: dict = field(default_factory=dict)
    legs: tuple = ((5e-3, {}, 1e-4),)
    per_ms: float = 300.0
    per_ms_rings: float = 700.0  # the same for fidelity rings, whose steps follow the rings' modes
    refused: dict = field(default_factory=dict)  # fidelity and method: Refusal
    perfect: bool = False
    slip: float = FORWARDS  # bound on the mean sliding over entrainment at a race
    energy: float = 2e-4  # bound on the energy residual over the energy turned over

    @property
    def all_changes(self) -> dict:
        """Changes to the scene, sound left out."""
        return (PERFECT if self.perfect else SILENT) | self.changes


def _both(name, small=None, large=None, **more):
    """One case for either bearing; ``small``, ``large``: what refuses it on the 7003C, on the 7009C."""
    return [
        Case(f"{name}, 7003C", refused=small or {}, **more),
        Case(f"{name}, 7009C", scene="7009C-full-ceramic", refused=large or {}, **more),
    ]


CASES = [
    *_both("standstill", {EXPLICIT: TOO_STIFF}, start={"rpm": 0.0}),
    *_both("1 r/min", {EXPLICIT: TOO_STIFF}, start={"rpm": 1.0}),
    *_both("100 r/min", start={"rpm": 100.0}),
    # 650 N of centrifugal force on each of the 7009C's balls, 21 N of preload: some leave the inner race
    *_both("100000 r/min", start={"rpm": 1e5}, per_ms=1700.0),
    *_both("backwards", start={"rpm": -2e4}),
    *_both(
        "reversal in 5 ms",
        start={"rpm": 2e4},
        legs=((1e-3, {}, 1e-4), (5e-3, {"rpm": -2e4}, 5e-3), (3e-3, {}, 1e-4)),
        # balls that still spin as before against a ring that turns the other way: entrainment passes zero
        # while all of the surface speed slides. 2.9 on the 7009C, whose light preload lets its balls skid.
        slip=10.0,
    ),
    *_both(
        "10000 to 40000 r/min in 1 ms",
        start={"rpm": 1e4},
        legs=((1e-3, {}, 1e-4), (1e-3, {"rpm": 4e4}, 1e-3), (3e-3, {}, 1e-4)),
    ),
    Case(
        "0 to 100000 r/min in 1 ms",
        start={"rpm": 0.0},
        legs=((1e-3, {}, 1e-4), (1e-3, {"rpm": 1e5}, 1e-3), (2e-3, {}, 1e-4)),
        per_ms=1000.0,
    ),
    *_both("no preload at speed", start={"rpm": 2e4, "preload": 0.0}),
    # nothing rolls there, and loose balls slide by millimetres per second as the rings settle, over the
    # 0.1 mm/s by which entrainment is rounded: 23 at most
    *_both("no preload at standstill", start={"rpm": 0.0, "preload": 0.0}, slip=50.0),
    Case(
        "no preload at 100000 r/min",
        start={"rpm": 1e5, "preload": 0.0},
        per_ms=1800.0,
    ),
    Case(
        "preload taken away and given back",
        start={"rpm": 2e4},
        legs=((1e-3, {}, 1e-4), (2e-3, {"preload": 0.0}, 1e-4), (2e-3, {"preload": 500.0}, 1e-4)),
        per_ms=1000.0,  # balls come loose; rings begins again at rest
    ),
    *_both("preload 10 kN", start={"rpm": 2e4, "preload": 1e4}),
    *_both("radial 3 kN at the start", start={"rpm": 2e4, "radial_load.y": 3e3}, per_ms=700.0),
    *_both(
        "radial 3 kN from one step to the next",
        start={"rpm": 2e4},
        legs=((1e-3, {}, 1e-4), (3e-3, {"radial_load.z": -3e3}, 1e-4), (1e-3, {"radial_load.z": 0.0}, 1e-4)),
        per_ms=1800.0,
        per_ms_rings=3000.0,  # balls leave the races and come back
    ),
    *_both("soft pedestal", start={"rpm": 2e4, "pedestal_stiffness": 1e4}),
    *_both("rigid pedestal", start={"rpm": 2e4, "pedestal_stiffness": 1e12}, per_ms_rings=12e3),
    # balls that bounce undamped at 20 kHz and more: steps of 2 us resolve what they do to the rings
    *_both("no contact damping", changes={"bearing.contact_damping_us": 0.0}, per_ms=1700.0),
    *_both("contact damping 25 us", changes={"bearing.contact_damping_us": 25.0}),
    *_both("dry cage", changes=DRY),
    *_both("oil at -40 degC", start={"oil_temperature": 233.15}),
    *_both("oil at 199 degC", start={"oil_temperature": 472.15}),
    Case("oil at -40 degC, 100000 r/min", start={"rpm": 1e5, "oil_temperature": 233.15}),
    *_both("jet at 199 degC", changes=JET, start={"oil_temperature": 472.15}),
    *_both("jet at -40 degC", changes=JET, start={"oil_temperature": 233.15}),
    *_both("jet at -40 degC, standstill", changes=JET, start={"rpm": 0.0, "oil_temperature": 233.15}),
    *_both(
        "jet at -40 degC, 0 to 20000 r/min in 1 ms",
        changes=JET,
        start={"rpm": 0.0, "oil_temperature": 233.15},
        legs=((1e-3, {}, 1e-4), (1e-3, {"rpm": 2e4}, 1e-4), (2e-3, {}, 1e-4)),
        per_ms=1500.0,  # the film's viscosity falls by three decades from step to step
    ),
    Case("jet at -40 degC, 100000 r/min", changes=JET, start={"rpm": 1e5, "oil_temperature": 233.15}),
    *_both(
        "jet that cools by 120 K from one step to the next",
        changes=JET,
        start={"rpm": 2e4, "oil_temperature": 353.15},
        legs=((1e-3, {}, 1e-4), (2e-3, {"oil_temperature": 233.15}, 1e-4)),
    ),
    *_both("oil at -40 degC that friction heats", changes=HEATED, start={"oil_temperature": 233.15}),
    *_both("no preload, oil that friction heats", changes=HEATED, start={"rpm": 2e4, "preload": 0.0}),
    Case(
        "standstill, oil that friction heats",
        changes=HEATED,
        start={"rpm": 0.0},
        refused={EXPLICIT: TOO_STIFF},
    ),
    Case("rings 150 K apart, inner hot", start={"inner_ring_temperature": 443.15}),
    Case("rings 150 K apart, outer hot", start={"outer_ring_temperature": 443.15}),
]
#: Slow and reversing: where explicit steps are shortest.
SLOW = [case for case in CASES if case.name.startswith(("standstill", "1 r/min", "backwards", "reversal"))]
