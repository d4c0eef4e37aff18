"""Reports for the tests: one of fidelity full, one of fidelity rings, each made once."""

from typing import NamedTuple

import pytest

from fmu_bearing.accuracy import changes as room
from fmu_bearing.accuracy.changed import Changes
from fmu_bearing.reports import make
from fmu_bearing.reports.data.observed_run import observed
from fmu_bearing.reports.make import Report
from fmu_bearing.reports.modes import modes_section
from fmu_bearing.reports.sections import what_to_change
from fmu_bearing.scene import Scene
from fmu_bearing.scene.read import with_fidelity
from tests.conftest import SHARES
from tests.reports.reading import Page

SECONDS = 0.1
#: Choices of a page's study; all of them are run in tests/accuracy/test_changes.py.
TOPICS = ("preload", "balls", "speed")


class Whole(NamedTuple):
    """A report with all sections, and its study of changes with what that was asked."""

    report: Report
    scene: Scene
    options: dict
    found: Changes


@pytest.fixture(scope="session")
def full(scene):
    """Recording of the bare 7003C with all that a report shows; cage and balls move."""
    return observed(scene("7003C-bare"), SECONDS, settle=0.02)[0]


@pytest.fixture(scope="session")
def whole(full, tmp_path_factory):
    """The report of `full` with few choices and speeds."""
    studies, every = [], room.alternatives

    def few(scene):
        return [one for one in every(scene) if one.topic in TOPICS]

    def noted(scene, **options):
        studies.append((scene, options, room.changes(scene, **options)))
        return studies[-1][-1]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(modes_section, "_SHARES", SHARES)
        patch.setattr(room, "alternatives", few)
        patch.setattr(what_to_change, "changes", noted)
        report = make(full, tmp_path_factory.mktemp("report") / "full.html")
    (study,) = studies
    return Whole(report, *study)


@pytest.fixture(scope="session")
def full_report(whole):
    return whole.report


@pytest.fixture(scope="session")
def full_page(full_report):
    return Page(full_report.path)


@pytest.fixture(scope="session")
def rings(scene):
    """Recording of the 7003C in its spindle, the rings alone."""
    return observed(with_fidelity(scene("7003C-spindle"), model="rings"), SECONDS, settle=0.02)[0]
