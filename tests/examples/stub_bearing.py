"""A stand-in for the bearing FMU: its interface, and a torque that follows simple laws."""

from math import pi, sin

from pythonfmu import Fmi2Causality, Fmi2Slave, Fmi2Variability, Real

INERTIA = 2.5e-5
MICROPHONES = {"mic[1]": (0.0, 0.105, 0.0), "mic[2]": (0.0, 0.15, 0.0)}


class StubBearing(Fmi2Slave):
    inputs = {
        "shaft_speed": ("rad/s", 0.0),
        "preload": ("N", 100.0),
        "oil_temperature": ("K", 293.15),
        "inner_ring_temperature": ("K", 293.15),
        "outer_ring_temperature": ("K", 293.15),
    }
    parameters = {"lubricant.viscosity_ref": ("Pa.s", 0.03), "sound.metering_start": ("s", 0.0)}
    outputs = {
        "friction_torque": "N.m",
        "heat.inner_ring": "W",
        "heat.outer_ring": "W",
        "heat.oil": "W",
        "contact.inner.angle_mean": "rad",
        "contact.outer.angle_mean": "rad",
    }
    for prefix in MICROPHONES:
        outputs[f"{prefix}.pressure"] = "Pa"
        for name in ("spl", "spl_a", "leq", "leq_a"):
            outputs[f"{prefix}.{name}"] = "dB"
    places = {f"{m}.position.{a}": MICROPHONES[m]["xyz".index(a)] for m in MICROPHONES for a in "xyz"}
    constants = {"rotor.inertia": INERTIA, **places}
    units = {name: unit for name, (unit, _) in {**inputs, **parameters}.items()}
    units |= outputs | {name: "m" for name in places} | {"rotor.inertia": "kg.m2"}

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.modelName = "StubBearing"
        starts = {name: start for name, (_, start) in {**self.inputs, **self.parameters}.items()}
        self.values = dict.fromkeys(self.outputs, 0.0) | starts | self.constants
        for name in self.inputs:
            self._register(name, Fmi2Causality.input, Fmi2Variability.continuous)
        for name in self.parameters:
            self._register(name, Fmi2Causality.parameter, Fmi2Variability.fixed)
        for name in self.outputs:
            self._register(name, Fmi2Causality.output, Fmi2Variability.continuous)
        for name in self.constants:
            self._register(name, Fmi2Causality.local, Fmi2Variability.constant)

    def _register(self, name, causality, variability):
        fixed = variability == Fmi2Variability.constant
        self.register_variable(
            Real(
                name,
                causality=causality,
                variability=variability,
                getter=lambda: self.values[name],
                setter=None if fixed else (lambda value: self.values.__setitem__(name, value)),
            ),
            nested=False,
        )

    def exit_initialization_mode(self):
        self._outputs(0.0)

    def do_step(self, current_time, step_size):
        if abs(self.values["shaft_speed"]) > 10472.0:
            self.log("shaft_speed is out of range")
            return False
        self._outputs(current_time + step_size)
        return True

    def _outputs(self, time):
        v = self.values
        speed = v["shaft_speed"]
        thin = (293.15 / v["oil_temperature"]) ** 4
        torque = 1e-5 * v["preload"] + 1.5e-4 * v["lubricant.viscosity_ref"] * thin * speed
        v["friction_torque"] = torque
        for name, share in (("heat.inner_ring", 0.3), ("heat.outer_ring", 0.3), ("heat.oil", 0.4)):
            v[name] = share * torque * speed
        v["contact.inner.angle_mean"], v["contact.outer.angle_mean"] = 0.36, 0.24
        for k, prefix in enumerate(MICROPHONES):
            v[f"{prefix}.pressure"] = (0.1 - 0.03 * k) * sin(2.0 * pi * 1000.0 * time)
            for name in ("spl", "spl_a", "leq", "leq_a"):
                v[f"{prefix}.{name}"] = 71.0 - 3.0 * k
