"""Bearings on another model's shaft, on bare arrays."""

import numpy as np

from fmu_bearing.engine.layout import SP, U
from fmu_bearing.engine.status import OK
from fmu_bearing.scene import Scene
from tests.spindle.runs import SetRun


def as_port(given, **shaft):
    """Return the scene of a set with its shaft taken out; ``shaft``: keys besides."""
    data = given.model_dump(exclude_unset=True)
    data["spindle"] = {key: value for key, value in data["spindle"].items() if key != "load"}
    data["spindle"]["shaft"] = {"external": True, **shaft}
    return Scene.from_dict(data)


class PortRun(SetRun):
    """A set whose shaft is led."""

    def lead(self, place, rate):
        """Put place and rate (5 each) to the inputs."""
        self.u[U.PORT : U.PORT + SP.PLANE] = place
        self.u[U.PORT_RATE : U.PORT_RATE + SP.PLANE] = rate
        return self

    def go(self, place, rate, h):
        """Step to place and rate; force and moment on the rotor there."""
        assert self.lead(place, rate).step(h) == OK
        return self.force()

    def force(self, mean=False):
        """Force and moment on the rotor (5)."""
        first = int(self.p[self.block + SP.AT_Z]) + (SP.Z_PORT_MEAN if mean else SP.Z_PORT)
        return self.z[first : first + SP.PLANE].copy()


def forces(run):
    """Force and moment of the shaft on each bearing, shape (bearings, 5)."""
    return np.array([[run.value(name, b) for name in SP.BEARING_OUTPUTS] for b in range(run.count)])
