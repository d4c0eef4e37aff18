"""pytest plugin: ``--fmu``, ``--record-references``, marker ``fmu``, and the fixtures.

Slow imports wait until a fixture is used, because pytest loads this file in every project of the environment.
pytest also rewrites the assert statements of a package with a plugin. Kernels have no assert statements, so
their compiled copies stay valid.
"""

import os
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from fmu_bearing.results.result import Run
    from fmu_bearing.testing.comparison import Tolerance
    from fmu_bearing.testing.plan import Plan

_RECORDED = pytest.StashKey[list[str]]()
_MARK = "fmu(path): FMU (.fmu) or scene (.toml) of this test, beside its file; goes before --fmu"


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the options."""
    group = parser.getgroup("fmu-bearing", "bearing FMUs")
    group.addoption(
        "--fmu",
        metavar="PATH",
        help="FMU (.fmu) that fixture bearing_fmu gives, or scene (.toml) to build one from",
    )
    group.addoption(
        "--record-references",
        action="store_true",
        help="write the references of assert_matches_reference instead of comparing with them",
    )


def pytest_configure(config: pytest.Config) -> None:
    """Declare the marker."""
    config.addinivalue_line("markers", _MARK)
    config.stash[_RECORDED] = []


def pytest_terminal_summary(terminalreporter: Any, config: pytest.Config) -> None:
    """List the references that were written."""
    for line in config.stash[_RECORDED]:
        terminalreporter.write_line(f"reference recorded: {line}", yellow=True)


@pytest.fixture(scope="session")
def fmu_of_scene(tmp_path_factory: pytest.TempPathFactory) -> Callable[[Path], Path]:
    """Build the FMU of a scene, once per session."""
    built: dict[Path, Path] = {}

    def build(scene: Path) -> Path:
        from fmu_bearing.run.build import build_fmu

        if scene not in built:
            built[scene] = build_fmu(scene, tmp_path_factory.mktemp("fmu") / f"{scene.stem}.fmu").path
        return built[scene]

    return build


@pytest.fixture
def bearing_fmu(request: pytest.FixtureRequest, fmu_of_scene: Callable[[Path], Path]) -> Path:
    """Path of the FMU under test: of marker ``fmu``, beside the test's file, or of option ``--fmu``."""
    mark, option = request.node.get_closest_marker("fmu"), request.config.getoption("--fmu")
    if mark is not None:
        path = request.path.parent / mark.args[0]
    elif option is not None:
        path = Path(request.config.invocation_params.dir) / option
    else:
        pytest.fail(
            "which FMU? give --fmu PATH, or mark the test: @pytest.mark.fmu('bearing.fmu')", pytrace=False
        )
    if not path.is_file():
        pytest.fail(f"there is no FMU or scene at {path}", pytrace=False)
    return fmu_of_scene(path) if path.suffix == ".toml" else path


@pytest.fixture(scope="session")
def step_fmu() -> "Callable[[str | os.PathLike[str], Plan], Run]":
    """Return `fmu_bearing.testing.step_fmu`: run an FMU by a plan."""
    from fmu_bearing.testing.plan import step_fmu

    return step_fmu


@pytest.fixture
def assert_matches_reference(request: pytest.FixtureRequest) -> Callable[..., "Run"]:
    """Return a function that compares a run, or an FMU stepped by a plan, with a recorded reference.

    ``assert_matches_reference(fmu, "references/steady.csv", plan, rtol=None, atol=None)`` gives the run back.
    """
    return _Matching(request)


class _Matching:
    """Compares with references, or records them."""

    def __init__(self, request: pytest.FixtureRequest) -> None:
        self.folder = request.path.parent
        self.record = request.config.getoption("--record-references")
        self.recorded = request.config.stash[_RECORDED]

    def __call__(
        self,
        subject: "Run | str | os.PathLike[str]",
        reference: str | os.PathLike[str],
        plan: "Plan | None" = None,
        *,
        rtol: "Tolerance | None" = None,
        atol: "Tolerance | None" = None,
    ) -> "Run":
        """Compare.

        Parameters
        ----------
        subject : Run, path
            A run, or an FMU to step.
        reference : path
            CSV file, beside the test's file unless it is absolute.
        plan : Plan, optional
            How to step an FMU. Without one it is stepped over the reference's times at its start values.
        rtol, atol : float or mapping, optional
            As for `fmu_bearing.testing.compare`.

        Returns
        -------
        Run
        """
        __tracebackhide__ = True
        from fmu_bearing.results.result import ResultError, Run
        from fmu_bearing.testing.comparison import compare, report

        file = self.folder / reference
        if self.record:
            run = self._run(subject, plan, None)
            self.recorded.append(f"{run.save(file)} ({len(run)} points, {len(run.names)} variables)")
            return run
        if not file.is_file():
            pytest.fail(f"there is no reference {file}: record it with --record-references", pytrace=False)
        try:
            wanted = Run.load(file)
            run = self._run(subject, plan, wanted)
            words = report(run, wanted, os.fspath(reference), compare(run, wanted, rtol, atol))
        except (AssertionError, ResultError, ValueError) as problem:
            pytest.fail(str(problem), pytrace=False)
        if words:
            pytest.fail(words, pytrace=False)
        return run

    @staticmethod
    def _run(subject: "Run | str | os.PathLike[str]", plan: "Plan | None", wanted: "Run | None") -> "Run":
        from fmu_bearing.results.result import Run
        from fmu_bearing.testing.plan import Plan, step_fmu

        if isinstance(subject, Run):
            return subject
        if plan is None:
            if wanted is None:
                raise ValueError("a reference is recorded by a plan: give one")
            size = float(wanted.time[-1] - wanted.time[0]) / (len(wanted) - 1)
            plan = Plan(float(wanted.time[-1]), size, outputs=wanted.names)
        return step_fmu(subject, plan)
