"""The core works without the optional packages, and whatever needs one names the extra that brings it."""

import ast
import functools
import json
import re
import subprocess
import sys
import tomllib
from importlib import metadata

import pytest

from fmu_bearing.extras import EXTRAS
from tests.conftest import GATES, ROOT

PYPROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
DEFINED = PYPROJECT["project"]["optional-dependencies"]
#: Extras of those who work on the project; all others are the user's.
OURS = {"all", "test", "docs", "bench"}
#: Loaded by pytest alone, which is then installed.
PLUGIN = ROOT / "fmu_bearing" / "testing" / "plugin.py"
FILES = sorted((ROOT / "fmu_bearing").rglob("*.py"))

#: Command lines and Python that need a package. Where two are missing the first is named, so that those
#: which come second (h5netcdf, jinja2, distributed) are asked for in Python.
USES = {
    "skfem": [
        ["simulate", "bending.toml"],
        ["build", "bending.toml"],
        ["scene", "check", "bending.toml"],
        ["choose", "bending.toml"],
        ["sensitivity", "bending.toml"],
        "fmu_bearing.Bearing('bending.toml')",
        "fmu_bearing.record(fmu_bearing.read_scene('bending.toml'), 0.1)",
        "import_module('fmu_bearing.sweeps.plan').plan('bending.toml', {'preload': [200.0, 300.0]})",
    ],
    "matplotlib": [
        ["plot", "run.csv"],
        ["compare", "rigid.toml", "rigid.toml", "--plot", "both.png"],
        ["tradeoff", "rigid.toml"],
        "fmu_bearing.pictures.third_octave_picture([500.0, 1000.0], {'total': [60.0, 70.0]})",
        "import_module('fmu_bearing.accuracy.chart').draw(None, None)",
        "fmu_bearing.Run.load('run.csv').plot()",
        "import_module('fmu_bearing.fmi.icon').draw_icon('model.png')",
    ],
    "xarray": [
        ["simulate", "rigid.toml", "-o", "run.nc"],
        ["plot", "run.nc"],
        ["sweep", "rigid.toml", "--axis", "preload=200,500"],
        "fmu_bearing.Run.load('run.csv').to_xarray()",
        "fmu_bearing.Run.load('run.csv').save('run.nc')",
        "fmu_bearing.sweep('rigid.toml', {'preload': [200, 500]})",
    ],
    "pandas": [
        "fmu_bearing.Run.load('run.csv').to_pandas()",
    ],
    "h5netcdf": ["import_module('fmu_bearing.sweeps').save(None, 'out')"],
    "plotly": [["report", "rigid.toml"], "fmu_bearing.report('rigid.toml', 'report.html')"],
    "jinja2": ["import_module('fmu_bearing.reports.page.render').render('', '', '', [], [], [], [])"],
    "distributed": ["next(import_module('fmu_bearing.sweeps.cluster').cluster([], 'tcp://host:8786'))"],
    "fmu_manipulation_toolbox": [
        # validate goes on without this check: its result says why
        "print(import_module('fmu_bearing.validation.tools').fmutool('any.fmu'))"
    ],
    "mosqito": ["fmu_bearing.measure.sensation([0.0], 48000.0)"],
    "SALib": [
        [
            "sensitivity",
            "rigid.toml",
            "--method",
            "morris",
            "--vary",
            "preload=100..200",
            "--vary",
            "speed=1000..2000",
        ],
        "fmu_bearing.global_sensitivity('rigid.toml', {'preload': (100, 200), 'speed': (1000, 2000)})",
    ],
    "ziglang": [["build", "rigid.toml", "--platforms", "OTHER"]],
}

#: Commands that work with the core alone.
CORE = [
    ["--help"],
    ["scene", "new", "new.toml", "--bearing", "7003C", "--speed", "20000", "--preload", "300"],
    ["scene", "show", "new.toml", "--assumed"],
    ["scene", "show", "bending.toml"],
    ["scene", "catalogue"],
]

#: Begins a process that finds none of the optional packages; what is asked comes as JSON.
HIDDEN = '''
import json, sys

asked = json.loads(sys.argv[1])

class Without:
    """A finder that does not find the optional packages."""
    def __init__(self, finder):
        self.finder = finder
    def __getattr__(self, name):
        return getattr(self.finder, name)
    def find_spec(self, name, path=None, target=None):
        absent = name.partition(".")[0] in asked["absent"]
        return None if absent else self.finder.find_spec(name, path, target)

sys.meta_path[:] = [Without(finder) for finder in sys.meta_path]
'''

