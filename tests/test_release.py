"""What a release needs: one version, its changelog, and workflows whose steps are targets of the Makefile."""

import re
import subprocess
import tomllib

import pytest

import fmu_bearing
from tests.conftest import ROOT

pytestmark = pytest.mark.pages

yaml = pytest.importorskip("yaml", reason="PyYAML is not installed: extra docs")

WORKFLOW = ROOT / ".github" / "workflows" / "release.yml"
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
CONTRIBUTING = (ROOT / "CONTRIBUTING.md").read_text("utf-8")
#: Systems of the workflow by the platforms of wheels.
MACHINES = {
    "linux64": "ubuntu-24.04",
    "aarch64-linux": "ubuntu-24.04-arm",
    "win64": "windows-2022",
    "darwin64": "macos-15-intel",
    "aarch64-darwin": "macos-14",
}


@pytest.fixture(scope="module")
def jobs():
    return yaml.safe_load(WORKFLOW.read_text("utf-8"))["jobs"]


def steps(jobs):
    return [step for job in jobs.values() for step in job["steps"]]


def test_the_version_has_one_place():
    version = fmu_bearing.__version__
    assert re.fullmatch(r"\d+\.\d+\.\d+", version)
    assert "version" in PROJECT["dynamic"] and "version" not in PROJECT
    files = (
        "pyproject.toml",
        "CITATION.cff",
        "README.md",
        "Makefile",
        "docs/site/mkdocs.yml",
        "hatch_build.py",
    )
    assert not [name for name in files if version in (ROOT / name).read_text("utf-8")]


def test_the_changelog_begins_with_a_section_of_this_version():
    """Work on the version after it has a section of its own above, without a number."""
    heads = re.findall(r"^## (.+)$", (ROOT / "CHANGELOG.md").read_text("utf-8"), re.MULTILINE)
    versions = [head for head in heads if head != "Unreleased"]
    assert heads.index(versions[0]) <= 1
    assert re.fullmatch(
        rf"{re.escape(fmu_bearing.__version__)} \((not released|\d{{4}}-\d\d-\d\d)\)", versions[0]
    )


def test_classifiers_name_what_was_run_and_nothing_else():
    """The table in CONTRIBUTING.md says what was run, its last two columns how."""
    rows = re.findall(r"^\| ([^|]*) \| ([^|]*) \| ([^|]*) \| ([^|]*) \|$", CONTRIBUTING, re.MULTILINE)
    ran = [(system, pythons) for system, pythons, *how in rows if "run" in how]
    pythons = {one for _, listed in ran for one in re.findall(r"3\.\d+", listed)}
    stated = {
        found[1] for one in PROJECT["classifiers"] if (found := re.fullmatch(r".*Python :: (3\.\d+)", one))
    }
    assert stated == pythons and "3.11" in stated
    assert {system.split(",")[0] for system, _ in ran} == {"Linux"}
    systems = [one for one in PROJECT["classifiers"] if one.startswith("Operating System")]
    assert systems == ["Operating System :: POSIX :: Linux"]


def metadata(address):
    """What hatch_build.py fills in for an address, called without hatchling."""
    source = re.sub(
        r"^from hatchling.*$", "", (ROOT / "hatch_build.py").read_text("utf-8"), flags=re.MULTILINE
    )
    names = {
        "BuildHookInterface": object,
        "MetadataHookInterface": object,
        "__file__": ROOT / "hatch_build.py",
    }
    exec(source, names)
    found = {"version": "1.2.3"}
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("FMU_BEARING_URL", address)
        names["LinksHook"]().update(found)
    return found


def test_links_to_the_project_come_with_an_address():
    assert {"urls", "readme"} <= set(PROJECT["dynamic"])
    readme = (ROOT / "README.md").read_text("utf-8")
    none, some = metadata(""), metadata("https://example.org/a/")
    assert (none["urls"], none["readme"]["text"]) == ({}, readme)
    assert some["urls"] == {
        "Source": "https://example.org/a",
        "Issues": "https://example.org/a/issues",
        "Releases": "https://example.org/a/releases",
    }
    text = some["readme"]["text"]
    assert "](https://example.org/a/raw/v1.2.3/docs/images/spindle.png)" in text
    assert "](https://example.org/a/blob/v1.2.3/docs/learn/preload.md)" in text
    assert not re.findall(r"\]\((?!https://|#)", text)
    assert re.sub(r"https://example\.org/a/(raw|blob)/v1\.2\.3/", "", text) == readme


def test_every_line_to_run_is_a_target_of_the_makefile(jobs):
    lines = [line for step in steps(jobs) for line in step.get("run", "").splitlines()]
    host = yaml.safe_load((ROOT / ".readthedocs.yaml").read_text("utf-8"))
    assert sorted(lines) == ["make docs", "make release-fmus", "make wheel-check", "make wheels"]
    assert host["build"]["commands"] == ["make site PYTHON=python SITE=$READTHEDOCS_OUTPUT/html"]
    for line in (*lines, *host["build"]["commands"]):
        # -n prints what would be done and does nothing
        done = subprocess.run(["make", "-n", *line.split()[1:]], cwd=ROOT, capture_output=True, timeout=600)
        assert done.returncode == 0, (line, done.stderr)


def test_wheels_of_all_platforms_are_tried_and_released(jobs):
    makefile = (ROOT / "Makefile").read_text("utf-8")
    built = re.search(r"^PLATFORMS \?= (.*)$", makefile, re.MULTILINE)[1].split()
    matrix = jobs["try"]["strategy"]["matrix"]
    assert sorted(matrix["machine"]) == sorted(MACHINES[name] for name in built)
    assert matrix["python"][0] == "3.11"  # the oldest that the package asks for
    assert PROJECT["requires-python"] == ">=3.11"
    assert set(jobs["release"]["needs"]) == set(jobs) - {"release"}
    sent, taken = (
        [step["with"]["name"] for step in steps(jobs) if f"{kind}-artifact@" in step.get("uses", "")]
        for kind in ("upload", "download")
    )
    assert set(taken) < set(sent) == {"wheels", "fmus", "site"}
    (files,) = (step["with"]["files"] for step in jobs["release"]["steps"] if "files" in step["with"])
    assert files.split() == ["out/wheels/*.whl", "out/fmus/*.fmu"]


def test_actions_have_a_major_version_and_no_secret_is_asked_for(jobs):
    actions = [step["uses"] for step in steps(jobs) if "uses" in step]
    assert all(re.fullmatch(r"[\w-]+/[\w-]+@v\d+", action) for action in actions)
    assert "secrets" not in WORKFLOW.read_text("utf-8")


def test_what_was_never_run_says_so():
    assert "NEVER RUN" in WORKFLOW.read_text("utf-8")
    assert "Never run" in (ROOT / ".readthedocs.yaml").read_text("utf-8")
    assert "**The workflow was never run**" in CONTRIBUTING
