"""Sets of bearings on bare arrays, as the engine steps them."""

import numpy as np

from fmu_bearing.compiled import call
from fmu_bearing.engine.constants import RPM
from fmu_bearing.engine.layout import SP, P, S, U, W, Y
from fmu_bearing.engine.status import OK
from fmu_bearing.interface.inputs import input_values
from fmu_bearing.prepare.model import pack
from fmu_bearing.prepare.spindle import one_of, pack_set


class SetRun:
    """A set without sound; ``shaft``: in the place of the scene's, ``parameters``: of every bearing."""

    def __init__(self, scene, rpm=None, shaft=None, **parameters):
        self.scene = scene
        bearings = []
        for k in range(len(scene.spindle.bearing)):
            p = pack(one_of(scene, k), np.empty(0))
            for name, value in parameters.items():
                p[getattr(P, name)] = value
            bearings.append(p)
        self.p = pack_set(scene, bearings, shaft)
        self.block = int(self.p[P.SET])
        self.u = input_values(scene)
        if rpm is not None:
            self.u[U.SPEED] = rpm * RPM
        self.s, self.w = np.zeros(S.size(self.p)), np.zeros(W.size(self.p))
        self.z = np.zeros(int(self.p[self.block + SP.SIZE_Z]))

    def init(self):
        assert self.try_init() == OK
        return self

    def try_init(self):
        return call("init", self.p, self.u, self.s, self.z, self.w, 0.0)

    def step(self, h):
        return call("step", self.p, self.u, self.s, self.z, self.w, h)

    def run(self, duration, h=1e-4):
        """Step for ``duration`` (s); rows of z after each step."""
        rows = []
        for _ in range(round(duration / h)):
            assert self.step(h) == OK
            rows.append(self.z.copy())
        return np.array(rows)

    @property
    def count(self):
        return len(self.scene.spindle.bearing)

    def row(self, b):
        """Numbers of a bearing in the set's block."""
        first = self.block + int(self.p[self.block + SP.AT_ROWS]) + b * SP.ROW
        return self.p[first : first + SP.ROW]

    def of(self, array, b, name):
        """Part of ``s``, ``w`` or ``z`` that belongs to a bearing."""
        row = self.row(b)
        first = int(row[getattr(SP, f"ROW_{name}")])
        return array[first : first + int(row[getattr(SP, f"ROW_{name}_SIZE")])]

    def state(self, b):
        return self.of(self.s, b, "S")

    def work(self, b):
        return self.of(self.w, b, "W")

    def y(self, b):
        return self.state(b)[S.Y : S.Y + Y.SIZE]

    @property
    def own(self):
        """The set's own state."""
        return self.s[int(self.p[self.block + SP.AT_S]) :]

    def vector(self, k):
        """Places (0), rates (1) or accelerations (2) of all coordinates, without spare lanes."""
        padded_size, n = (int(self.p[self.block + place]) for place in (SP.PADDED_SIZE, SP.COUNT))
        first = SP.S_HEAD + k * padded_size
        return self.own[first : first + n]

    def work_vector(self, k):
        """Vector of the set's own work space."""
        padded_size, n = (int(self.p[self.block + place]) for place in (SP.PADDED_SIZE, SP.COUNT))
        first = int(self.p[self.block + SP.AT_W]) + SP.W_HEAD + k * padded_size
        return self.w[first : first + n]

    def value(self, name, b=None):
        """An output of the set, or of what the shaft puts on a bearing."""
        first = int(self.p[self.block + SP.AT_Z])
        if b is None:
            return self.z[first + SP.OUTPUTS.index(name)]
        return self.z[first + SP.Z_FORCES + SP.Z_FORCE * b + SP.BEARING_OUTPUTS.index(name)]

    @property
    def heat(self):
        """Dissipated so far (J)."""
        lost = self.own[SP.HEAT] + self.own[SP.HEAT + 1]
        return lost + sum(self.state(b)[S.HEAT : S.HEAT + 3].sum() for b in range(self.count))

    @property
    def imbalance(self):
        """Work in less dissipation less change of stored energy (J)."""
        work = self.own[SP.WORK] + sum(self.state(b)[S.WORK] for b in range(self.count))
        return work - self.heat - (self.s[S.ENERGY_NOW] - self.s[S.ENERGY_START])
