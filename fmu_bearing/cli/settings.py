"""What ``--set`` and ``--fidelity`` make of a scene: keys, and inputs of the model by name; axes."""

from collections.abc import Collection, Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fmu_bearing.cli.base import DECIMAL_COMMA, Refusal, shaft_speed

if TYPE_CHECKING:
    from fmu_bearing.scene import Scene

#: How an axis of numbers is written.
AXIS = "LOW:HIGH:COUNT, LOW:HIGH:COUNTlog or VALUE,VALUE,..."
#: Key of the scene behind an input, where it is not the input's own name in ``operation``.
_KEYS = {
    "preload": "mounting.preload_N",
    "pedestal_stiffness": "mounting.pedestal_stiffness_N_m",
    "radial_load.y": "mounting.radial_load_y_N",
    "radial_load.z": "mounting.radial_load_z_N",
}
_KEYS_OF_SETS = {
    "preload": "spindle.preload.preload_N",
    "pedestal_stiffness": "spindle.housing.pedestal_stiffness_N_m",
    "shaft_temperature": "spindle.shaft.temperature_degC",
    "housing_temperature": "spindle.housing.temperature_degC",
}
_KEYS_OF_BOTH = {
    "shaft_speed": "operation.speed_rpm",
    "oil_temperature": "operation.oil_temperature_degC",
    "inner_ring_temperature": "operation.inner_ring_temperature_degC",
    "outer_ring_temperature": "operation.outer_ring_temperature_degC",
}


def changed(
    scene: "Scene", settings: list[str] | None, parameters: Collection[str] = ()
) -> tuple["Scene", dict[str, float]]:
    """Return a scene with the keys that were set, and the inputs that were set, in SI units.

    Parameters
    ----------
    scene : Scene
    settings : list of str, optional
        ``KEY=VALUE`` each.
    parameters : collection of str
        Names of parameters that can be set as inputs are.

    Raises
    ------
    ValueError
        For text that is not a setting, an unknown key, and a value that is refused.
    """
    from fmu_bearing.interface.inputs import inputs_of
    from fmu_bearing.sweeps.axes import plain_value

    units = {variable.name: variable.unit for variable in inputs_of(scene)}
    named = _with_units(units, parameters)
    keys: dict[str, Any] = {}
    inputs: dict[str, float] = {}
    for setting in settings or ():
        key, text = pair(setting)
        if key in named:
            name, value = _in_si(setting, named[key], units)
            inputs[name] = value
        else:
            _check_key(scene, setting, key, named, units)
            keys[key] = _list(setting, text) if text[0] == "[" else plain_value(text.strip("\"'"))
    return (scene.replace(keys) if keys else scene), inputs


def start_of(
    settings: list[str] | None, units: Mapping[str, str], parameters: Collection[str]
) -> dict[str, float]:
    """Return start values of an FMU, in SI units; ``units``: of its inputs by name.

    Raises
    ------
    Refusal
        For text that is not a setting, and a speed without its unit.
    UnknownName
        For an unknown name.
    """
    from fmu_bearing.interface.names import known

    named = _with_units(units, parameters)
    values = {}
    for setting in settings or ():
        key, text = pair(setting)
        if key in named:
            name, value = _in_si(setting, named[key], units)
            values[name] = value
        else:
            of_speeds = {name for name, unit in units.items() if unit == "rad/s"}
            known(key, [one for one in named if one not in of_speeds], "input or parameter")
    return values


def _with_units(units: Mapping[str, str], parameters: Collection[str]) -> dict[str, tuple[str, str]]:
    """Return input and suffix by each name under which an input may be set."""
    from fmu_bearing.run.input_file import SUFFIXES

    return {
        name + suffix: (name, suffix) for name, unit in units.items() for suffix in SUFFIXES.get(unit, ())
    } | {name: (name, "") for name in (*units, *parameters)}


