"""The package's public face: every name is there, is documented, and its example runs."""

import doctest
import importlib
import inspect
import pkgutil
import subprocess
import sys

import pytest

import fmu_bearing
from tests.conftest import ROOT
from tests.vibration_test import known

#: Examples that take seconds, of what has quick tests of its own.
LONG = {"changes", "compare", "identify", "report", "spread", "vibration"}


@pytest.mark.pages
@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=[pytest.mark.heavy] * (name in LONG)) for name in fmu_bearing.__all__]
)
def test_every_public_name_has_an_example_that_runs(name, monkeypatch, tmp_path, request):
    if name == "report":
        request.getfixturevalue("brief")
    if name == "surface":
        known.play(monkeypatch)
    monkeypatch.chdir(tmp_path)
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    thing = getattr(fmu_bearing, name)
    assert inspect.getdoc(thing), name
    finder = doctest.DocTestFinder(recurse=False)
    (test,) = finder.find(thing, name, globs={}, module=False)
    assert test.examples, f"{name} has no example"
    assert not any(doctest.SKIP in example.options for example in test.examples)
    runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE)
    assert runner.run(test).failed == 0


def own_methods(thing):
    """Examples of what a class adds, those inherited from classes of the package included."""
    finder = doctest.DocTestFinder(recurse=True)
    for base in thing.__mro__:
        if base.__module__.startswith("fmu_bearing"):
            yield from (test for test in finder.find(base, base.__name__, globs={}) if "." in test.name)


@pytest.mark.pages
@pytest.mark.parametrize("name", ["Scene", "Run", "Recording", "Bearing"])
def test_examples_of_methods_run(name, monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE)
    for test in own_methods(getattr(fmu_bearing, name)):
        assert runner.run(test).failed == 0, test.name


@pytest.mark.pages
def test_the_map_of_the_package_runs(monkeypatch):
    monkeypatch.chdir(ROOT)
    assert doctest.testmod(fmu_bearing).failed == 0


def test_public_names_are_listed_and_others_refused():
    assert set(fmu_bearing.__all__) <= set(dir(fmu_bearing))
    with pytest.raises(AttributeError, match="public names are Bearing"):
        fmu_bearing.Gear  # noqa: B018


def test_no_module_hides_a_public_name():
    """Importing ``fmu_bearing.x`` sets the attribute ``x`` of the package, whatever ``x`` is to be."""
    names = set(fmu_bearing.__all__)
    assert not names & {module.name for module in pkgutil.iter_modules(fmu_bearing.__path__)}
    for name in names:
        importlib.import_module(f"fmu_bearing.{fmu_bearing._PLACES[name]}")
    modules = {"audio", "measure", "pictures", "tables"}
    assert {name for name in names if inspect.ismodule(getattr(fmu_bearing, name))} == modules
    functions = {name for name in names - modules if name.islower()}
    assert functions >= {"compare", "record", "report", "simulate", "sweep", "with_fidelity"}
    assert all(inspect.isfunction(getattr(fmu_bearing, name)) for name in functions)
    assert all(inspect.isclass(getattr(fmu_bearing, name)) for name in names - modules - functions)


def test_importing_the_package_costs_nothing():
    code = "import sys, fmu_bearing; print(len({'numpy', 'numba', 'scipy', 'pydantic'} & set(sys.modules)))"
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True, cwd=ROOT, timeout=600
    )
    assert done.stdout.strip() == "0"
