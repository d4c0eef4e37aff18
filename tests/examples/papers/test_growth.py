"""No value of a paper comes from a scene whose modes grow: all scenes of the pages, over their speeds."""

from dataclasses import replace

import pytest

from examples.papers import impact_noise, multi_source, printed, sound_field
from examples.papers.case import Case, growing
from examples.papers.lines import SPEEDS


def _cases():
    """Operating points of all pages, without seeds: waves and unbalance change no mode."""
    own = [Case(multi_source.SCENE, rpm, multi_source.AXES) for rpm in SPEEDS[::5]]
    own += [
        Case(multi_source.SCENE, 15000, (*multi_source.AXES, *multi_source.with_masses(*masses)))
        for masses in multi_source.CORNERS
    ]
    own += [Case(multi_source.SCENE, rpm, multi_source.FRICTIONLESS) for rpm in multi_source.FRICTION_SPEEDS]
    own += [Case(multi_source.SCENE, 28000, changes) for changes in multi_source.ASKEW.values()]
    own += [Case(printed.SCENE, rpm, printed.CHANGES) for rpm in SPEEDS[::10]]
    own += [
        impact_noise.case(rpm, changes)
        for rpm in impact_noise.SPEEDS
        for changes in ((), *impact_noise.OTHERS.values())
    ]
    for steel in ((), sound_field._steel()):
        own += [sound_field.case(rpm, steel, bare) for rpm in sound_field.SPEEDS for bare in (False, True)]
    own += [sound_field.case(sound_field.WHOLE, changes) for changes in sound_field.DIRECTIONS.values()]
    return own


@pytest.mark.heavy
@pytest.mark.parametrize("around", [*(pytest.param(x, marks=pytest.mark.heavy) for x in (0.96, 1.0)), 1.04])
def test_no_mode_of_a_papers_scene_grows(around):
    for one in _cases():
        mode = growing(replace(one, around=around).build())
        assert mode is None, (one.scene, one.rpm, one.changes, mode)


@pytest.mark.parametrize(
    ("scene", "rpm", "growth"), [("7009C-steel", 18000, 395), ("7009C-steel", 15000, 174)]
)
def test_a_scene_that_whirls_by_itself_is_refused(scene, rpm, growth):
    # the twin as it was before it had a tilt support: 88.7 dB without any imperfection
    mode = growing(Case("7009C-steel", rpm).build())
    assert mode.growth == pytest.approx(growth, rel=0.02)
    with pytest.raises(ValueError, match="grows by .* so no value of a paper is read from it"):
        Case("7009C-steel", rpm).recording("bem")