def _in_si(setting: str, named: tuple[str, str], units: Mapping[str, str]) -> tuple[str, float]:
    """Return an input with its value in SI units; `Refusal` for a speed that does not say r/min."""
    from fmu_bearing.scene.units import convert

    name, suffix = named
    _, text = pair(setting)
    if units.get(name) == "rad/s" and not suffix:
        option = f" or --speed {text}" if name == "shaft_speed" else ""
        raise Refusal(f"--set {setting}: speeds are given in r/min here: {name}_rpm={text}{option}")
    value = number(setting, text)
    return name, convert(value, suffix) if suffix else value


def pair(setting: str) -> tuple[str, str]:
    """Return name and value of a setting.

    Raises
    ------
    Refusal
        For text that is none.
    """
    name, equals, text = (part.strip() for part in setting.partition("="))
    if not (name and equals and text):
        raise Refusal(f"--set {setting}: write KEY=VALUE, as mounting.preload_N=300 or preload=300")
    if DECIMAL_COMMA.fullmatch(text):
        raise Refusal(f"--set {setting}: a decimal number has a point: write {name}={text.replace(',', '.')}")
    return name, text


def number(setting: str, text: str) -> float:
    """Return the value of an input; `Refusal` for what is no number."""
    try:
        return float(text)
    except ValueError:
        raise Refusal(f"--set {setting}: write a number, as preload=300") from None


def _list(setting: str, text: str) -> Any:
    """Return the value of a key that is a list, written as in a scene file; `Refusal` for what is none."""
    from fmu_bearing.scene.toml_text import parse

    try:
        return parse(f"value = {text}")["value"]
    except ValueError:
        key, _ = pair(setting)
        raise Refusal(
            f"--set {setting}: write a list as in a scene file, in single quotes for the shell: "
            f'--set \'{key}=["first", "second"]\', numbers as [1.0, 2.0]'
        ) from None


def numbers(name: str, text: str | None) -> list[float] | None:
    """Return the numbers of an axis, as of ``--speeds``, from text; `Refusal` for what is none."""
    from fmu_bearing.sweeps.axes import SweepError, parse_values

    if text is None:
        return None
    try:
        values = parse_values(name, text)
    except SweepError:
        values = [text]
    if not all(isinstance(value, int | float) and not isinstance(value, bool) for value in values):
        raise Refusal(f"--{name} {text} is refused: write {AXIS}")
    return [float(value) for value in values]


def at_speed(rpm: float | None, settings: list[str] | None, scene: "Path | Scene") -> list[str] | None:
    """Return settings with the shaft speed of ``--speed`` (r/min), which is checked."""
    shaft_speed(rpm, scene)
    return settings if rpm is None else [*(settings or ()), f"operation.speed_rpm={rpm!r}"]


def source_of(source: Path, settings: list[str] | None, fidelity: str | None = None) -> "Path | Scene":
    """Return the scene of a file with keys, inputs and fidelity of the command line; the file without any.

    Inputs become the keys behind them, so that all that is computed of the scene is of their values.

    Raises
    ------
    ValueError
        As `changed`, for an input that no key holds, and for a file that is no scene, as a recording is.
    """
    from fmu_bearing.scene.read import read_scene

    if not settings and fidelity is None:
        return source
    if source.suffix in (".npz", ".csv", ".nc", ".fmu"):
        option = "--set" if settings else "--fidelity"
        raise Refusal(f"{option} is refused: {source} is finished, and was run as it is; give its scene")
    scene = read_scene(source)
    key = "operation.speed_rpm"
    asked = [one.partition("=")[2] for one in settings or () if one.partition("=")[0].strip() == key]
    try:
        waves = _waves(scene, float(asked[-1])) if asked else {}
    except ValueError:  # which the scene refuses
        waves = {}
    if any("lowest_speed_rpm" in setting for setting in settings or ()):
        waves = {}
    return scene_with(scene, [*(settings or ()), *(f"{key}={rpm!r}" for key, rpm in waves.items())], fidelity)


