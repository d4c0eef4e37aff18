"""THE table of variables: name, unit, causality, range, sentence, place in the engine's flat arrays.

Everything people meet by name comes from here: the FMU's XML and value references, the library's ``get``
and ``set``, the documentation's table. Names are a contract: harnesses depend on them.
"""

from dataclasses import dataclass, replace
from typing import Any

from fmu_bearing.engine import layout as at
from fmu_bearing.scene import Scene, si


@dataclass(frozen=True)
class Variable:
    """One variable of the model.

    ``array`` names the engine's flat array (``u``, ``z`` or ``p``; empty for a constant) and ``index`` the
    place there. ``value`` is that of a constant. Ranges and starts are in SI units.
    """

    name: str
    causality: str
    variability: str
    description: str
    type: str = "Real"
    unit: str = ""
    display_unit: str = ""
    quantity: str = ""
    min: float | None = None
    max: float | None = None
    nominal: float | None = None
    start: float | None = None
    array: str = ""
    index: int = 0
    value: float | None = None


RADIATORS = {"none": 0, "bare": 1, "housing": 2}
_AXES = (("x", "along the axis"), ("y", "horizontal"), ("z", "upwards"))
_SPEED_LIMIT = 10472.0  # rad/s, 100,000 r/min

# What a variable has unless it says otherwise, by unit: quantity, min, max, nominal. The bounds of what is
# read lie beyond anything a bearing does; they tell a tool where a value has lost its meaning.
_USUAL = {
    "m": ("Length", -1e3, 1e3, 1e-6),
    "m/s": ("Velocity", -1e4, 1e4, 1e-2),
    "N": ("Force", 0.0, 1e7, 100.0),
    "N.m": ("Torque", -1e5, 1e5, 1e-2),
    "N/m": ("TranslationalSpringConstant", 0.0, 1e13, 1e8),
    "W": ("Power", -1e8, 1e8, 10.0),
    "Pa": ("Pressure", -1e5, 1e5, 1e-2),
    "Pa.s": ("DynamicViscosity", 0.0, 10.0, 1e-2),
    "rad": ("Angle", -3.2, 3.2, 0.3),
    "dB": ("Level", -200.0, 300.0, 60.0),
    "kg.m2": ("MomentOfInertia", 0.0, 1e6, 1e-5),
    "s": ("Time", 0.0, 1e4, 1e-3),
    "": ("Ratio", -1e9, 1e9, 1.0),
}


def variables(scene: Scene, rotor_inertia: float) -> tuple[Variable, ...]:
    """All variables of a scene, in the order of their value references.

    ``rotor_inertia`` is the polar inertia (kg m2) of inner ring and rotor, for the variable of that name.
    What the scene leaves out (cage, sound, imperfections) has no variable.
    """
    table = [*_inputs(scene), *_outputs(scene), *_locals(scene, rotor_inertia), *_parameters(scene)]
    names = [variable.name for variable in table]
    assert len(set(names)) == len(names), "a variable name stands twice"
    return tuple(table)


def _inputs(scene: Scene) -> list[Variable]:
    mounting, start = si(scene.mounting), si(scene.operation)

    def make(
        name: str, description: str, unit: str, low: float, high: float, value: float, **more: Any
    ) -> Variable:
        return Variable(
            name,
            "input",
            "continuous",
            description,
            unit=unit,
            min=low,
            max=high,
            start=value,
            array="u",
            index=at.INPUTS.index(name),
            **more,
        )

    kelvin = {"display_unit": "degC", "quantity": "ThermodynamicTemperature", "nominal": 300.0}
    force = {"quantity": "Force", "nominal": 100.0}
    return [
        make(
            "shaft_speed",
            "Rotational speed of the shaft, right-handed about +X",
            "rad/s",
            -_SPEED_LIMIT,
            _SPEED_LIMIT,
            start.speed,
            display_unit="r/min",
            quantity="AngularVelocity",
            nominal=1000.0,
        ),
        make(
            "preload",
            "Axial force that pushes the inner ring towards +X",
            "N",
            0.0,
            1e4,
            mounting.preload,
            **force,
        ),
        make(
            "pedestal_stiffness",
            "Radial stiffness under the outer ring; the other directions keep their ratio to it",
            "N/m",
            1e4,
            1e12,
            mounting.pedestal_stiffness,
            quantity="TranslationalSpringConstant",
            nominal=1e8,
        ),
        make(
            "radial_load.y",
            "Horizontal load on the inner ring",
            "N",
            -3e3,
            3e3,
            mounting.radial_load_y,
            **force,
        ),
        make(
            "radial_load.z", "Upward load on the inner ring", "N", -3e3, 3e3, mounting.radial_load_z, **force
        ),
        make(
            "oil_temperature",
            "Temperature that sets the oil's viscosity",
            "K",
            233.0,
            473.0,
            start.oil_temperature,
            **kelvin,
        ),
        make(
            "inner_ring_temperature",
            "Temperature that expands the inner ring and, by half, the balls",
            "K",
            233.0,
            473.0,
            start.inner_ring_temperature,
            **kelvin,
        ),
        make(
            "outer_ring_temperature",
            "Temperature that expands the outer ring and, by half, the balls",
            "K",
            233.0,
            473.0,
            start.outer_ring_temperature,
            **kelvin,
        ),
    ]


