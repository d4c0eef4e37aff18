"""What a scene cannot have: which scenes, what, why, and the way out. One table for all such refusals.

It holds what a kind of scenes cannot have whatever their other values are. Values that are missing, or too
large beside others, are conflicts of their own tables.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Literal

from fmu_bearing.scene.base import Conflict, SceneError
from fmu_bearing.scene.member import set_of
from fmu_bearing.scene.mounting import SUPPORTS
from fmu_bearing.scene.scene import Tables
from fmu_bearing.scene.shaft import Shaft
from fmu_bearing.scene.spindle import Load

#: What can be asked of a scene, or given in its file, and is not to be had of every scene.
Subject = Literal[
    "against",
    "changes",
    "channels",
    "comparison",
    "error motion",
    "fidelities",
    "fits",
    "housing",
    "identification",
    "load",
    "measurement",
    "modes",
    "plane",
    "receptance",
    "recording",
    "report",
    "response",
    "sensitivity",
    "shaft",
    "short runs",
    "statics",
    "temperatures",
    "tool",
    "tradeoff",
    "unbalance",
    "vibration test",
]
Keys = Iterator[str]


@dataclass(frozen=True)
class Kind:
    """A kind of scenes: what they are called, and whether a scene is one of them."""

    name: str
    holds: Callable[[Tables], bool]


def _nothing(tables: Tables) -> Keys:
    yield from ()


@dataclass(frozen=True)
class Exclusion:
    """What a kind of scenes cannot have.

    Attributes
    ----------
    kind : Kind
    what : mapping
        Words for each subject.
    reason, way_out : str
        In words; code in them is in backquotes, as on a page.
    given : callable
        Yields the dotted keys at which the file of a scene asks for it; none where a call or a command does.
    """

    kind: Kind
    what: Mapping[Subject, str]
    reason: str
    way_out: str
    given: Callable[[Tables], Keys] = _nothing

    def words(self, subject: Subject | None = None) -> str:
        """Return what cannot be had, a subject or all, with the reason and the way out."""
        what = self.all if subject is None else self.what[subject]
        return f"cannot have {what}: {self.reason}; {self.way_out}"

    @property
    def all(self) -> str:
        """All that cannot be had, as a list in words."""
        *first, last = self.what.values()
        return f"{', '.join(first)} or {last}" if first else last


def _unbalance(tables: Tables) -> Keys:
    if tables.imperfections is not None and tables.imperfections.unbalance_um > 0.0:
        yield "imperfections.unbalance_um"


def _baffle(tables: Tables) -> Keys:
    if tables.sound is not None and tables.sound.radiator == "baffle":
        yield "sound.radiator"


def _housing(tables: Tables) -> Keys:
    if tables.sound is not None and tables.sound.radiator == "housing":
        yield "sound.radiator"


def _plane(tables: Tables) -> Keys:
    yield from _baffle(tables)
    if tables.sound is not None and tables.sound.reflecting_plane_mm is not None:
        yield "sound.reflecting_plane_mm"


def _fidelities(tables: Tables) -> Keys:
    if tables.fidelity.model in ("rings", "response"):
        yield "fidelity.model"


def _response(tables: Tables) -> Keys:
    if tables.fidelity.model == "response":
        yield "fidelity.model"


def _load(tables: Tables) -> Keys:
    if set_of(tables).load != Load():
        yield "spindle.load"


def _shaft(tables: Tables) -> Keys:
    for key in ("sections_mm", "flexible", "fixed_modes", "damping_ratio", "unbalance"):
        if getattr(set_of(tables).shaft, key) != Shaft.model_fields[key].default:
            yield f"spindle.shaft.{key}"
    for key in SUPPORTS:
        if getattr(set_of(tables), key) is not None:
            yield f"spindle.{key}"


def _tool(tables: Tables) -> Keys:
    for key in ("tool", "milling"):
        if getattr(tables, key) is not None:
            yield key


def _model(tables: Tables) -> str:
    return "" if tables.sound is None else tables.sound.radiation_model


def _is_set(tables: Tables) -> bool:
    return tables.spindle is not None


def _sounds(tables: Tables) -> bool:
    return _is_set(tables) and tables.sound is not None


_SET = Kind("a set of bearings (`[spindle]`)", _is_set)
_RESTING = Kind(
    "a set with `[sound]` whose housing does not move",
    lambda one: _sounds(one) and not set_of(one).housing.moves,
)
_SLIDING = Kind(
    "a set with `[sound]` whose housing moves and whose first bearing slides in it",
    lambda one: _sounds(one) and set_of(one).housing.moves and set_of(one).bearing[0].seat == "sliding",
)
_PAPER_SET = Kind(
    "a set with a paper's radiation model", lambda one: _sounds(one) and _model(one).startswith("paper")
)
_PORT = Kind("a set on another model's shaft (`spindle.shaft.external`)", lambda one: one.on_other_shaft)
_DIFFERING = Kind(
    "a set of bearings that differ (`bearing` or `materials` of a `[[spindle.bearing]]`)",
    lambda one: one.differing,
)
_BENDING = Kind("a scene whose rings bend", lambda one: one.bends)
_ROUND = Kind(
    "a scene of fidelity rings or response", lambda one: one.fidelity.model in ("rings", "response")
)
_DEFECTIVE = Kind("a scene with local defects (`[[imperfections.defect]]`)", lambda one: one.has_defects)
_NOT_BEM = Kind("a scene with another radiation model than bem", lambda one: _model(one) not in ("", "bem"))
_TABLE = Kind("a scene with the radiation model table", lambda one: _model(one) == "table")
_PAPER = Kind("a scene with a paper's radiation model", lambda one: _model(one).startswith("paper"))

_OWN_SHAFT = "give the shaft as `sections_mm` of `[spindle.shaft]`"
_BARE = 'give `sound.radiator` = "bare"'

BENDING = Exclusion(
    _BENDING,
    {"fidelities": "fidelity rings or response"},
    "these fidelities have rigid rings only",
    'give `fidelity.model` = "full" or "auto", or leave out `[mounting.flexure]` (of a set '
    "`[spindle.flexure]`)",
    _fidelities,
)
ROUND = Exclusion(
    _ROUND,
    {"vibration test": "a vibration test"},
    "its sensor touches the outer ring, which bends, and the rings of these fidelities are rigid",
    'give `fidelity.model` = "full" or "auto", or ask for rigid rings (`--rigid`), which read too little',
)
DEFECTS = Exclusion(
    _DEFECTIVE,
    {"response": "fidelity response"},
    "it is linear, and a contact over a defect loses its load and strikes",
    'give `fidelity.model` = "full", "rings" or "auto", or leave the defects out',
    _response,
)
RIGID_PLANE = Exclusion(
    _NOT_BEM,
    {"plane": "a rigid plane (`sound.reflecting_plane_mm`, or the radiator baffle)"},
    "only boundary elements have rigid planes",
    'give `sound.radiation_model` = "bem", or leave the plane out',
    _plane,
)
TABLE_CHANNELS = Exclusion(
    _TABLE,
    {"channels": "sound computed from recorded channels"},
    "the file holds paths to the scene's own microphones, which runs alone read",
    'name another radiation model, "bem" or "compact", or read the levels of a run (`simulate`)',
)
PAPER_RUNS = Exclusion(
    _PAPER,
    {"short runs": "levels of many short runs (the range of a level, levels of changes)"},
    "a paper's model needs channels of its own",
    'name another radiation model, "bem" or "compact"',
)

#: The table, from sets to sound. Of two rows for one subject the first that holds is named.
EXCLUSIONS = (
    Exclusion(
        _SET,
        {"against": "error motion against an outer ring"},
        "it has several, and its nose moves against the ground",
        "leave `against` out, or give `ground`",
    ),
    Exclusion(
        _RESTING,
        {"housing": "its housing as the radiator"},
        "only a housing that moves radiates",
        "give `mass_kg`, `diameter_mm`, `length_mm` and `pedestal_stiffness_N_m` in `[spindle.housing]`, "
        f'with `seat` = "fixed" in the place of "pedestal"; or {_BARE}',
        _housing,
    ),
    Exclusion(
        _SLIDING,
        {"housing": "its housing as the radiator"},
        "the outer ring that the housing shows in front must move with it",
        'give that bearing `seat` = "fixed" and those that carry the other way "sliding"; or ' + _BARE,
        _housing,
    ),
    Exclusion(
        _PAPER_SET,
        {"housing": "its housing as the radiator"},
        "these models take every body as bare, and the housing covers the bearings",
        f'give `sound.radiation_model` = "bem" or "compact"; or {_BARE}',
        _housing,
    ),
    Exclusion(
        _PORT,
        {
            "modes": "natural modes and their Campbell diagram",
            "receptance": "receptance of the nose and milling stability",
        },
        "another model owns the shaft, and they depend on its mass",
        _OWN_SHAFT,
    ),
    Exclusion(
        _PORT,
        {"statics": "statics (operating points, static stiffness)", "report": "a report"},
        "another model owns the shaft, and where it rests is not known here",
        f"{_OWN_SHAFT}, or read the forces of a run (`simulate`)",
    ),
    Exclusion(
        _PORT,
        {"fidelities": "fidelity rings or response"},
        "these fidelities use coordinates of the shaft, which another model moves",
        'give `fidelity.model` = "full" or "auto"',
        _fidelities,
    ),
    Exclusion(
        _PORT,
        {
            "recording": "a recording of sound channels",
            "error motion": "error motion of the nose",
            "measurement": "a measurement of sound",
            "comparison": "a comparison by new runs",
            "changes": "a study of changes",
            "tradeoff": "a trade-off study",
            "sensitivity": "a sensitivity study",
            "identification": "an identification",
        },
        "another model moves the shaft, and these run the bearings without it",
        _OWN_SHAFT,
    ),
    Exclusion(
        _PORT,
        {"load": "a load on the shaft (`[spindle.load]`)"},
        "it acts on the shaft, which another model owns",
        "leave it out and give the load to that model",
        _load,
    ),
    Exclusion(
        _PORT,
        {"tool": "a tool or a cut (`[tool]`, `[milling]`)"},
        "they belong to the nose of a shaft, which another model owns",
        f"leave the table out, or {_OWN_SHAFT}",
        _tool,
    ),
    Exclusion(
        _PORT,
        {"shaft": "sections, bending, heavy spots or supports of the shaft"},
        "they are given in the model which owns the shaft",
        "leave the key out, or give `spindle.shaft.external` = false",
        _shaft,
    ),
    Exclusion(
        _PORT,
        {"unbalance": "an unbalance in `[imperfections]`"},
        "it is the eccentricity of all that turns, which belongs to the model that owns the shaft",
        "leave the key out and give the unbalance to that model",
        _unbalance,
    ),
    Exclusion(
        _DIFFERING,
        {
            "changes": "a study of changes",
            "tradeoff": "a trade-off study",
            "sensitivity": "a sensitivity study",
        },
        "they change `[bearing]` and `[materials]`, which not all of its bearings have",
        "run a sweep over keys of your own (`sweep`)",
    ),
    Exclusion(
        _DIFFERING,
        {"fits": "a table of its fits", "temperatures": "temperatures that are computed"},
        "they are of one size of bearings",
        "give interferences and temperatures, or ask for a scene of each size",
    ),
    BENDING,
    ROUND,
    DEFECTS,
    RIGID_PLANE,
    TABLE_CHANNELS,
    PAPER_RUNS,
)


def exclusions_of(scene: Tables) -> tuple[Exclusion, ...]:
    """Return the rows of the table that hold for a scene."""
    return tuple(row for row in EXCLUSIONS if row.kind.holds(scene))


def exclusion(scene: Tables, subject: Subject) -> Exclusion | None:
    """Return the row by which a scene cannot have a subject; None where it can."""
    return next((row for row in exclusions_of(scene) if subject in row.what), None)


def refusal(scene: Tables, subject: Subject) -> str:
    """Return the scene's name, a subject that it cannot have, why, and the way out; "" where it can."""
    excluded = exclusion(scene, subject)
    return "" if excluded is None else f"{scene.name}: {excluded.words(subject)}"


def require(scene: Tables, subject: Subject) -> None:
    """Do nothing where a scene can have a subject.

    Raises
    ------
    SceneError
        Where it cannot, with `refusal`.
    """
    if words := refusal(scene, subject):
        raise SceneError(words)


def conflicts_of(tables: Tables) -> Iterator[Conflict]:
    """Yield what a scene's file asks for and its kind of scenes cannot have."""
    for row in exclusions_of(tables):
        for key in row.given(tables):
            yield Conflict(key, f"is refused: {row.reason}; {row.way_out}")
