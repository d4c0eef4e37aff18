"""FMUs with fits: both builds and the library give the same bits, with temperatures and interferences set."""

import functools
import zipfile

import numpy as np
import pytest

from fmu_bearing.compiled.errors import BuildError
from fmu_bearing.fmi.description import FLAVOURS
from fmu_bearing.fmi.package import build
from fmu_bearing.instance import Instance
from fmu_bearing.prepare.model import prepare
from fmu_bearing.scene import read_scene
from tests.conftest import GATES
from tests.native_builds import no_native_fmu

from .conftest import OK, Master
from .run_up import FROM, SIZE, STEPS, run_up, speed

FIT = {
    "preload": "unmounted",
    "shaft": {"interference_um": 2.0, "temperature_degC": 40.0},
    "housing": {"interference_um": 1.0, "material": "GCr15", "outside_diameter_mm": 60.0}
    | {"temperature_degC": 20.0},
}
WARM = {"inner_ring_temperature": 318.0, "shaft_temperature": 314.0, "housing_temperature": 292.15}
TUNED = {"fit.shaft_interference": 3.5e-6, "fit.housing_interference": 1.5e-6}
OUTPUTS = ("interference", "pressure", "hoop_stress", "race_growth")


@functools.cache
def model():
    """The bare 7003C, held rigidly, with compact sound and both seats."""
    scene = read_scene(GATES / "7003C-bare.toml")
    sound = scene.sound.model_copy(update={"radiation_model": "compact"})
    changes = {"mounting.fit": FIT, "mounting.preload_mode": "rigid"}
    return prepare(scene.model_copy(update={"sound": sound}).replace(changes))


@pytest.fixture(scope="module")
def masters(tmp_path_factory):
    """A function that makes an instance of a flavour, whose FMU is built once; freed at the end."""
    made = []

    @functools.cache
    def folder(flavour):
        out = tmp_path_factory.mktemp("fits")
        try:
            path = build(model(), out / "fits.fmu", flavour).path
        except BuildError as problem:
            no_native_fmu(problem)
        with zipfile.ZipFile(path) as archive:
            archive.extractall(out / "in")
        return out / "in"

    def instantiate(flavour):
        made.append(Master(folder(flavour)))
        return made[-1]

    yield instantiate
    for one in made:
        one.free()


def prepared(one):
    """Set interferences before initialisation, then temperatures."""
    for name, value in TUNED.items():
        assert one.set(name, value) == OK
    return one.start(shaft_speed=FROM, **WARM)


def test_both_builds_and_the_library_give_the_same_bits(masters):
    native, python = (prepared(masters(flavour)) for flavour in FLAVOURS)
    alone = Instance(model())
    for name, value in {"shaft_speed": FROM, **WARM, **TUNED}.items():
        alone.set(name, value)
    alone.initialise()
    names = [v.name for kind in ("Real", "Integer") for v in model().variables if v.type == kind]
    wanted = {f"fit.{ring}.{name}" for ring in ("inner", "outer") for name in OUTPUTS}
    assert wanted | {"contact.free_angle"} <= set(names)
    first = [alone.get(name) for name in names]
    np.testing.assert_array_equal(native.everything(), first)
    np.testing.assert_array_equal(python.everything(), first)
    taken = run_up(native)
    np.testing.assert_array_equal(taken, run_up(python))
    for i, values in enumerate(taken):
        alone.set("shaft_speed", speed(i))
        alone.set("preload", 500.0 - i)
        alone.step(SIZE)
        np.testing.assert_array_equal(values, [alone.get(name) for name in names])
    # what was set was taken: the ring is 4 K warmer than the shaft, the housing 1 K colder than the ring
    last = dict(zip(names, taken[-1], strict=True))
    warm, cold = 17e-3 * 11.8e-6 * 4.0, 35e-3 * 11.8e-6 * 1.0
    assert last["fit.inner.interference"] == pytest.approx(3.5e-6 - warm, abs=0.3e-6)
    assert last["fit.outer.interference"] == pytest.approx(1.5e-6 + cold, rel=1e-9)
    assert last["fit.inner.pressure"] > 0.0
    assert last["fit.shaft_interference"] == 3.5e-6


@pytest.mark.parametrize("flavour", FLAVOURS)
def test_a_state_within_a_run_up_continues_with_the_same_bits(masters, flavour):
    """Also in an instance of its own, which has the interferences from the state."""
    one, fresh = prepared(masters(flavour)), masters(flavour)
    run_up(one, 0, STEPS // 2)
    state = one.keep()
    data = one.to_bytes(state)
    after = run_up(one, STEPS // 2)
    assert one.put_back(state) == OK
    np.testing.assert_array_equal(run_up(one, STEPS // 2), after)
    status, copy = fresh.from_bytes(data)
    assert status == fresh.put_back(copy) == OK
    np.testing.assert_array_equal(run_up(fresh, STEPS // 2), after)
    assert one.release(state) == fresh.release(copy) == OK
