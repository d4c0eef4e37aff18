"""What must hold at every instant of every run, however extreme."""

import numpy as np

from fmu_bearing.engine.choices import RESPONSE
from fmu_bearing.engine.layout import P, S, Z
from fmu_bearing.instance import Instance
from tests.extremes.bearings import RINGS, Trace

FASTEST_RING = 100.0  # m/s: far beyond what any load within the inputs' ranges does in milliseconds
_HEATS = [f"heat.{part}" for part in ("inner_ring", "outer_ring", "oil")]


def finite(instance: Instance) -> None:
    """No output and no number of the state is NaN or infinite."""
    assert np.isfinite(instance.z).all()
    assert np.isfinite(instance.s).all()


def plausible(instance: Instance, trace: Trace, slip: float, fastest: float = FASTEST_RING) -> None:
    """Bounds that mechanics puts on the outputs; ``slip``: on the mean sliding over entrainment at a race."""
    rows = np.array(trace.rows)
    assert np.isfinite(rows).all()
    assert np.abs(trace.columns(RINGS)).max() <= fastest
    for side in ("inner", "outer"):
        mean, most = trace.column(f"contact.{side}.load_mean"), trace.column(f"contact.{side}.load_max")
        # the mean is a sum of up to 32 roundings
        assert (mean >= 0.0).all() and (most >= mean * (1.0 - 1e-12)).all()
        pressure = trace.column(f"contact.{side}.pressure_max")
        # a contact that opens fast may be pressed together still and carry nothing: damping does not pull
        assert (pressure >= 0.0).all() and (pressure[most > 0.0] > 0.0).all()
        # contacts of response never open: without preload balls are pressed behind their grooves, as it warns
        most_angle = np.pi if instance.p[P.FIDELITY] == RESPONSE else np.pi / 2
        assert np.abs(trace.column(f"contact.{side}.angle_mean")).max() <= most_angle
        slips = trace.column(f"contact.{side}.slip")
        assert (slips >= 0.0).all() and slips.max() <= slip
    assert (trace.column("film.lambda_min") >= 0.0).all()
    assert (trace.columns(_HEATS) >= -HEAT_SLACK * (1.0 + np.abs(trace.columns(_HEATS)).max())).all()
    assert (trace.column("stiffness.axial") >= 0.0).all() and (trace.column("stiffness.radial") >= 0.0).all()
    balls = np.abs(rows[:, Z.BALLS : Z.BALLS + 3 * instance.model.n_balls]).max()
    surface = np.abs(instance.get("shaft_speed")) * instance.p[P.PITCH_RADIUS]
    assert balls <= fastest + 2.0 * surface


#: Friction never gives power; what is left is the half-Sommerfeld film's rounding of the wedge over 1 rad/s.
HEAT_SLACK = 1e-6


def balanced(instance: Instance, share: float) -> None:
    """Work in less dissipation less stored energy: within ``share`` of the energy that was turned over."""
    s = instance.s
    lost = s[S.HEAT : S.HEAT + 3].sum()
    stored = s[S.ENERGY_NOW] - s[S.ENERGY_START]
    assert abs(s[S.WORK] - lost - stored) <= share * (lost + abs(s[S.WORK]) + abs(stored)) + ENERGY_FLOOR


#: J: a thousandth of the 3 mJ that 24 contacts under 115 N store; standstill dissipates less than that.
ENERGY_FLOOR = 3e-6
