"""The table of extreme cases. A level or a method that arrives later joins ``COMPUTED`` and runs them all.

Each case: a scene, changes to it, inputs at the start, then legs (duration in s, new inputs, communication
step in s). ``per_ms`` bounds the internal steps, accepted and rejected, in any leg per simulated ms: about
three times what ESDIRK4 needs, so that a policy that begins to thrash is seen, on any machine.
"""

from dataclasses import dataclass, field

from tests.extremes.bearings import PERFECT, SILENT

#: Levels and methods that the engine computes at present.
COMPUTED = (
    ("full", "esdirk4"),
    ("full", "fast"),
    ("full", "trbdf2"),
    ("rings", "esdirk4"),
    ("response", "esdirk4"),
)
FULL = tuple(pair for pair in COMPUTED if pair[0] == "full")
#: Explicit steps are as short as 0.1 us: a few cases, in the heavy tests.
EXPLICIT = ("full", "rk4")
#: Their internal steps against ESDIRK4's: TR-BDF2 is of second order and needs up to five times as many.
WORK = {
    ("full", "esdirk4"): 1.0,
    ("full", "fast"): 1.5,  # one evaluation each: steps of 4 us where ESDIRK4 would take 20
    ("full", "trbdf2"): 5.0,
    ("full", "rk4"): 300.0,  # 20 ns at standstill
    ("rings", "esdirk4"): 30.0,  # on a very stiff pedestal the outer ring's mode sets the step
    ("response", "esdirk4"): 1.0,
}
#: Differences between runs of the same case: TR-BDF2 damps the rings' modes where its steps are long.
SLACK = {"trbdf2": 3.0}

DRY = {"fidelity.terms.land_film": False, "bearing.cage.pocket_damping_N_s_m": 0.0}


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
    refusing: tuple = ()  # levels that may refuse the case: they have no equations for open contacts
    perfect: bool = False
    energy: float = 1e-3  # bound on the energy residual over the energy turned over

    @property
    def all_changes(self) -> dict:
        """Changes to the scene, sound left out."""
        return (PERFECT if self.perfect else SILENT) | self.changes


def _both(name, **more):
    """One case for either bearing."""
    return [
        Case(f"{name}, 7003C", **more),
        Case(f"{name}, 7009C", scene="7009C-full-ceramic", **more),
    ]


CASES = [
    *_both("standstill", start={"rpm": 0.0}),
    *_both("1 r/min", start={"rpm": 1.0}),
    *_both("100 r/min", start={"rpm": 100.0}),
    *_both("100000 r/min", start={"rpm": 1e5}, per_ms=500.0, refusing=("rings",)),
    *_both("backwards", start={"rpm": -2e4}),
    *_both(
        "reversal in 5 ms",
        start={"rpm": 2e4},
        legs=((1e-3, {}, 1e-4), (5e-3, {"rpm": -2e4}, 5e-3), (3e-3, {}, 1e-4)),
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
    ),
    *_both("no preload at speed", start={"rpm": 2e4, "preload": 0.0}, refusing=("rings",)),
    *_both("no preload at standstill", start={"rpm": 0.0, "preload": 0.0}, refusing=("rings",)),
    Case("no preload at 100000 r/min", start={"rpm": 1e5, "preload": 0.0}, per_ms=600.0, refusing=("rings",)),
    Case(
        "preload taken away and given back",
        start={"rpm": 2e4},
        legs=((1e-3, {}, 1e-4), (2e-3, {"preload": 0.0}, 1e-4), (2e-3, {"preload": 500.0}, 1e-4)),
        per_ms=1000.0,
        refusing=("rings",),
    ),
    *_both("preload 10 kN", start={"rpm": 2e4, "preload": 1e4}),
    *_both("radial 3 kN at the start", start={"rpm": 2e4, "radial_load.y": 3e3}, per_ms=700.0),
    *_both(
        "radial 3 kN from one step to the next",
        start={"rpm": 2e4},
        legs=((1e-3, {}, 1e-4), (3e-3, {"radial_load.z": -3e3}, 1e-4), (1e-3, {"radial_load.z": 0.0}, 1e-4)),
        per_ms=1800.0,
        per_ms_rings=3000.0,  # balls leave the races and come back
        refusing=("rings",),
    ),
    *_both("soft pedestal", start={"rpm": 2e4, "pedestal_stiffness": 1e4}, refusing=("rings",)),
    *_both("rigid pedestal", start={"rpm": 2e4, "pedestal_stiffness": 1e12}, per_ms_rings=12e3),
    *_both("no contact damping", changes={"bearing.contact_damping_us": 0.0}),
    *_both("contact damping 25 us", changes={"bearing.contact_damping_us": 25.0}),
    *_both("dry cage", changes=DRY),
    *_both("oil at -40 degC", start={"oil_temperature": 233.15}),
    *_both("oil at 199 degC", start={"oil_temperature": 472.15}),
    Case("oil at -40 degC, 100000 r/min", start={"rpm": 1e5, "oil_temperature": 233.15}),
    Case("rings 150 K apart, inner hot", start={"inner_ring_temperature": 443.15}),
    Case("rings 150 K apart, outer hot", start={"outer_ring_temperature": 443.15}),
]
