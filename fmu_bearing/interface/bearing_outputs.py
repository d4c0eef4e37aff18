"""Outputs and local variables of one bearing, as of a single one."""

from dataclasses import replace
from typing import Any

from fmu_bearing.engine.layout import Z
from fmu_bearing.interface.accelerometers import accelerometers
from fmu_bearing.interface.microphones import microphones
from fmu_bearing.interface.variable import Variable, read
from fmu_bearing.scene import Scene

#: Axes and their directions in descriptions.
AXES = (("x", "along the axis"), ("y", "horizontal"), ("z", "upwards"))
_CONTACTS_ALONE = "stiffness of the present contacts between the rings, friction and centrifugal force held"


def outputs(scene: Scene) -> list[Variable]:
    """Return the outputs: velocities, microphones, local defects, friction torque and heats."""
    speed: dict[str, Any] = {"display_unit": "mm/s"}
    table: list[Variable] = []
    for body, words in _bodies(scene):
        table += _vector(body, "velocity", "output", f"Velocity of the {words}'s centre", "m/s", **speed)
    if scene.bearing.cage is not None:
        table.append(read("cage.speed_ratio", "output", "Speed of the cage over the shaft's", nominal=0.4))
    for j in range(scene.bearing.ball_count):
        words = f"Velocity of ball {j + 1}, orbit included,"
        place = Z.BALLS + Z.PER_BALL * j
        table += _vector(f"ball[{j + 1}]", "velocity", "output", words, "m/s", place, nominal=10.0)
    table += microphones(scene, "output", Z.mics(scene.bearing.ball_count))
    table += [*_flexure(scene), *_defects(scene)]
    sizes = (scene.bearing.ball_count, len(scene.microphones), _bands(scene), scene.flexural_modes)
    table += accelerometers(scene, Z.accelerometers(*sizes, len(scene.defects_of(0))))
    torque = (
        "Torque taken from the shaft: positive brakes positive rotation, so it acts on a drive with a minus "
        "sign; without inertia, which the drive owns"
    )
    mean = (
        "Friction torque of the last communication step: the shaft's work over the angle turned; mean over "
        "time where the shaft does not turn or turns back"
    )
    table.append(read("friction_torque", "output", torque, "N.m"))
    table.append(read("friction_torque_mean", "output", mean, "N.m"))
    for name, words in (("inner_ring", "the inner ring"), ("outer_ring", "the outer ring")):
        heat = f"Heat to {words}, mean over the last communication step"
        table.append(read(f"heat.{name}", "output", heat, "W"))
    oil = "Heat to oil and balls, mean over the last communication step"
    return [*table, read("heat.oil", "output", oil, "W")]


def internals(scene: Scene) -> list[Variable]:
    """Return the local variables: places, contacts, shares of the friction torque, the solver's counts."""
    small: dict[str, Any] = {"display_unit": "um"}
    table: list[Variable] = []
    for ring in ("inner", "outer"):
        words = f"Displacement of the {ring} ring's centre"
        table += _vector(f"{ring}_ring", "displacement", "local", words, "m", **small)
    for axis, words in (("y", "the horizontal"), ("z", "the upward")):
        tilt = f"Tilt of the inner ring about {words} axis"
        table.append(read(f"inner_ring.tilt.{axis}", "local", tilt, "rad", nominal=1e-4))
    table += [*_contacts("inner"), *_contacts("outer"), *_fits(scene)]
    if scene.bearing.is_deep_groove:
        words = "Radial clearance that fits, rotation and heat leave; negative: balls are pressed"
        table.append(read("clearance", "local", words, "m", display_unit="um", nominal=1e-5))
    table += [
        read("film.lambda_min", "local", "Thinnest oil film over the composite roughness", nominal=1.0),
        read("stiffness.axial", "local", f"Axial {_CONTACTS_ALONE}", "N/m"),
        read("stiffness.radial", "local", f"Radial {_CONTACTS_ALONE}", "N/m"),
        *_cage_whirl(scene),
        *_torque_shares(scene),
        read(
            "energy.residual",
            "local",
            "Work in minus dissipation minus change of stored energy, over dissipation once there is any",
        ),
        _count("solver.steps", "Internal steps so far"),
        _count("solver.rejected", "Internal steps refused so far"),
        _count(
            "solver.restarts",
            "How often fidelities rings and response restarted from rest, because no step was possible",
        ),
        read(
            "solver.growth",
            "local",
            "Growth of the motion of the rings that grows most by itself, by the linear equations of "
            "fidelities rings and response at the inputs of the last renewal; 0 if none grows, and in full",
            "1/s",
        ),
        read(
            "solver.wave_time",
            "local",
            "Time in which the fastest wave of races and balls turns by one radian, 1 s at most: internal "
            "steps are at most 1.6 times as long with fidelity full, and as long with rings",
            "s",
            display_unit="us",
            nominal=2e-5,
        ),
    ]
    return table + microphones(scene, "local", Z.mics(scene.bearing.ball_count))


