"""Milling in time, the equation with its delay: teeth, chips, forces; motion of a machine by its modes.

Nothing of `fmu_bearing.machining` is here: forces of single teeth, not of their mean.
"""

import math

import numpy as np


class Machine:
    """Motion across the axis: x' = diag(values) x + into F, moved = out x; exact for a force that is held."""

    def __init__(self, values, into, out, h):
        self.out = out
        self.whole, self.half = (self._over(values, into, part) for part in (h, 0.5 * h))
        self.x = np.zeros(len(values), dtype=complex)

    @staticmethod
    def _over(values, into, h):
        ahead, small = np.exp(values * h), np.abs(values * h) < 1e-9
        held = np.where(small, h, (ahead - 1.0) / np.where(small, 1.0, values))
        return ahead, held[:, None] * into

    def midway(self, force):
        """Where it will be after half a step, if the force stays."""
        ahead, held = self.half
        return (self.out @ (ahead * self.x + held @ force)).real

    def step(self, force):
        ahead, held = self.whole
        self.x = ahead * self.x + held @ force


def of_mode(stiffness, damping, frequency, direction=(1.0, 0.0)):
    """Poles, and what goes in and out, of one mode along a direction."""
    w = 2.0 * math.pi * frequency
    pole = w * (-damping + 1j * math.sqrt(1.0 - damping**2))
    values = np.array([pole, np.conj(pole)])
    along = np.array(direction)
    # k q'' / w^2 + ... = F: residues of 1/(m (s - p)(s - p*))
    gain = w**2 / stiffness / (pole - np.conj(pole))
    return values, np.array([[gain], [-gain]]) * along, np.vstack([np.ones(2) * part for part in along])


def growth(poles, depth, rpm, teeth, coefficient, ratio, entry, leave, turns=40, per_period=100):
    """Rate (1/s) by which a small disturbance grows in the last two thirds of so many revolutions.

    Axes u along the feed, v: a tooth at the angle p from v is at (sin p, cos p). Without feed: what is left
    is the vibration that cuts its own waves.
    """
    period = 60.0 / (teeth * abs(rpm))
    h = period / per_period
    machine = Machine(*poles, h)
    machine.x[:] = 1e-9
    past = np.zeros((per_period, 2))
    size = np.zeros(turns * teeth)
    force = np.zeros(2)
    ahead = 2.0 * math.pi / teeth / per_period
    for n in range(turns * teeth):
        for k in range(per_period):
            moved = machine.midway(force)  # forces of mid-step: no lag, which would feed the vibration
            since = moved - past[k]
            past[k] = moved
            force = np.zeros(2)
            for tooth in range(teeth):
                p = math.remainder((k + 0.5) * ahead + tooth * 2.0 * math.pi / teeth, 2.0 * math.pi)
                if not entry <= p <= leave:
                    continue
                s, c = math.sin(p), math.cos(p)
                chip = s * since[0] + c * since[1]
                tangential = coefficient * depth * chip
                force += tangential * np.array([-c - ratio * s, s - ratio * c])
            machine.step(force)
        size[n] = np.abs(past).max()
    third = len(size) // 3
    logs = np.log(np.maximum(size[third:], 1e-300))
    return float(np.polyfit(np.arange(len(logs)) * period, logs, 1)[0])
