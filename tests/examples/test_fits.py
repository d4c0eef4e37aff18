"""The bearing that gets warm on its shaft: what the thermal network gives is what its fit follows."""

import sys

import pytest

from fmu_bearing.design.operating_point import operating_point
from fmu_bearing.prepare.fits import seats
from tests.conftest import ROOT

FITS = ROOT / "examples" / "fits"
ZERO_CELSIUS = 273.15


@pytest.fixture(scope="module")
def example():
    """The example, imported as its script imports what it needs."""
    sys.path.insert(0, str(FITS))
    import warm_up

    yield warm_up
    sys.path.remove(str(FITS))
    del sys.modules["warm_up"]


@pytest.fixture(scope="module")
def tables(example, tmp_path_factory):
    """Scenes and tables of both short runs."""
    folder = tmp_path_factory.mktemp("fits")
    found = example.scenes()
    return found, {name: example.cosimulate(name, one, folder, example.SHORT) for name, one in found.items()}


@pytest.mark.heavy
def test_the_fit_follows_the_temperatures_of_the_network(tables):
    scenes, runs = tables
    run = runs["fitted"]
    seat, sliding = seats(scenes["fitted"])
    assert run["shaft_temperature"][-1] > run["shaft_temperature"][0] + 1.0
    for k in (1, len(run) // 2, len(run) - 1):
        # the bearing has the temperatures of the step's beginning, and the speed of its end
        speed = run["shaft_speed"][k]
        warm = run["inner_ring_temperature"][k - 1], run["shaft_temperature"][k - 1]
        state = seat.fit.at(seat.interference, speed, *warm)
        assert run["fit.inner.interference"][k] == pytest.approx(2.0 * state.interference, rel=1e-9)
        outside = run["outer_ring_temperature"][k - 1], run["housing_temperature"][k - 1]
        gap = sliding.fit.at(sliding.interference, speed, *outside).interference
        assert run["fit.outer.interference"][k] == pytest.approx(2.0 * gap, rel=1e-9)
        assert run["fit.inner.race_growth"][k] == pytest.approx(state.race, rel=1e-9)
        assert run["fit.inner.hoop_stress"][k] == pytest.approx(state.hoop, rel=1e-9)


@pytest.mark.heavy
def test_preload_of_the_run_is_that_of_the_operating_point(example, tables):
    scenes, runs = tables
    for name, run in runs.items():
        last, scene = run[-1], scenes[name]
        keys = {
            f"operation.{lump}_temperature_degC": float(last[f"{lump}_temperature"]) - ZERO_CELSIUS
            for lump in ("inner_ring", "outer_ring", "oil")
        }
        if scene.fit is not None:
            for seat in ("shaft", "housing"):
                kelvin = float(last[f"{seat}_temperature"])
                keys[f"mounting.fit.{seat}.temperature_degC"] = kelvin - ZERO_CELSIUS
        point = operating_point(scene.replace({**keys, "operation.speed_rpm": 20000.0}))
        mean = run["preload"][-round(example.MEAN / example.SHORT.communication_step) :].mean()
        # waves of class P4 and the heavy rotor move the rings by parts of the preload's deflection
        assert mean == pytest.approx(point.bearings[0].axial, rel=0.03), name
    assert runs["fitted"]["preload"][-20:].mean() > 1.2 * runs["loose"]["preload"][-20:].mean()


@pytest.mark.heavy
def test_the_picture_is_drawn(example, tables, tmp_path):
    example.draw(tables[1], example.SHORT, tmp_path / "fits.png")
    assert (tmp_path / "fits.png").stat().st_size > 20_000
