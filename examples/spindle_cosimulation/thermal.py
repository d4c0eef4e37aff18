"""Temperatures of bearings and their surroundings as an FMU: lumps and a constant ambient.

Lumps: inner ring, outer ring, balls, the oil between them, and the housing; with ``SHAFT`` also the shaft
under the inner ring. A set of bearings (``BEARINGS`` above 1) has the first four of each bearing, the
housing, and the shaft on which the inner rings sit; equal bearings share capacities and conductances. Heat
enters where the bearing FMU says it arises (its ``heat.*`` outputs), spreads over the conductances below, and
leaves over the shaft, the air flow and the cooled housing.

Implicit Euler in sub-steps of at most 1 ms: the fastest lump (the oil) takes a quarter second, so the error
of a transient stays below 1 %, and the energy balance holds to rounding at any step.

``native/thermal.c`` has the same equations in the same order of operations: results are equal to the last
bit.
"""

from math import ceil, isclose, isfinite

from pythonfmu import DefaultExperiment, Fmi2Causality, Fmi2Slave, Fmi2Variability, Real

# How many on one shaft. `build.py` writes the number of a set here, for an FMU carries no other module.
BEARINGS = 1
# Whether a single bearing has a shaft, too, whose temperature a fit depends on; a set always has.
SHAFT = False
MAX_SUB_STEP = 1e-3  # s

# 22 degC, the laboratory of the multi-source paper.
AMBIENT = 295.15  # K

# Heat capacities in J/K = mass x specific heat, for bearing 7003C.
CAPACITIES = {
    "inner_ring": 6.25,  # steel, 17/22.6 x 10 mm: 13.6 g x 460 J/(kg K)
    "outer_ring": 9.83,  # steel, 29.6/35 x 10 mm: 21.4 g x 460 J/(kg K)
    "balls": 1.28,  # 12 balls of silicon nitride, 4.5 mm: 1.83 g x 700 J/(kg K)
    "oil": 0.38,  # assumed 0.2 g on the surfaces x 1900 J/(kg K)
    "housing": 920.0,  # the scene's 2 kg, of steel: 460 J/(kg K)
}
SHAFT_CAPACITY = 193.0  # 0.42 kg of steel (the motor spindle of examples/spindle_set) x 460 J/(kg K)

# Conductances in W/K between lumps, and from lumps to the ambient.
CONDUCTANCES = {
    # Twelve contacts, spreading resistance of a spot with 0.15 mm radius in both bodies: 12 x 2 k a with
    # k = 32 W/(m K), the harmonic mean of steel (45) and silicon nitride (25).
    ("inner_ring", "balls"): 0.12,
    ("outer_ring", "balls"): 0.12,
    # Convection at 300 W/(m2 K), assumed: below the 700 of a flooded bearing (Harris' flat-plate formula at
    # 20,000 r/min), since oil-air lubrication wets only part. Areas of balls, inner and outer race.
    ("balls", "oil"): 0.23,
    ("inner_ring", "oil"): 0.21,
    ("outer_ring", "oil"): 0.28,
    # Seat of the outer ring, 11 cm2 at 4000 W/(m2 K): assumed, a sliding fit with a few micrometres.
    ("outer_ring", "housing"): 4.4,
    # Seat of the inner ring (2.7 W/K, a tight fit) and the shaft as a fin of 23 mm to both sides in moving
    # air of 100 W/(m2 K) (0.73 W/K), one after the other.
    ("inner_ring", "ambient"): 0.57,
    # Air flow of the paper's oil-air lubrication, 4.84 m3/h for two bearings, half of it here: 0.8 g/s.
    ("oil", "ambient"): 0.81,
    # Cooling water around the housing: assumed 200 cm2 at 1000 W/(m2 K).
    ("housing", "ambient"): 20.0,
}
# In a set the inner rings sit on the shaft, and that gives off the heat: seat as above; rotor in the air gap
# (57 cm2), nose and end (30 cm2) at 100 W/(m2 K).
SHAFT_CONDUCTANCES = {("inner_ring", "shaft"): 2.7, ("shaft", "ambient"): 0.87}
IN_BEARING = ("inner_ring", "outer_ring", "balls", "oil")
SOURCES = ("inner_ring", "outer_ring", "oil")