def _count(name: str, words: str, causality: str = "local", index: int | None = None) -> Variable:
    """Whole number that only grows."""
    variable = read(name, causality, words, index=index, quantity="", min=0, max=2**31 - 1, nominal=None)
    return replace(variable, type="Integer", variability="discrete")


def _vector(
    body: str, motion: str, causality: str, words: str, unit: str, first: int | None = None, **more: Any
) -> list[Variable]:
    return [
        read(
            f"{body}.{motion}.{axis}",
            causality,
            f"{words} {direction}",
            unit,
            None if first is None else first + k,
            **more,
        )
        for k, (axis, direction) in enumerate(AXES)
    ]


def _bodies(scene: Scene) -> list[tuple[str, str]]:
    bodies = [("inner_ring", "inner ring"), ("outer_ring", "outer ring"), ("cage", "cage")]
    return bodies if scene.bearing.cage is not None else bodies[:2]


def _contacts(side: str) -> list[Variable]:
    at_race = f"at the {side} race"
    angle = f"Mean contact angle {at_race}"
    margin = f"Angle by which the largest contact ellipse {at_race} ends before the shoulder"
    pressure: dict[str, Any] = {"display_unit": "GPa", "min": 0.0, "max": 1e12, "nominal": 1e9}
    return [
        read(f"contact.{side}.load_mean", "local", f"Mean load of a ball {at_race}", "N"),
        read(f"contact.{side}.load_max", "local", f"Largest load of a ball {at_race}", "N"),
        read(f"contact.{side}.angle_mean", "local", angle, "rad", display_unit="deg"),
        read(
            f"contact.{side}.pressure_max", "local", f"Largest contact pressure {at_race}", "Pa", **pressure
        ),
        read(f"contact.{side}.spin_to_roll", "local", f"Mean spin over roll of the balls {at_race}"),
        read(f"contact.{side}.slip", "local", f"Mean sliding over entrainment speed {at_race}", nominal=1e-3),
        read(f"contact.{side}.shoulder_margin", "local", margin, "rad", display_unit="deg"),
    ]


def _fits(scene: Scene) -> list[Variable]:
    if scene.fit is None:
        return []
    angle = "Contact angle of unloaded balls between the mounted rings; 0: radially tight"
    table = [read("contact.free_angle", "local", angle, "rad", display_unit="deg")]
    stress: dict[str, Any] = {"display_unit": "MPa", "nominal": 1e7}
    for ring, seat, of in (("inner", scene.fit.shaft, "shaft"), ("outer", scene.fit.housing, "housing")):
        if seat is None:
            continue
        tight = f"Interference of the {ring} ring with the {of} on diameter, + tight, negative: a gap"
        hoop = f"Hoop stress at the bore of the {ring} ring by its fit" + " and rotation" * (ring == "inner")
        growth = f"Radial growth of the {ring} race by its fit" + " and rotation" * (ring == "inner")
        table += [
            read(f"fit.{ring}.interference", "local", tight, "m", display_unit="um", nominal=1e-6),
            read(f"fit.{ring}.pressure", "local", f"Pressure between {ring} ring and {of}", "Pa", **stress),
            read(f"fit.{ring}.hoop_stress", "local", hoop, "Pa", **stress),
            read(f"fit.{ring}.race_growth", "local", growth, "m", display_unit="um", nominal=1e-6),
        ]
    return table