def _usual(unit: str, more: dict[str, Any]) -> dict[str, Any]:
    """Keywords of a variable, completed by what is usual for its unit."""
    return {**dict(zip(("quantity", "min", "max", "nominal"), _USUAL[unit], strict=True)), **more}


def _read(
    name: str, causality: str, description: str, unit: str = "", index: int | None = None, **more: Any
) -> Variable:
    """Output or local variable at its place in ``z``."""
    place = at.BEARING_OUTPUTS.index(name) if index is None else index
    return Variable(
        name, causality, "continuous", description, unit=unit, array="z", index=place, **_usual(unit, more)
    )


def _vector(
    body: str, motion: str, causality: str, words: str, unit: str, first: int | None, **more: Any
) -> list[Variable]:
    return [
        _read(
            f"{body}.{motion}.{axis}",
            causality,
            f"{words} {direction}",
            unit,
            None if first is None else first + k,
            **more,
        )
        for k, (axis, direction) in enumerate(_AXES)
    ]


def _outputs(scene: Scene) -> list[Variable]:
    speed = {"display_unit": "mm/s"}
    table = _vector(
        "inner_ring", "velocity", "output", "Velocity of the inner ring's centre", "m/s", None, **speed
    )
    table += _vector(
        "outer_ring", "velocity", "output", "Velocity of the outer ring's centre", "m/s", None, **speed
    )
    if scene.bearing.cage is not None:
        table += _vector("cage", "velocity", "output", "Velocity of the cage's centre", "m/s", None, **speed)
        table.append(_read("cage.speed_ratio", "output", "Speed of the cage over the shaft's", nominal=0.4))
    orbit = {"nominal": 10.0}
    for j in range(scene.bearing.ball_count):
        words = f"Velocity of ball {j + 1}, orbit included,"
        table += _vector(f"ball[{j + 1}]", "velocity", "output", words, "m/s", at.Z_BALLS + 3 * j, **orbit)
    first = at.z_mics(scene.bearing.ball_count)
    for k, (name, _) in enumerate(scene.microphones):
        for i, (label, words) in enumerate(_MIC_WORDS[:5]):
            pascal = label == "pressure"
            table.append(
                _read(
                    f"mic[{k + 1}].{label}",
                    "output",
                    words.format(name),
                    "Pa" if pascal else "dB",
                    first + len(at.MIC_OUTPUTS) * k + i,
                )
            )
    return [
        *table,
        _read(
            "friction_torque",
            "output",
            "Torque taken from the shaft, without inertia: that belongs to the drive",
            "N.m",
        ),
        _read(
            "heat.inner_ring", "output", "Heat to the inner ring, mean over the last communication step", "W"
        ),
        _read(
            "heat.outer_ring", "output", "Heat to the outer ring, mean over the last communication step", "W"
        ),
        _read("heat.oil", "output", "Heat to oil and balls, mean over the last communication step", "W"),
    ]


_MIC_WORDS = (
    ("pressure", "Sound pressure at microphone {}"),
    ("spl", "Time-weighted sound pressure level at microphone {}"),
    ("spl_a", "Time- and A-weighted sound level at microphone {}"),
    ("leq", "Equivalent level since metering began at microphone {}"),
    ("leq_a", "A-weighted equivalent level since metering began at microphone {}"),
    ("spl_inner_ring", "Time-weighted partial level of the inner ring at microphone {}"),
    (
        "spl_outer_ring",
        "Time-weighted partial level of the outer ring and what moves with it at microphone {}",
    ),
    ("spl_cage", "Time-weighted partial level of the cage at microphone {}"),
    ("spl_balls", "Time-weighted partial level of the balls at microphone {}"),
)


