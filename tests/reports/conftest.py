"""Reports for the tests: one of fidelity full, one of fidelity rings, each made once."""

import pytest

from fmu_bearing.reports import make
from fmu_bearing.reports.data.observed_run import observed
from fmu_bearing.scene.read import with_fidelity
from tests.reports.reading import Page

SECONDS = 0.1


@pytest.fixture(scope="session")
def full(scene):
    """Recording of the bare 7003C with all that a report shows; cage and balls move."""
    return observed(scene("7003C-bare"), SECONDS, settle=0.02)[0]


@pytest.fixture(scope="session")
def full_report(full, tmp_path_factory):
    return make(full, tmp_path_factory.mktemp("report") / "full.html")


@pytest.fixture(scope="session")
def full_page(full_report):
    return Page(full_report.path)


@pytest.fixture(scope="session")
def rings(scene):
    """Recording of the 7003C in its spindle, the rings alone."""
    return observed(with_fidelity(scene("7003C-spindle"), model="rings"), SECONDS, settle=0.02)[0]