def _cage_whirl(scene: Scene) -> list[Variable]:
    if scene.bearing.cage is None:
        return []
    ring = "outer" if scene.bearing.cage.guidance == "outer" else "inner"
    radius = f"Distance of the cage's centre from the {ring} ring's"
    return [
        read("cage.whirl_radius", "local", radius, "m", display_unit="um", min=0.0, nominal=1e-5),
        read(
            "cage.whirl_speed",
            "local",
            f"Angular velocity of the cage's centre about the {ring} ring's",
            "rad/s",
            display_unit="r/min",
        ),
    ]


def _torque_shares(scene: Scene) -> list[Variable]:
    shares = [
        ("contacts", "sliding in the contacts of balls and races"),
        ("rolling", "rolling resistance"),
        ("cage", "the cage's pockets and lands"),
        ("drag", "drag on the balls"),
        ("seals", "seals"),
    ]
    left_out = {"cage"} if scene.bearing.cage is None else set()
    if scene.bearing.seal is None:
        left_out.add("seals")
    how = "power lost there over the shaft speed, 0 at standstill"
    return [
        read(
            f"friction_torque_share.{name}", "local", f"Share of {words} in the friction torque: {how}", "N.m"
        )
        for name, words in shares
        if name not in left_out
    ]


def _bands(scene: Scene) -> int:
    """Return the number of third octaves of each microphone."""
    return len(Z.BANDS) if scene.sound is not None and scene.sound.third_octaves else 0


def _flexure(scene: Scene) -> list[Variable]:
    """Return the velocities of the rings' bending, in the order of the engine's coordinates.

    A bending of order n moves the groove radially by cosine cos(n theta) + sine sin(n theta), theta from
    12 o'clock about +X in the frame that does not spin.
    """
    flexure = scene.mounted.flexure
    if flexure is None:
        return []
    first = Z.flexures(scene.bearing.ball_count, len(scene.microphones), _bands(scene))
    table: list[Variable] = []
    for ring, orders in (("inner", flexure.inner_ring), ("outer", flexure.outer_ring)):
        for order in orders:
            for part in ("cosine", "sine"):
                words = f"Velocity of the {ring} ring's bending of order {order} at the groove, {part} part"
                name = f"{ring}_ring.flexure.n{order}.{part}"
                table.append(
                    read(name, "output", words, "m/s", first + len(table), display_unit="mm/s", nominal=1e-3)
                )
    return table


def _defects(scene: Scene) -> list[Variable]:
    """Return the outputs of local defects, in the order of the engine's :data:`Z.DEFECT_OUTPUTS`."""
    at = Z.defects(scene.bearing.ball_count, len(scene.microphones), _bands(scene), scene.flexural_modes)
    time: dict[str, Any] = {"display_unit": "ms", "min": -1e9, "max": 1e9}
    table: list[Variable] = []
    for k, defect in enumerate(scene.defects_of(0).values()):
        one = "contact of its ball" if defect.on == "ball" else "ball"
        name, first = f"defect[{k + 1}]", at + Z.PER_DEFECT * k
        passed, load, since, entry, impact = (first + i for i in range(Z.PER_DEFECT))
        over, middle = "over the edge of the defect", f"middle of a {one}"
        table += [
            _count(f"{name}.passages", f"How often the {middle} has passed the defect", "output", passed),
            read(
                f"{name}.load", "output",
                f"Load of the {one} nearest to the defect, 0 where none is within its reach", "N", load,
            ),
            read(
                f"{name}.time", "output",
                f"Time since the {middle} came {over}; 0 before the first", "s", since, **time,
            ),
            read(
                f"{name}.entry", "output",
                f"When the {middle} last came {over}; 0 before the first", "s", entry, **time,
            ),
            read(
                f"{name}.impact", "output",
                f"When a {one} in the defect last turned from sinking to rising; 0 before the first",
                "s", impact, **time,
            ),
        ]  # fmt: skip
    return table