#: Prints what came of each line.
SCRIPT = (
    HIDDEN
    + """
import contextlib, io, pathlib, pkgutil
from importlib import import_module
import fmu_bearing

for name in fmu_bearing.__all__:
    getattr(fmu_bearing, name)
for module in pkgutil.walk_packages(fmu_bearing.__path__, "fmu_bearing."):
    if module.name not in asked["left"] and not module.name.endswith("__main__"):
        import_module(module.name)

from typer.testing import CliRunner
from fmu_bearing import cli, extras
from fmu_bearing.fmi.native import link
from fmu_bearing.compiled.platforms import PLATFORMS, host

# a library that was made before needs no compiler
link.folder = lambda: pathlib.Path("no libraries kept")
other = next(name for name in PLATFORMS if PLATFORMS[name] != host())

def command(line):
    done = CliRunner().invoke(cli.app, [other if word == "OTHER" else word for word in line])
    strange = done.exception is not None and not isinstance(done.exception, SystemExit)
    return done.exit_code, repr(done.exception) if strange else "", done.output

def python(text):
    said = io.StringIO()
    try:
        with contextlib.redirect_stdout(said):
            exec(text)
        return 0, "", said.getvalue()
    except extras.MissingExtra as missing:
        return 2, "", f"error: {missing}"
    except Exception as strange:
        return 1, repr(strange), ""

results = [command(line) if isinstance(line, list) else python(line) for line in asked["lines"]]
print(json.dumps(results))
"""
)


@pytest.fixture(scope="module")
def reported(tmp_path_factory):
    """Exit code, unexpected exception and output of each line of `CORE` and `USES`, without any extra."""
    folder = tmp_path_factory.mktemp("core")
    silent = re.sub(
        r"^\[sound\].*?(?=^\[(?!\[?sound)|\Z)",
        "",
        (GATES / "7009C-steel.toml").read_text("utf-8"),
        flags=re.MULTILINE | re.DOTALL,
    )
    (folder / "bending.toml").write_text(silent, "utf-8")
    rigid = re.sub(r"^\[mounting\.flexure\].*?(?=^\[|\Z)", "", silent, flags=re.MULTILINE | re.DOTALL)
    (folder / "rigid.toml").write_text(rigid, "utf-8")
    (folder / "run.csv").write_text("time,friction_torque\n0.0,0.01\n0.001,0.02\n", "utf-8")
    (folder / "run.nc").touch()
    lines = [*CORE, *(line for uses in USES.values() for line in uses)]
    asked = {"absent": list(EXTRAS), "left": ["fmu_bearing.testing.plugin"], "lines": lines}
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT, json.dumps(asked)],
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=600,
    )
    assert done.returncode == 0, done.stderr
    results = json.loads(done.stdout.splitlines()[-1])
    return {json.dumps(line): result for line, result in zip(lines, results, strict=True)}


@pytest.mark.parametrize("line", CORE, ids=" ".join)
def test_the_core_alone_does(reported, line):
    code, strange, output = reported[json.dumps(line)]
    assert (code, strange) == (0, ""), output


@pytest.mark.parametrize("package", EXTRAS)
def test_whatever_needs_a_package_names_its_extra(reported, package):
    assert package in USES, "no line here needs it"
    for line in USES[package]:
        code, strange, output = reported[json.dumps(line)]
        assert not strange, line
        assert f"pip install 'fmu-bearing[{EXTRAS[package]}]'" in output, line
        assert f"needs the package {package}:" in output, line
        goes_on = package == "fmu_manipulation_toolbox"
        assert code == (0 if goes_on else 2), line
        assert goes_on or sum(text.startswith("error: ") for text in output.splitlines()) == 1, line


#: Scripts that draw or sweep. They refuse before they compute, for some take minutes.
SCRIPTS = [
    "directivity/directivity.py", "gallery/gallery.py", "impact/contact_conditions.py",
    "impact/three_balls.py", "run_up/run_up.py",
    "spindle_cosimulation/adaptive.py", "spindle_cosimulation/cosimulate.py",
    "spindle_cosimulation/stability.py", "spindle_set/cosimulate.py",
    "spindle_set/run_up.py", "sweep/critical_speed.py", "tolerance_study/tolerance.py",
    "papers/run.py",
]  # fmt: skip

#: Runs such scripts one after the other, each in a folder of its own and with none of another's modules, and
#: prints what came of each.
ALONE = (
    HIDDEN
    + """
import contextlib, io, os, pathlib, runpy

examples = pathlib.Path(asked["root"], "examples")

def alone(script):
    script, folder = examples / script, pathlib.Path(script.replace("/", "-"))
    folder.mkdir()
    before, loaded, said = list(sys.path), set(sys.modules), io.StringIO()
    sys.path[:0] = [str(script.parent), asked["root"]]
    sys.argv = [str(script)]
    os.chdir(folder)
    try:
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
            runpy.run_path(str(script), run_name="__main__")
        code = 0
    except SystemExit as ended:
        code = ended.code
    finally:
        os.chdir("..")
        sys.path[:] = before
        for name in set(sys.modules) - loaded:
            if str(examples) in str(getattr(sys.modules[name], "__file__", "")):
                del sys.modules[name]
    return code, said.getvalue(), os.listdir(folder)

print(json.dumps({script: alone(script) for script in asked["scripts"]}))
"""
)


