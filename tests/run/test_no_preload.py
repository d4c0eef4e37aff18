"""A bearing without preload is warned of, whatever computes it and however it gets there."""

import warnings

import fmpy
import pytest

from fmu_bearing import Bearing, simulate
from fmu_bearing.compiled import BuildError
from fmu_bearing.modal.equations.remarks import LOOSE
from fmu_bearing.run.build import build_fmu, model_of
from fmu_bearing.scene.read import with_fidelity
from tests.native_builds import no_native_fmu


def loose(silent, model, mode="force"):
    mounting = silent.mounting.model_copy(update={"preload_N": 0.0, "preload_mode": mode})
    return with_fidelity(silent.model_copy(update={"mounting": mounting}), model=model)


def about_preload(reported):
    return [str(one.message) for one in reported if "preload = 0 N" in str(one.message)]


@pytest.mark.parametrize("mode", ["force", "rigid"])
@pytest.mark.parametrize("model", ["full", "rings", "response"])
def test_it_is_warned_of_once_at_every_fidelity(silent, model, mode):
    with warnings.catch_warnings(record=True) as reported:
        warnings.simplefilter("always")
        simulate(loose(silent, model, mode), 2e-3, outputs=["friction_torque"])
    (line,) = about_preload(reported)
    assert "mounting.preload_N" in line and (model == "full") != (f"fidelity {model}" in line)


def test_it_is_warned_of_when_an_input_takes_it_away(silent):
    bearing = Bearing(with_fidelity(silent, model="rings"))
    with warnings.catch_warnings(record=True) as reported:
        warnings.simplefilter("always")
        bearing.init()
        bearing.step(1e-4)
        assert not about_preload(reported)
        bearing.step(1e-4, preload=0.0)
        bearing.step(1e-4)
        assert len(about_preload(reported)) == 1
        bearing.init(preload=0.0)
        assert len(about_preload(reported)) == 2


def test_an_fmu_of_it_is_built_with_a_caution(silent):
    lines = []
    model_of(loose(silent, "rings"), lines.append)
    assert len(lines) == 2 and lines[0].startswith("caution: preload = 0 N")
    # the cage carries loose balls, so no growth of a whirl is known
    assert lines[1].startswith("caution: levels and velocities of fidelity rings")
    assert LOOSE in lines[1]


def test_an_fmu_that_starts_without_it_is_warned_of(silent, tmp_path):
    path = build_fmu(with_fidelity(silent, model="rings"), tmp_path / "rings.fmu", "python").path
    with pytest.warns(UserWarning, match="preload = 0 N"):
        simulate(path, 1e-3, start_values={"preload": 0.0}, outputs=["friction_torque"])


@pytest.mark.parametrize("flavour", ["native", "python"])
def test_fmus_say_it_in_every_host(silent, tmp_path, flavour):
    try:
        path = build_fmu(with_fidelity(silent, model="response"), tmp_path / "a.fmu", flavour).path
    except BuildError as problem:
        no_native_fmu(problem)
    said = []
    fmpy.simulate_fmu(
        str(path), stop_time=1e-3, start_values={"preload": 0.0}, debug_logging=True,
        logger=lambda _environment, _name, status, _category, text: said.append((status, text.decode())),
    )  # fmt: skip
    (text,) = [text for status, text in said if status == 1 and "preload = 0 N: no axial force" in text]
    assert "fidelity response has balls that always roll" in text
