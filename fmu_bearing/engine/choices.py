"""The choices that a scene makes and the engine reads from ``p``: one table each.

The scene takes its allowed values from the types, the engine its numbers, the description its texts.
"""

from typing import Literal, get_args

Fidelity = Literal["full", "rings", "response"]
FIDELITIES: tuple[Fidelity, ...] = get_args(Fidelity)
FULL, RINGS, RESPONSE = range(len(FIDELITIES))

Method = Literal["esdirk4", "fast", "trbdf2", "rk4"]
METHODS: tuple[Method, ...] = get_args(Method)
ESDIRK4, FAST, TRBDF2, RK4 = range(len(METHODS))

TractionLaw = Literal["regularised", "eyring", "paper"]
TRACTION_LAWS: tuple[TractionLaw, ...] = get_args(TractionLaw)
REGULARISED, EYRING, PAPER = range(len(TRACTION_LAWS))

ViscosityLaw = Literal["vogel", "walther"]
VISCOSITY_LAWS: tuple[ViscosityLaw, ...] = get_args(ViscosityLaw)
VOGEL, WALTHER = range(len(VISCOSITY_LAWS))

RaceControl = Literal["shared", "outer", "inner"]
RACE_CONTROLS: tuple[RaceControl, ...] = get_args(RaceControl)
SHARED_CONTROL, OUTER_CONTROL, INNER_CONTROL = range(len(RACE_CONTROLS))
