"""What the bearings of a set radiate: tables of transfer functions of each, housing and front of the set."""

from dataclasses import replace

from fmu_bearing.acoustics.filters.design import radiation_of, radiators_of, table_of
from fmu_bearing.acoustics.radiation.radiators import Housing, Radiators
from fmu_bearing.acoustics.radiation.table import Table, of_bearing
from fmu_bearing.scene import Scene
from fmu_bearing.scene.housing import middle_mm
from fmu_bearing.scene.member import radiating, set_of, sound_scene


def tables_of(scene: Scene) -> list[Table]:
    """Return the table of every bearing, of a set each in its own axes; raises as `check_table`."""
    whole, bearings = table_of(scene), scene.bearings()
    if not scene.assembly.joined:
        return [whole]
    return [of_bearing(whole, bearing.number, bearing.sign, len(bearings)) for bearing in bearings]


def check_table(scene: Scene) -> None:
    """Read the table of transfer functions of a scene, if it has one, as a run does; no filter is fitted.

    Raises
    ------
    ValueError
        When it cannot be read or does not serve.
    """
    if scene.sound is not None and scene.sound.radiation_model == "table":
        positions = [position for _, position in scene.microphones]
        for bearing, table in zip(scene.bearings(), tables_of(scene), strict=True):
            radiation = radiation_of(sound_scene(scene, bearing.number - 1), table=table)
            for members in radiation.circles(positions):
                radiation.paths(positions, members)


def housing_of_set(scene: Scene) -> Housing:
    """Return the housing of a set that radiates, in the axes of its first bearing.

    All outer rings on fixed seats move with it as one rigid body, so the first one's motion and tilts give
    everything that it does.
    """
    spindle = set_of(scene)
    first = spindle.bearing[0]
    diameter, length = spindle.housing.diameter_mm, spindle.housing.length_mm
    assert diameter is not None and length is not None, "a housing that radiates moves and has a size"
    centre = first.sign * (middle_mm(spindle) - first.position_mm)
    return Housing(1e-3 * diameter, 1e-3 * length, 1e-3 * centre, turned=first.sign < 0, tilts=True)


def front_of_set(scene: Scene) -> Radiators:
    """Return what a set shows ahead where a housing or a rigid plane covers the rest: its first bearing.

    In the axes of that bearing.
    """
    shown = radiators_of(radiating(scene, 0))
    if scene.sound is not None and scene.sound.radiator == "housing":
        return replace(shown, housing=housing_of_set(scene))
    return replace(shown, baffle=True, turned=set_of(scene).bearing[0].sign < 0)