def _waves(scene: "Scene", rpm: float | None) -> dict[str, float]:
    """Return the key that keeps the waves of a scene which is put to a speed (r/min) that decides none."""
    from fmu_bearing.scene.scene import SLOW_RPM

    flaws, operation = scene.imperfections, scene.operation
    if rpm is None or flaws is None or not flaws.follows_law or operation.lowest_speed_rpm is not None:
        return {}
    slow = abs(rpm) < SLOW_RPM <= abs(operation.speed_rpm)
    return {"operation.lowest_speed_rpm": abs(operation.speed_rpm)} if slow else {}


def scene_with(scene: "Scene", settings: list[str] | None, fidelity: str | None = None) -> "Scene":
    """Return a scene with keys, inputs and fidelity of the command line, as `source_of`."""
    from fmu_bearing.scene.read import with_fidelity

    scene, inputs = changed(scene, settings)
    if inputs:
        keys = _as_keys(scene, inputs)
        scene = scene.replace(keys | _waves(scene, keys.get("operation.speed_rpm")))
    return scene if fidelity is None else with_fidelity(scene, model=fidelity)


def _as_keys(scene: "Scene", inputs: dict[str, float]) -> dict[str, float]:
    """Return the keys that hold these inputs, with their values in the keys' units."""
    from fmu_bearing.scene.units import UNITS, split_unit

    keys = {}
    for name, value in inputs.items():
        key = _key_of(scene, name)
        if key is None:
            raise Refusal(
                f"--set {name}={value:g} is refused: no key of the scene holds this input; simulate, modes "
                "and stiffness take it"
            )
        factor, offset = UNITS[split_unit(key)[1]]
        keys[key] = (value - offset) / factor
    return keys


def _key_of(scene: "Scene", name: str) -> str | None:
    from fmu_bearing.scene.member import set_of

    if not scene.assembly.joined:
        return (_KEYS_OF_BOTH | _KEYS).get(name)
    place, _, own = name.partition("].")
    if own in ("inner_ring_temperature", "outer_ring_temperature"):
        return f"spindle.{place}].{own}_degC"
    if name.startswith("nose.force.") and set_of(scene).load.position_mm == 0.0:
        return f"spindle.load.force_{name[-1]}_N"
    return (_KEYS_OF_BOTH | _KEYS_OF_SETS).get(name)


def _check_key(
    scene: "Scene", setting: str, key: str, inputs: Iterable[str], units: Mapping[str, str]
) -> None:
    """Refuse a name that is in no table of scenes, with the input or key that was meant."""
    from fmu_bearing.likeness import nearest
    from fmu_bearing.scene.preload import CLASS, OFFSET
    from fmu_bearing.scene.values import fields_of

    if _table(key) in type(scene).model_fields:
        return  # the scene itself says what is wrong with it
    keys = [field for field in fields_of(scene) if getattr(scene, _table(field)) is not None]
    if scene.fit is None:  # whose keys have names of other tables, as preload
        keys = [one for one in keys if ".fit." not in one]
    if scene.assembly.can_preload:  # in place of the force that the scene has
        keys += [f"{scene.assembly.preload_table}.{key}" for key in (CLASS, OFFSET)]
    named = [one for one in inputs if units.get(one) != "rad/s"]
    key = {"speed": "speed_rpm", "n": "speed_rpm", "rpm": "speed_rpm"}.get(key, key)
    known = {one.rpartition(".")[2]: one for one in reversed(keys)} | {one: one for one in named}
    near = known[key] if key in known else known.get(nearest(key, known), "")
    unit = f" ({units[near]})" if units.get(near) else ""
    hint = (
        f"; did you mean {near}{unit}?"
        if near
        else f": keys have their table, as {scene.assembly.preload_table}.preload_N"
    )
    raise Refusal(f"--set {setting}: there is no such key or input{hint}")


def _table(key: str) -> str:
    """Return the table of a scene that a key begins with."""
    return key.partition(".")[0].partition("[")[0]