if SHAFT or BEARINGS > 1:
    CAPACITIES["shaft"] = SHAFT_CAPACITY
    del CONDUCTANCES["inner_ring", "ambient"]
    CONDUCTANCES |= SHAFT_CONDUCTANCES
if BEARINGS > 1:
    PREFIXES = [f"bearing[{number}]." for number in range(1, BEARINGS + 1)]
else:
    PREFIXES = [""]

#: Prefix and kind of each lump.
LUMPS = [(prefix, kind) for prefix in PREFIXES for kind in IN_BEARING]
LUMPS += [("", kind) for kind in CAPACITIES if kind not in IN_BEARING]


def _links():
    """Lumps that exchange heat, and the conductance: two numbers of ``LUMPS``, -1 for the ambient."""
    found = []
    for prefix in PREFIXES:
        for one, other in CONDUCTANCES:
            name = f"conductance.{one}_{other}"
            if one in IN_BEARING:
                beside = -1 if other == "ambient" else _place(prefix, other)
                found.append((_place(prefix, one), beside, name))
    outside = [pair for pair in CONDUCTANCES if pair[0] not in IN_BEARING]
    return found + [(_place("", one), -1, f"conductance.{one}_ambient") for one, _ in outside]


def _place(prefix, kind):
    return LUMPS.index((prefix if kind in IN_BEARING else "", kind))


LINKS = _links()