def _locals(scene: Scene, rotor_inertia: float) -> list[Variable]:
    small = {"display_unit": "um"}
    table = _vector(
        "inner_ring", "displacement", "local", "Displacement of the inner ring's centre", "m", None, **small
    )
    table += _vector(
        "outer_ring", "displacement", "local", "Displacement of the outer ring's centre", "m", None, **small
    )
    for side in ("inner", "outer"):
        at_race = f"at the {side} race"
        table += [
            _read(f"contact.{side}.load_mean", "local", f"Mean load of a ball {at_race}", "N"),
            _read(f"contact.{side}.load_max", "local", f"Largest load of a ball {at_race}", "N"),
            _read(
                f"contact.{side}.angle_mean",
                "local",
                f"Mean contact angle {at_race}",
                "rad",
                display_unit="deg",
            ),
            _read(
                f"contact.{side}.pressure_max",
                "local",
                f"Largest contact pressure {at_race}",
                "Pa",
                display_unit="GPa",
                min=0.0,
                max=1e12,
                nominal=1e9,
            ),
        ]
    table += [
        _read("film.lambda_min", "local", "Thinnest oil film over the composite roughness", nominal=1.0),
        _read("stiffness.axial", "local", "Axial stiffness between the rings at the present contacts", "N/m"),
        _read(
            "stiffness.radial", "local", "Radial stiffness between the rings at the present contacts", "N/m"
        ),
        _read(
            "energy.residual",
            "local",
            "Work in less dissipation less change of stored energy, over dissipation",
        ),
    ]
    for name, words in (
        ("solver.steps", "Internal steps so far"),
        ("solver.rejected", "Internal steps refused so far"),
    ):
        count = _read(name, "local", words, quantity="", min=0, max=2**31 - 1, nominal=None)
        table.append(replace(count, type="Integer", variability="discrete"))
    table.append(
        Variable(
            "rotor.inertia",
            "local",
            "constant",
            "Polar inertia of inner ring and rotor, which the drive owns",
            unit="kg.m2",
            value=rotor_inertia,
            **_usual("kg.m2", {}),
        )
    )
    first = at.z_mics(scene.bearing.ball_count)
    for k, (name, _) in enumerate(scene.microphones):
        for i, (label, words) in enumerate(_MIC_WORDS):
            if i >= 5 and not (label == "spl_cage" and scene.bearing.cage is None):
                place = first + len(at.MIC_OUTPUTS) * k + i
                table.append(_read(f"mic[{k + 1}].{label}", "local", words.format(name), "dB", place))
    return table


def _parameters(scene: Scene) -> list[Variable]:
    fidelity = si(scene.fidelity)

    def tunable(
        name: str, index: int, description: str, value: float, low: float, high: float, unit: str = ""
    ) -> Variable:
        return Variable(
            name,
            "parameter",
            "fixed",
            description,
            unit=unit,
            start=value,
            array="p",
            index=index,
            **_usual(unit, {"min": low, "max": high, "nominal": value or 1.0}),
        )

    def constant(name: str, description: str, value: float, unit: str = "", kind: str = "Real") -> Variable:
        more: dict[str, Any] = {} if kind == "Integer" else _usual(unit, {"nominal": 0.1})
        return Variable(name, "local", "constant", description, type=kind, unit=unit, value=value, **more)

    table = [
        replace(
            tunable("level", at.P_LEVEL, "Level of the dynamics: 0 is full", 0, 0, 0),
            type="Integer",
            quantity="",
            nominal=None,
        ),
        tunable(
            "tolerance", at.P_TOLERANCE, "Relative error of ring velocities", fidelity.tolerance, 1e-6, 0.1
        ),
        tunable(
            "max_internal_step",
            at.P_MAX_STEP,
            "Largest internal step",
            fidelity.max_internal_step,
            1e-7,
            1e-4,
            "s",
        ),
        tunable(
            "lubricant.viscosity_ref",
            at.P_VISCOSITY,
            "Dynamic viscosity of the oil at 20 degC",
            si(scene.lubricant).viscosity,
            1e-3,
            2.0,
            "Pa.s",
        ),
    ]
    if scene.imperfections is not None:
        table += [
            tunable(
                "imperfection.scale", at.P_IMPERFECTION_SCALE, "Factor on all imperfections", 1.0, 0.0, 100.0
            ),
            constant(
                "imperfection.seed", "Seed of the imperfections", scene.imperfections.seed, kind="Integer"
            ),
        ]
    radiator = RADIATORS["none" if scene.sound is None else scene.sound.radiator]
    table.append(
        constant(
            "radiator",
            "What radiates: 0 nothing, 1 the bare bearing, 2 the housing",
            radiator,
            kind="Integer",
        )
    )
    if scene.sound is not None:
        weighting = 0.125 if scene.sound.time_weighting == "fast" else 1.0
        start = si(scene.sound).metering_start
        table += [
            tunable(
                "sound.time_weighting",
                at.P_TIME_WEIGHTING,
                "Time constant of the levels: 0.125 Fast, 1 Slow",
                weighting,
                0.02,
                10.0,
                "s",
            ),
            tunable(
                "sound.metering_start",
                at.P_METERING_START,
                "Time after initialisation at which metering begins",
                start,
                0.0,
                1000.0,
                "s",
            ),
        ]
    for k, (name, place) in enumerate(scene.microphones):
        for axis, metres in zip("xyz", place, strict=True):
            words = f"Place of microphone {name}, {axis}"
            table.append(constant(f"mic[{k + 1}].position.{axis}", words, metres, "m"))
    return table