@pytest.fixture(scope="module")
def refused(tmp_path_factory):
    """Exit code, words and files left of each script, without any extra."""
    asked = {"absent": list(EXTRAS), "root": str(ROOT), "scripts": SCRIPTS}
    done = subprocess.run(
        [sys.executable, "-c", ALONE, json.dumps(asked)],
        cwd=tmp_path_factory.mktemp("alone"),
        capture_output=True,
        text=True,
        timeout=600,
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout.splitlines()[-1])


@pytest.mark.heavy
@pytest.mark.parametrize("script", SCRIPTS)
def test_an_example_names_the_extra_that_it_needs(refused, script):
    code, words, left = refused[script]
    package = "xarray" if script.startswith("sweep") else "matplotlib"
    assert code == 2, words
    assert f"needs the package {package}: pip install 'fmu-bearing[{EXTRAS[package]}]'" in words
    assert "Traceback" not in words
    assert left == []


@pytest.mark.lint
def test_examples_import_no_extra_by_a_statement():
    wrong = [
        f"{path.name}: {package}"
        for path in sorted((ROOT / "examples").rglob("*.py"))
        for package, unread in imports(path)
        if package in EXTRAS and not unread
    ]
    assert not wrong


@functools.cache
def nodes(path):
    """All nodes of a file's syntax tree."""
    return list(ast.walk(ast.parse(path.read_text(encoding="utf-8"))))


def imports(path):
    """Root of each absolute import of a file, and whether it is for type checkers alone."""
    unread = {
        inner
        for node in nodes(path)
        if isinstance(node, ast.If) and isinstance(node.test, ast.Name) and node.test.id == "TYPE_CHECKING"
        for inner in ast.walk(node)
    }
    for node in nodes(path):
        if isinstance(node, ast.Import):
            yield from ((alias.name.split(".")[0], node in unread) for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            yield node.module.split(".")[0], node in unread


def plain(requirement):
    """Name of a requirement, in the spelling that makes names equal."""
    return re.match(r"[\w.-]+", requirement)[0].lower().replace("_", "-")


@functools.cache  # reads the metadata of all that is installed
def brings():
    return metadata.packages_distributions()


def distributions(package):
    """Distributions that bring a package."""
    return {plain(name) for name in brings().get(package, ())}


@pytest.mark.lint
def test_imports_are_of_the_core_or_of_an_extra():
    core = {plain(line) for line in PYPROJECT["project"]["dependencies"]}
    # numba brings llvmlite and pydantic its own core: they come with what is asked for, of their version
    brought = core | {plain(line) for name in core for line in metadata.requires(name) or ()}
    wrong = []
    for path in FILES:
        for package, unread in imports(path):
            if package in sys.stdlib_module_names or package == "fmu_bearing":
                continue
            if package in EXTRAS and unread or path == PLUGIN and package == "pytest":
                continue
            if package in EXTRAS:
                wrong.append(f"{path.name}: {package}: an extra is imported by extras.need")
            elif not distributions(package) & brought:
                wrong.append(f"{path.name}: {package} is neither of the core nor in EXTRAS")
    assert not wrong


@pytest.mark.lint
def test_what_is_asked_for_by_need_is_in_the_table():
    asked = set()
    for path in FILES:
        for node in nodes(path):
            name = getattr(getattr(node, "func", None), "id", None)
            if name in ("need", "available", "install_command") and path.name != "extras.py":
                assert isinstance(node.args[0], ast.Constant), f"{path.name}:{node.lineno}"
                asked.add(node.args[0].value.split(".")[0])
    assert asked == set(EXTRAS)


@pytest.mark.lint
@pytest.mark.parametrize("package", EXTRAS)
def test_an_extra_installs_its_package(package):
    names = {plain(line) for line in DEFINED[EXTRAS[package]]}
    assert names & distributions(package), f"{EXTRAS[package]} installs {names}"


def test_all_contains_every_extra_of_a_user():
    (line,) = DEFINED["all"]
    contained = set(re.fullmatch(r"fmu-bearing\[(.*)\]", line)[1].split(","))
    assert contained == set(EXTRAS.values()) == set(DEFINED) - OURS


def test_every_requirement_has_its_version_in_the_constraints():
    text = (ROOT / "constraints.txt").read_text(encoding="utf-8")
    locked = {plain(line) for line in text.splitlines() if not line.startswith("#")}
    lines = PYPROJECT["project"]["dependencies"] + [line for extra in DEFINED.values() for line in extra]
    assert {plain(line) for line in lines} - {"fmu-bearing"} <= locked


@pytest.mark.pages
def test_the_documentation_has_a_row_for_each_extra():
    page = (ROOT / "docs" / "quick-start.md").read_text(encoding="utf-8")
    rows = dict(re.findall(r"^\| `(\w+)` \| ([^|]*) \|", page, flags=re.MULTILINE))
    assert set(rows) == set(DEFINED) - OURS
    for extra, brings in rows.items():
        assert {plain(name) for name in brings.split(", ")} == {plain(line) for line in DEFINED[extra]}, extra
