"""Points are checked before any is run; their keys name what they are made of."""

import dataclasses

import pytest

from fmu_bearing.interface.names import UnknownName
from fmu_bearing.scene.read import with_fidelity
from fmu_bearing.sweeps import point
from fmu_bearing.sweeps.axes import SweepError
from fmu_bearing.sweeps.plan import plan


@pytest.fixture(scope="module")
def rings(scene):
    return with_fidelity(scene("7003C-spindle"), model="rings")


def test_points_go_through_the_last_axis_fastest(rings):
    made = plan(rings, {"preload": [300, 500], "speed": [1000, 2000, 3000]})
    assert made.shape == (2, 3)
    at = [(t.scene.mounting.preload_N, t.scene.operation.speed_rpm) for t in made.tasks]
    assert at == [(p, n) for p in (300.0, 500.0) for n in (1000.0, 2000.0, 3000.0)]
    assert len({task.key for task in made.tasks}) == 6


def test_members_of_arrays_and_terms_are_keys_too(rings):
    made = plan(rings, {"sound.microphone[2].y_mm": [150, 300], "fidelity.terms.drag": [True, False]})
    assert [t.scene.microphones[1].position_m[1] for t in made.tasks] == [0.15, 0.15, 0.3, 0.3]
    assert [t.scene.fidelity.terms.drag for t in made.tasks] == [True, False, True, False]


def test_values_out_of_range_are_reported_for_all_points_as_the_scene_reports_them(rings):
    with pytest.raises(SweepError) as caught:
        plan(
            rings, {"speed": [2e5, 1000, 3e5], "preload": [-1, 500], "bearing.inner_conformity": [0.4, 0.52]}
        )
    reported = str(caught.value).splitlines()
    most = "allowed: -100000 to 100000 r/min, n d_m of 2.6e6 mm r/min or more"
    assert f"operation.speed_rpm = 200000.0 is refused; {most}" in reported
    assert f"operation.speed_rpm = 300000.0 is refused; {most}" in reported
    assert (
        sum(line.startswith("mounting.preload_N = -1 is refused; allowed: 0 to ") for line in reported) == 1
    )
    assert (
        sum(line.startswith("bearing.inner_conformity = 0.4") for line in reported) == 1
        and len(reported) == 4
    )


def test_points_without_preload_are_warned_of_once_before_any_runs(rings):
    with pytest.warns(UserWarning, match="preload = 0 N.*fidelity rings") as reported:
        plan(rings, {"preload": [0, 100], "speed": [1000, 2000]})
    assert len(reported) == 1


def test_values_that_do_not_fit_together_are_reported(rings):
    with pytest.raises(SweepError, match=r"lies inside the housing"):
        plan(rings, {"mounting.housing.diameter_mm": [100, 400]})
    with pytest.raises(SweepError, match=r"no table \[mounting.flexure\]"):
        plan(rings, {"mounting.flexure.damping_ratio": [0.01, 0.02]})
    with pytest.raises(SweepError, match="decided by timing"):
        plan(rings, {"fidelity": ["rings", "auto"]})


@pytest.mark.parametrize(
    ("options", "reported"),
    [
        ({"settle": -1.0}, "settle = -1.0 s is refused: allowed are 0 to 1000 s"),
        ({"window": 0.0}, "window = 0.0 s is refused: allowed are 0.001 to 1000 s"),
        ({"figures": ["friction_torqe"]}, "did you mean 'friction_torque'"),
        ({"figures": ["friction_torque:median"]}, "no statistic 'median'"),
        ({"figures": ["friction_torque:1x"]}, "of a body's velocity"),
    ],
)
def test_settings_that_are_refused(rings, options, reported):
    with pytest.raises((SweepError, UnknownName), match=reported):
        plan(rings, {"speed": [1000]}, **options)


def test_figures_have_their_usual_statistic(rings):
    made = plan(
        rings,
        {"speed": [1000]},
        figures=["friction_torque", "friction_torque:max", "mic[*].leq_a", "cage.velocity"],
    )
    assert [(f.name, f.statistic) for f in made.figures] == [
        ("friction_torque", "mean"), ("friction_torque:max", "max"), ("mic[1].leq_a", "last"),
        ("mic[2].leq_a", "last"), ("mic[3].leq_a", "last"), ("mic[4].leq_a", "last"),
        ("cage.velocity", "rms"),
    ]  # fmt: skip


def test_scenes_with_equal_sound_share_one_preparation(rings):
    made = plan(
        rings, {"speed": [1000, 2000], "pedestal": [1e7, 2e7], "mounting.housing.length_mm": [160, 200]}
    )
    assert len(made.sounds) == 2
    lengths = {(t.scene.mounting.housing.length_mm, t.sound.mounting.housing.length_mm) for t in made.tasks}
    assert lengths == {(160.0, 160.0), (200.0, 200.0)}


def test_a_key_names_scene_settings_and_code(rings, monkeypatch):
    base = plan(rings, {"speed": [1000]}).tasks[0].key
    assert plan(rings, {"speed": [1000.0], "preload": [500]}).tasks[0].key == base  # the scene's own preload
    others = [
        plan(rings, {"speed": [1001]}),
        plan(rings, {"seed": [2], "speed": [1000]}),
        plan(rings, {"speed": [1000]}, settle=0.03),
        plan(rings, {"speed": [1000]}, window=0.03),
        plan(rings, {"speed": [1000]}, figures=["friction_torque"]),
    ]
    monkeypatch.setattr(point, "code_digest", lambda: "another version")
    others.append(plan(rings, {"speed": [1000]}))
    assert len({base, *(made.tasks[0].key for made in others)}) == 7


def test_a_worker_with_other_code_runs_nothing(rings):
    task = dataclasses.replace(plan(rings, {"speed": [1000]}).tasks[0], code="another")
    outcome = point.run_point(task)
    assert "other code" in outcome.reason and not outcome.lasting