class SpindleThermal(Fmi2Slave):
    """Thermal network of one bearing in its spindle."""

    description = "Lumped thermal network of a spindle bearing"
    default_experiment = DefaultExperiment(start_time=0.0, stop_time=1.0, step_size=5e-4)
    temperatures = [f"{prefix}{kind}_temperature" for prefix, kind in LUMPS]
    #: Input of each lump's heat; "" where none enters.
    heats = [f"{prefix}heat.{kind}" if kind in SOURCES else "" for prefix, kind in LUMPS]
    capacities = [f"capacity.{kind}" for _, kind in LUMPS]

    units = {name: "W" for name in heats if name}
    units |= {name: "K" for name in temperatures}
    units |= {f"capacity.{kind}": "J/K" for kind in CAPACITIES}
    units |= {f"conductance.{one}_{other}": "W/K" for one, other in CONDUCTANCES}
    units |= {name: "K" for name in ("ambient_temperature", "initial_temperature")}
    units |= {name: "J" for name in ("energy.supplied", "energy.stored", "energy.given_off")}
    #: What each output depends on at the start: the energies on nothing.
    initial_dependencies = {name: ("initial_temperature",) for name in temperatures}
    initial_dependencies |= {f"energy.{name}": () for name in ("supplied", "stored", "given_off")}
    #: What the native build reads: temperature, capacity and heat of lumps; links.
    tables = {"LUMPS": list(zip(temperatures, capacities, heats, strict=True)), "LINKS": LINKS}
    #: Numbers the native build remembers: a step and the matrix for it.
    remembered = 1 + len(LUMPS) ** 2

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.modelName = "SpindleThermal"
        self.values = {name: 0.0 for name in self.units}
        for name, (prefix, kind) in zip(self.heats, LUMPS, strict=True):
            if name:
                self._register(name, "input", f"Heat put into {_words(kind, prefix)}")
        for name, (prefix, kind) in zip(self.temperatures, LUMPS, strict=True):
            self.values[name] = AMBIENT
            self._register(name, "output", f"Temperature of {_words(kind, prefix)}")
        self._register("energy.supplied", "output", "Heat put in since the start")
        self._register("energy.stored", "output", "Heat kept in the lumps since the start")
        self._register("energy.given_off", "output", "Heat given to the ambient since the start")
        self._register("ambient_temperature", "parameter", "Temperature of what surrounds it", AMBIENT)
        self._register("initial_temperature", "parameter", "Temperature of all lumps at the start", AMBIENT)
        for kind, value in CAPACITIES.items():
            self._register(f"capacity.{kind}", "parameter", f"Heat capacity of {_words(kind)}", value)
        for (one, other), value in CONDUCTANCES.items():
            text = f"Heat flow per kelvin between {_words(one)} and {_words(other)}"
            self._register(f"conductance.{one}_{other}", "parameter", text, value)
        self.solved_step = 0.0
        self.inverse = []

    def _register(self, name, causality, text, start=None):
        if start is not None:
            self.values[name] = start
        fixed = causality == "parameter"
        self.register_variable(
            Real(
                name,
                causality=Fmi2Causality[causality],
                variability=Fmi2Variability.fixed if fixed else Fmi2Variability.continuous,
                description=text,
                getter=lambda: self.values[name],
                setter=lambda value: self.values.__setitem__(name, value),
            ),
            nested=False,
        )

    def _get_fmu_state(self):
        """Return variables and the matrix in use: another one of nearly the same step has other last bits."""
        return super()._get_fmu_state() | {"solved_step": self.solved_step, "inverse": self.inverse}

    def exit_initialization_mode(self):
        """Put all lumps to the initial temperature."""
        for name in self.temperatures:
            self.values[name] = self.values["initial_temperature"]
        for name in ("supplied", "stored", "given_off"):
            self.values[f"energy.{name}"] = 0.0
        self.solved_step = 0.0

    def do_step(self, current_time, step_size):
        """Advance with the heats held; refused for a heat that is not finite or a capacity of zero."""
        heats = [self.values.get(name, 0.0) for name in self.heats]
        capacities = [self.values[name] for name in self.capacities]
        if not all(map(isfinite, heats)) or min(capacities) <= 0.0 or not step_size > 0.0:
            return False
        pieces = ceil(step_size / MAX_SUB_STEP * (1.0 - 1e-9))
        sub_step = step_size / pieces
        # Masters subtract times, so equal steps differ in the last digits: not worth a new matrix.
        if not isclose(sub_step, self.solved_step, rel_tol=1e-10):
            self.inverse = _inverse(self._matrix(sub_step, capacities))
            self.solved_step = sub_step
        for _ in range(pieces):
            self._advance(self.solved_step, heats, capacities)
        return True

    def _advance(self, h, heats, capacities):
        """One implicit Euler step for the rises above ambient, with its energy balance."""
        ambient = self.values["ambient_temperature"]
        before = [self.values[name] - ambient for name in self.temperatures]
        right = [q * h + c * rise for q, c, rise in zip(heats, capacities, before, strict=True)]
        after = [_total(a * b for a, b in zip(row, right, strict=True)) for row in self.inverse]
        for name, rise in zip(self.temperatures, after, strict=True):
            self.values[name] = ambient + rise
        for i, other, conductance in LINKS:
            if other < 0:
                self.values["energy.given_off"] += h * after[i] * self.values[conductance]
        self.values["energy.supplied"] += h * _total(heats)
        gained = [c * (new - old) for c, new, old in zip(capacities, after, before, strict=True)]
        self.values["energy.stored"] += _total(gained)

    def _matrix(self, h, capacities):
        """Capacities plus step times conductances: the matrix of an implicit Euler step."""
        matrix = [[0.0] * len(capacities) for _ in capacities]
        for i, capacity in enumerate(capacities):
            matrix[i][i] = capacity
        for i, j, conductance in LINKS:
            flow = h * self.values[conductance]
            matrix[i][i] += flow
            if j >= 0:
                matrix[j][j] += flow
                matrix[i][j] -= flow
                matrix[j][i] -= flow
        return matrix


def _total(values):
    """Sum by plain additions, as in C: the built-in one compensates rounding from Python 3.12 on."""
    total = 0.0
    for value in values:
        total += value
    return total


def _words(kind, prefix=""):
    where = f" of {prefix.rstrip('.')}" if prefix else ""
    return f"the {kind.replace('_', ' ')}{where}"


def _inverse(matrix):
    """Gauss-Jordan without pivoting: the matrix is symmetric and diagonally dominant."""
    size = len(matrix)
    rows = [list(row) + [float(i == j) for j in range(size)] for i, row in enumerate(matrix)]
    for i in range(size):
        pivot = rows[i][i]
        rows[i] = [value / pivot for value in rows[i]]
        for k in range(size):
            if k != i:
                factor = rows[k][i]
                rows[k] = [a - factor * b for a, b in zip(rows[k], rows[i], strict=True)]
    return [row[size:] for row in rows]
