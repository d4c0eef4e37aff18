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

#: How the engine forms the channels of the sound filters, with the number that stands in the sound block:
#: the multi-source paper's magnitudes, accelerations, normal velocities at the contact points.
ChannelForm = Literal["scalars", "vectors", "contacts"]
CHANNEL_FORMS: dict[ChannelForm, int] = {"scalars": 1, "vectors": 2, "contacts": 3}
SCALARS, VECTORS, CONTACTS = CHANNEL_FORMS.values()

RadiationModel = Literal["paper", "paper_vector", "paper_contacts", "compact", "bem", "table"]
RADIATION_MODELS: tuple[RadiationModel, ...] = get_args(RadiationModel)
