"""Ball bearings of steel and ceramics, with their sound, as FMI 2.0 co-simulation FMUs.

Data flow in one direction::

    scene.toml -> Scene -> Model (flat numbers + names) -> engine: init / step / outputs -> outputs by name

==================  =========================================================================
``progress``        progress of long work, printed line by line
``files``           reading files that users name, writing those that other processes may read, the cache
``file_words``      why a file cannot be read, and what it holds where another kind is due
``likeness``        the name that a misspelt one was meant to be
``children``        processes that the program starts
``threads``         linear algebra on one thread
``extras``          optional packages, imported where they are used
``formulas``        closed formulas on plain numbers: Hertz contact, ratings, makers' rules
``engine``          Numba kernels on flat arrays: mechanics, fidelities, sound
``compiled``        these kernels compiled ahead of time, for Python and for FMUs
``scene``           scenes: frozen models read from TOML, catalogue
``elastic``         bending of the rings: sections, finite elements, modes
``acoustics``       transfer functions from motion to microphones, filters, analysis
``interface``       the table of variables
``prepare``         from a scene to the numbers of the engine: contacts, masses, imperfections
``arrays``          a bearing as flat arrays, for loops that read and restore the state
``cautions``        warnings about the state that a bearing has reached
``instance``        one running bearing, for the library and for the FMU
``fmi``             FMI 2.0: XML, native library, slave, the ``.fmu`` file
``results``         values of variables over time: tables, files, spectra, pictures
``modal``           small motions: natural modes, Campbell diagram, receptance of the nose
``machining``       how deep a spindle may cut before it chatters
``run``             a scene or an FMU run over inputs; fidelity ``auto``
``steady``          what a scene's bearings do without a run: rest, loads, stiffness and damping
``design``          what a designer asks: ratings, operating point, verdicts
``metrology``       error motion of the axis of rotation at the nose, from runs
``recording``       runs that keep the sound channels; measurements, pictures, tables, WAV files
``vibration_test``  the vibration test of a bearing by itself: velocity of the outer ring in bands
``accuracy``        error against cost, sensitivity to assumed values and to a designer's choices
``identification``  numbers of a scene from measured sound and vibration
``sweeps``          a scene over a grid or samples of its values
``dataset``         labelled data sets: waveforms of many runs
``reports``         one HTML page about a run
``validation``      checks of an FMU against FMI 2.0
``testing``         fixtures for pytest: FMUs against recorded references
``cli``             the command ``fmu-bearing``
==================  =========================================================================

Axes: X bearing axis, Y horizontal, Z up. Positive speed is right-handed about +X; preload pushes the inner
ring towards +X; angles count from 12 o'clock with positive rotation. SI units inside; scene files use the
units in their key names.

>>> from fmu_bearing import Bearing, simulate
>>> run = simulate("examples/scenes/7003C-bare.toml", 2e-3)
>>> round(1e3 * run["friction_torque"][-1])  # N.mm
21
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from fmu_bearing.accuracy.changes import changes
    from fmu_bearing.design.fits import fits
    from fmu_bearing.design.fresh import new_scene
    from fmu_bearing.design.operating_point import operating_point
    from fmu_bearing.design.verdicts import verdicts
    from fmu_bearing.identification import identify
    from fmu_bearing.machining.stability import Lobes, lobes
    from fmu_bearing.metrology.error_motion import ErrorMotion, error_motion
    from fmu_bearing.modal.campbell.over_speed import Campbell, campbell
    from fmu_bearing.modal.modes.natural_modes import Modes
    from fmu_bearing.modal.modes.points import modes
    from fmu_bearing.modal.receptance.scene_receptance import Receptance, receptance
    from fmu_bearing.recording.measurements import audio, measure, pictures, tables
    from fmu_bearing.recording.record import Recording, record
    from fmu_bearing.recording.studies.compare import compare
    from fmu_bearing.recording.studies.spread import spread
    from fmu_bearing.reports import report
    from fmu_bearing.results.result import Run
    from fmu_bearing.run.bearing import Bearing
    from fmu_bearing.run.build import build_fmu
    from fmu_bearing.run.realtime import realtime
    from fmu_bearing.run.simulate import simulate
    from fmu_bearing.scene import Scene, SceneError, read_scene
    from fmu_bearing.scene.conformity import conformity_from_stiffness
    from fmu_bearing.scene.own_bearing import Dimensions
    from fmu_bearing.scene.read import with_fidelity
    from fmu_bearing.scene.surface import Surface
    from fmu_bearing.steady.statics import Statics, statics
    from fmu_bearing.steady.stiffness.scene_stiffness import Stiffness, stiffness
    from fmu_bearing.sweeps import sweep
    from fmu_bearing.sweeps.global_sensitivity import global_sensitivity
    from fmu_bearing.vibration_test.inverse import surface
    from fmu_bearing.vibration_test.vibration import vibration

__version__ = "0.1.0"

#: Public names and where they live; each is imported when first asked for.
_PLACES = {
    "Bearing": "run.bearing",
    "Campbell": "modal.campbell.over_speed",
    "Dimensions": "scene.own_bearing",
    "ErrorMotion": "metrology.error_motion",
    "Lobes": "machining.stability",
    "Modes": "modal.modes.natural_modes",
    "Receptance": "modal.receptance.scene_receptance",
    "Recording": "recording.recording",
    "Run": "results.result",
    "Scene": "scene",
    "SceneError": "scene",
    "Statics": "steady.statics",
    "Stiffness": "steady.stiffness.scene_stiffness",
    "Surface": "scene.surface",
    "audio": "recording.measurements",
    "build_fmu": "run.build",
    "campbell": "modal.campbell.over_speed",
    "changes": "accuracy.changes",
    "compare": "recording.studies.compare",
    "conformity_from_stiffness": "scene.conformity",
    "error_motion": "metrology.error_motion",
    "fits": "design.fits",
    "global_sensitivity": "sweeps.global_sensitivity",
    "identify": "identification",
    "lobes": "machining.stability",
    "measure": "recording.measurements",
    "modes": "modal.modes.points",
    "new_scene": "design.fresh",
    "operating_point": "design.operating_point",
    "pictures": "recording.measurements",
    "read_scene": "scene",
    "realtime": "run.realtime",
    "receptance": "modal.receptance.scene_receptance",
    "record": "recording.record",
    "report": "reports",
    "simulate": "run.simulate",
    "spread": "recording.studies.spread",
    "statics": "steady.statics",
    "stiffness": "steady.stiffness.scene_stiffness",
    "surface": "vibration_test.inverse",
    "sweep": "sweeps",
    "tables": "recording.measurements",
    "verdicts": "design.verdicts",
    "vibration": "vibration_test.vibration",
    "with_fidelity": "scene.read",
}

__all__ = [
    "Bearing",
    "Campbell",
    "Dimensions",
    "ErrorMotion",
    "Lobes",
    "Modes",
    "Receptance",
    "Recording",
    "Run",
    "Scene",
    "SceneError",
    "Statics",
    "Stiffness",
    "Surface",
    "audio",
    "build_fmu",
    "campbell",
    "changes",
    "compare",
    "conformity_from_stiffness",
    "error_motion",
    "fits",
    "global_sensitivity",
    "identify",
    "lobes",
    "measure",
    "modes",
    "new_scene",
    "operating_point",
    "pictures",
    "read_scene",
    "realtime",
    "receptance",
    "record",
    "report",
    "simulate",
    "spread",
    "statics",
    "stiffness",
    "surface",
    "sweep",
    "tables",
    "verdicts",
    "vibration",
    "with_fidelity",
]


def __getattr__(name: str) -> Any:
    if name not in _PLACES:
        raise AttributeError(f"fmu_bearing has no '{name}'; public names are {', '.join(__all__)}")
    place = import_module(f"fmu_bearing.{_PLACES[name]}")
    if not hasattr(place, name):  # a module that nothing has imported yet
        return import_module(f"{place.__name__}.{name}")
    return getattr(place, name)


def __dir__() -> list[str]:
    return [*__all__, "__version__"]
