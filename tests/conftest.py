"""Shared by all tests: the gate scenes, which are frozen, and the example scenes, which may become better."""

import importlib
import os
import pathlib
import signal

import hypothesis
import pytest

from fmu_bearing.files import cache_root, own_folder

# Kernels that tests call one by one are compiled once, not by each worker and each run.
os.environ.setdefault("FMU_BEARING_KEEP_KERNELS", str(own_folder(cache_root() / "kernels")))

# Numba colours the messages of all the overloads that it tries and drops: a tenth of what compiling takes.
os.environ.setdefault("NUMBA_DISABLE_ERROR_MESSAGE_HIGHLIGHTING", "1")

# Workers share the processors, where threads of linear algebra wait for each other: half as long again.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

# A shell's background job ignores Ctrl-C, and so would every process that a test starts and interrupts.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)

# A test draws the same numbers each time and everywhere, and no clock fails it. `make heavy` draws more,
# `make soak` others.
_FIXED = {"derandomize": True, "deadline": None, "database": None}
hypothesis.settings.register_profile("fixed", max_examples=30, **_FIXED)
hypothesis.settings.register_profile("many", **_FIXED)
hypothesis.settings.register_profile("soak", derandomize=False, deadline=None, print_blob=True)
hypothesis.settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "fixed"))

ROOT = pathlib.Path(__file__).parents[1]
#: Gates of all kinds run on these: every value is written out, so that a better default moves no gate.
GATES = ROOT / "tests" / "scenes" / "gates"
SHARES = (0.9, 1.0, 1.1)  # of the speed: a diagram of modes needs no more to be one
HEAVY_TIMEOUT = 3000  # s: one of them compiles the plain way, some minutes of two processors
#: For tests of the examples themselves, of the documentation and of the catalogue.
EXAMPLES = ROOT / "examples" / "scenes"
#: What the examples' oil has beside the catalogue's, so that the papers' results stay.
OWN_OIL = {
    "supply": "oil-air",
    "rolling_law": "houpert-1987-ehl",
    "replenishment_constant": 6e-8,
    "traction_max": 0.05,
    "land_viscosity_Pa_s": 0.006,
}


def pytest_collection_modifyitems(items):
    """Give those of minutes more time."""
    for item in items:
        if _slow(item) and not item.get_closest_marker("timeout"):
            item.add_marker(pytest.mark.timeout(HEAVY_TIMEOUT))


class Skips:
    """Skipped tests with their reasons, held against a list of those that may be skipped.

    The list has lines ``NODE: REASON``: what the test's name begins with, and a part of the reason.
    """

    def __init__(self, file):
        lines = (line for line in file.read_text(encoding="utf-8").splitlines() if line and line[0] != "#")
        self.allowed = [tuple(part.strip() for part in line.split(": ", 1)) for line in lines]
        self.found, self.unexpected = 0, []

    def pytest_runtest_logreport(self, report):
        """Note a skip; expected failures are none."""
        if report.skipped and not hasattr(report, "wasxfail"):
            reason = report.longrepr[2] if isinstance(report.longrepr, tuple) else str(report.longrepr)
            self.note(report.nodeid, reason)

    def pytest_collectreport(self, report):
        """Note a file that is skipped as a whole."""
        if report.skipped:
            self.note(report.nodeid, report.longrepr[2])

    def note(self, node, reason):
        """Hold one skip against the list."""
        self.found += 1
        if not any(node.startswith(begin) and words in reason for begin, words in self.allowed):
            self.unexpected.append(f"{node}: {reason}")

    def pytest_sessionfinish(self, session):
        """Fail a run that has skips nobody expects."""
        if self.unexpected and session.exitstatus == 0:
            session.exitstatus = pytest.ExitCode.TESTS_FAILED

    def pytest_terminal_summary(self, terminalreporter):
        """Name the skips that nobody expects."""
        for one in sorted(set(self.unexpected)):
            terminalreporter.write_line(f"SKIPPED, and not on the list: {one}", red=True)


