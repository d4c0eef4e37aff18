"""The choices that a scene makes and the engine reads from ``p``: one table each.

The scene takes its allowed values from the types, the engine its numbers, the description its texts.
"""

from typing import Literal, get_args

Fidelity = Literal["full", "rings", "response"]
FIDELITIES: tuple[Fidelity, ...] = get_args(Fidelity)
FULL, RINGS, RESPONSE = range(len(FIDELITIES))

#: Integrators of fidelity ``full`` with the numbers that FMUs give out, which never change; 1 was given to a
#: method that has left.
Method = Literal["esdirk4", "trbdf2", "rk4"]
METHODS: dict[Method, int] = {"esdirk4": 0, "trbdf2": 2, "rk4": 3}
ESDIRK4, TRBDF2, RK4 = METHODS.values()

TractionLaw = Literal["regularised", "eyring", "paper"]
TRACTION_LAWS: tuple[TractionLaw, ...] = get_args(TractionLaw)
REGULARISED, EYRING, PAPER = range(len(TRACTION_LAWS))

ViscosityLaw = Literal["vogel", "walther"]
VISCOSITY_LAWS: tuple[ViscosityLaw, ...] = get_args(ViscosityLaw)
VOGEL, WALTHER = range(len(VISCOSITY_LAWS))

#: How much oil the inlets of the contacts find: Houpert's force of 1987 alone, which is that of EHL; the same
#: with the change to rigid surfaces; flooded.
RollingLaw = Literal["houpert-1987-ehl", "starved", "flooded"]
ROLLING_LAWS: tuple[RollingLaw, ...] = get_args(RollingLaw)
EHL_ALONE, STARVED, FLOODED = range(len(ROLLING_LAWS))

RaceControl = Literal["shared", "outer", "inner"]
RACE_CONTROLS: tuple[RaceControl, ...] = get_args(RaceControl)
SHARED_CONTROL, OUTER_CONTROL, INNER_CONTROL = range(len(RACE_CONTROLS))

#: What carries a cage: lands on a ring, or spherical pockets that ride on the balls.
Guidance = Literal["inner", "outer", "balls"]
GUIDANCES: tuple[Guidance, ...] = get_args(Guidance)
INNER_GUIDED, OUTER_GUIDED, BALL_GUIDED = range(len(GUIDANCES))

#: How the engine forms the channels of the sound filters, with its number in the sound block:
#: the multi-source paper's magnitudes, accelerations, normal velocities at the contact points;
#: accelerations under accelerometers.
ChannelForm = Literal["scalars", "vectors", "contacts", "sensors"]
CHANNEL_FORMS: dict[ChannelForm, int] = {"scalars": 1, "vectors": 2, "contacts": 3, "sensors": 4}
SCALARS, VECTORS, CONTACTS, SENSORS = CHANNEL_FORMS.values()

RadiationModel = Literal["paper", "paper_vector", "paper_contacts", "compact", "bem", "table"]
RADIATION_MODELS: tuple[RadiationModel, ...] = get_args(RadiationModel)
