"""An option is the same in every command that has it, and every command has the options of its kind."""

import inspect
import re

import pytest
import typer.main

from fmu_bearing.cli import app
from tests.pages import DOCS

RUN = {
    "simulate", "sound", "envelope", "compare", "report", "sweep", "changes", "tradeoff", "sensitivity",
    "identify",
}  # fmt: skip
SCENES = {
    *RUN,
    "build",
    "info",
    "modes",
    "stiffness",
    "receptance",
    "lobes",
    "fits",
    "realtime",
    "choose",
    "vibration",
    "error-motion",
    "dataset",
}
FILES = {"scene new", "scene check", "scene show", "scene catalogue"}
WRITE = {
    "scene new", "build", "simulate", "plot", "sound", "envelope", "compare", "report", "stiffness",
    "modes", "tradeoff", "sensitivity", "sweep", "identify", "realtime", "fits", "vibration",
    "error-motion", "dataset", "receptance", "lobes",
}  # fmt: skip
#: Commands by the option that they have; the page has the same lists, with the reasons.
HAVE = {
    "--set": SCENES,
    "--speed": {*RUN, "info", "modes", "fits", "realtime", "choose", "scene new", "vibration"}
    - {"sweep", "identify"},
    "--fidelity": {*RUN, "build", "realtime", "vibration", "error-motion", "dataset"}
    - {"tradeoff", "sensitivity"},
    "--radiation-model": {"sound", "envelope", "compare", "report", "changes"},
    "--settle": RUN - {"changes"},
    "--plot": {
        "simulate",
        "sound",
        "envelope",
        "compare",
        "modes",
        "stiffness",
        "receptance",
        "lobes",
        "fits",
        "tradeoff",
        "sensitivity",
        "sweep",
        "identify",
        "error-motion",
    },
    "--output": WRITE - {"scene new"},
    "--force": WRITE,
    "--quick": {"tradeoff", "sensitivity"},
    "--json": {*SCENES, *FILES, "validate"},
    "--catalogue": {*SCENES, *FILES, "plot"},
}
#: Where a default or a meaning is another one, with the words of its help that give the reason.
OTHERWISE = {
    ("simulate", "--settle"): "default 0: a result begins with the steady state it starts from",
    ("sweep", "--settle"): "a map has many points",
    ("identify", "--settle"): "hundreds of short runs",
    ("tradeoff", "--settle"): "the reference takes most of the time",
    ("sensitivity", "--settle"): "for some fifty short runs",
    ("scene new", "--speed"): "default: half of the limit",
    ("identify", "--fidelity"): "for hundreds of runs",
    ("realtime", "--fidelity"): "default: all that the scene allows",
    ("identify", "--duration"): "there are hundreds",
    ("identify", "--seeds"): "for hundreds of runs",
    ("identify", "--workers"): "each run keeps a core busy",
    ("sweep", "--workers"): "one per core",
    ("sweep", "--variables"): "statistics",
    ("sensitivity", "--variables"): "statistics",
    ("sensitivity", "--workers"): "one per core",
    ("sensitivity", "--window"): "0.1 with --method",
    ("plot", "--scene"): "a result in .nc knows it",
    ("sound", "--scene"): "With a result",
    ("envelope", "--scene"): "for its lines",
    ("sound", "--microphone"): "Only these",
    ("compare", "--microphone"): "the loudest of A",
    ("modes", "--speeds"): "Campbell diagram",
    ("stiffness", "--speeds"): "default: the scene's",
    ("build", "--platforms"): "default: this machine's",
    ("sound", "--at"): "What makes the noise",
    ("receptance", "--at"): "or tip of the scene's",
    ("receptance", "--speeds"): "default: the scene's",
    ("lobes", "--speeds"): "a quarter to 1.25 of the scene's",
    ("lobes", "--frequencies"): "Hz of chatter",
    ("receptance", "--frequencies"): "default: 20:5000:2491",
    ("error-motion", "--at"): "Place of the point",
    ("error-motion", "--speeds"): "default: the scene's",
    ("vibration", "--speed"): "default: by the outside diameter",
    ("vibration", "--seeds"): "the first one the scene's own",
    ("vibration", "--kind"): "of a bearing by name",
    ("vibration", "--grade"): "default: the scene's own",
    ("warm-up", "--platforms"): "Also link",
    ("report", "--run-up"): "for the waterfall",
    ("realtime", "--run-up"): "Speeds of the run-up",
}