def pytest_addoption(parser):
    """Add the list of tests that may be skipped, and the times that tests took."""
    parser.addoption("--skips", metavar="FILE", help="fail where a test is skipped that FILE does not list")
    parser.addoption("--times", metavar="FILE", help="run the longest tests first, by the seconds in FILE")
    parser.addoption(
        "--measure-times", action="store_true", help="write what was measured into the file of --times"
    )


def pytest_configure(config):
    """Watch skips in the process that reports them; sort tests in every process."""
    if config.getoption("--skips") and not hasattr(config, "workerinput"):
        config.pluginmanager.register(Skips(pathlib.Path(config.getoption("--skips"))), "skips")
    if config.getoption("--times"):
        from tests.order import Order

        times = pathlib.Path(config.getoption("--times"))
        worker = getattr(config, "workerinput", {}).get("workerid", "gw0")
        config.pluginmanager.register(
            Order(times, config.getoption("--measure-times"), config.rootpath, worker), "order"
        )


def _slow(item):
    return item.get_closest_marker("heavy") or item.get_closest_marker("bits")


@pytest.fixture(scope="session", autouse=True)
def _native_fmus_for_this_processor(request):
    """In a run without heavy tests, libraries of FMUs hold the newest instruction set alone.

    The older one takes half a minute to compile; heavy tests and those of bits run both.
    """
    from fmu_bearing.compiled.platforms import PLATFORMS, host, narrowed

    with pytest.MonkeyPatch.context() as patch:
        if host() is not None and not any(map(_slow, request.session.items)):
            patch.setitem(PLATFORMS, host().name, narrowed(host()))
        yield


def _compact(folder):
    """Return a function that reads a scene of a folder by name, with compact sound.

    Boundary elements take up to a minute per geometry; radiation model bem has tests of its own.
    """
    from fmu_bearing.scene import read_scene

    def read(name):
        found = read_scene(folder / f"{name}.toml")
        return found.model_copy(
            update={"sound": found.sound.model_copy(update={"radiation_model": "compact"})}
        )

    return read


def _compact_file(folder, target):
    """Write the spindle scene of a folder with compact sound: its housing takes bem over a minute."""
    text = (folder / "7003C-spindle.toml").read_text(encoding="utf-8")
    file = target / "7003C-spindle.toml"
    file.write_text(text.replace('radiation_model = "bem"', 'radiation_model = "compact"'), encoding="utf-8")
    return file


@pytest.fixture(scope="session")
def scene():
    """Read a gate scene by name, with compact sound."""
    return _compact(GATES)


@pytest.fixture(scope="session")
def example():
    """Read an example scene by name, with compact sound."""
    return _compact(EXAMPLES)


@pytest.fixture(scope="session")
def scene_file(tmp_path_factory):
    """File of the gate scene of the spindle, with compact sound."""
    return _compact_file(GATES, tmp_path_factory.mktemp("scene"))


@pytest.fixture(scope="session")
def example_file(tmp_path_factory):
    """File of the default scene, an example, with compact sound."""
    return _compact_file(EXAMPLES, tmp_path_factory.mktemp("example"))


@pytest.fixture(scope="session")
def silent(scene):
    """The 7003C in its spindle without microphones."""
    return scene("7003C-spindle").model_copy(update={"sound": None})


@pytest.fixture
def brief(monkeypatch):
    """Reports with three speeds of their modes and without draws of other seeds.

    The page of `full` (tests/reports/conftest.py) has draws; the modes' own tests have all speeds.
    """
    from fmu_bearing.reports.modes import modes_section

    monkeypatch.setattr(modes_section, "_SHARES", SHARES)
    monkeypatch.setattr(importlib.import_module("fmu_bearing.reports.make"), "_spread", lambda *given: None)