def commands(group=None, path=()):
    """Every command by its words."""
    for name, command in (group or typer.main.get_command(app)).commands.items():
        if hasattr(command, "commands"):
            yield from commands(command, (*path, name))
        else:
            yield " ".join((*path, name)), command


def options():
    """Options by their long name: the command and the option."""
    found = {}
    for name, command in commands():
        for one in command.params:
            if one.param_type_name == "option":
                long = next(word for word in one.opts if word.startswith("--"))
                found.setdefault(long, {})[name] = one
    return found


def form(option):
    """What is equal where an option has one meaning."""
    shape = (
        tuple(option.opts),
        tuple(option.secondary_opts),
        option.multiple,
        option.is_flag,
        option.required,
    )
    return *shape, option.default, option.help, option.metavar


OPTIONS = options()


@pytest.mark.parametrize("name", HAVE)
def test_every_command_of_its_kind_has_it(name):
    assert set(OPTIONS[name]) == HAVE[name]


@pytest.mark.parametrize("name", sorted(name for name, found in OPTIONS.items() if len(found) > 1))
def test_an_option_is_the_same_everywhere_or_says_why_not(name):
    found = OPTIONS[name]
    assert len({tuple(one.opts) for one in found.values()}) == 1  # the short name, too
    plain = {command: one for command, one in found.items() if (command, name) not in OTHERWISE}
    if name == "--output":  # what is written has its own name and words
        assert {one.metavar for one in found.values()} == {"FILE", "FOLDER"}
    else:
        assert len({form(one) for one in plain.values()}) <= 1, {c: form(one) for c, one in plain.items()}


@pytest.mark.parametrize(("command", "name"), OTHERWISE)
def test_another_default_or_meaning_has_its_reason_in_the_help(command, name):
    assert OTHERWISE[command, name] in OPTIONS[name][command].help


def test_settle_and_duration_of_what_is_measured_are_the_librarys():
    from fmu_bearing.recording.record import DURATION
    from fmu_bearing.recording.studies.compare import SETTLE
    from fmu_bearing.recording.studies.finding import SEEDS
    from fmu_bearing.reports import make

    for command in ("sound", "compare", "report"):
        assert (OPTIONS["--settle"][command].default, OPTIONS["--duration"][command].default) == (
            SETTLE,
            DURATION,
        )
    made = inspect.signature(make).parameters
    assert (made["settle"].default, made["duration"].default) == (SETTLE, DURATION)
    assert OPTIONS["--seeds"]["compare"].default == SEEDS


@pytest.mark.pages
@pytest.mark.parametrize("name", ["--speed", "--fidelity", "--radiation-model", "--settle", "--plot"])
def test_the_page_lists_the_commands(name):
    text = (DOCS / "cli.md").read_text("utf-8")
    (row,) = [line for line in text.splitlines() if line.startswith(f"| `{name} ")]
    assert set(re.findall(r"`([a-z -]+)`", row.split("|")[3])) == HAVE[name]


@pytest.mark.parametrize("name", [name for name, _ in commands()])
def test_help_shows_every_word_in_square_brackets(name, run):
    """Rich takes words such as [tool] as markup and leaves them out, unless they are escaped."""
    command = dict(commands())[name]
    shown = re.sub(r"[\s│]", "", run(*name.split(), "--help").stdout)
    text = inspect.getdoc(command.callback)
    assert re.sub(r"\s", "", text) in shown
    of_options = " ".join(one.help or "" for one in command.params).replace("\\", "")
    for word in re.findall(r"\[[^\]]*\]", of_options):
        assert re.sub(r"\s", "", word) in shown


def test_list_of_commands_shows_words_in_square_brackets(run):
    assert "the scene's [milling] may cut" in run("--help").stdout
