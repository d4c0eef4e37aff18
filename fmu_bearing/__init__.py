"""Angular contact ball bearings of steel and ceramics, with their sound, as FMI 2.0 co-simulation FMUs.

One way through, with no way back::

    scene.toml -> Scene -> Model (flat numbers + names) -> engine: init / step / outputs -> outputs by name

==================  =========================================================================
``renamed``         old names, each answered with the new one
``progress``        progress of long work, told line by line
``files``           writing files that other processes may read
``engine``          Numba kernels on flat arrays: mechanics, fidelities, sound
``scene``           WHAT is simulated: frozen models read from TOML, catalogue
``elastic``         bending of the rings: sections, finite elements, modes
``acoustics``       transfer functions from motion to microphones, filters, analysis
``interface``       THE table of variables
``prepare``         scene to numbers, once: contacts, masses, imperfections, the model
``instance``        one running bearing, for the library and for the FMU alike
``fmi``             the FMI face: XML, native library, slave, the written ``.fmu``
``run``             a scene or an FMU run over inputs; results; fidelity ``auto``
``recording``       runs with the sound channels kept, and what is measured on them
``accuracy``        reference trajectories, what accuracy costs, what rests on assumed values
``sweeps``          a scene over a grid of its values
``reports``         one HTML page about a run
``validation``      what FMI 2.0 asks of an FMU, checked
``testing``         fixtures for pytest: FMUs against recorded references
``cli``             the command ``fmu-bearing``
==================  =========================================================================

Axes: X bearing axis, Y horizontal, Z up. Positive speed is right-handed about +X; preload pushes the inner
ring towards +X; angles count from 12 o'clock with positive rotation. SI units inside; scene files use the
units in their key names.

>>> from fmu_bearing import Bearing, simulate
>>> run = simulate("examples/scenes/7003C-bare.toml", 2e-3)
>>> round(1e3 * run["friction_torque"][-1])  # N.mm
22
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from fmu_bearing.recording.record import Recording, record
    from fmu_bearing.reports import report
    from fmu_bearing.run.bearing import Bearing
    from fmu_bearing.run.build import build_fmu
    from fmu_bearing.run.result import Run
    from fmu_bearing.run.simulate import simulate
    from fmu_bearing.scene import Scene, SceneError, read_scene
    from fmu_bearing.sweeps import sweep

__version__ = "0.1.0"

#: Public names and where they live; each is imported when first asked for.
_PLACES = {
    "Bearing": "run.bearing",
    "Recording": "recording.recording",
    "Run": "run.result",
    "Scene": "scene",
    "SceneError": "scene",
    "build_fmu": "run.build",
    "read_scene": "scene",
    "record": "recording.record",
    "report": "reports",
    "simulate": "run.simulate",
    "sweep": "sweeps",
}

__all__ = [
    "Bearing",
    "Recording",
    "Run",
    "Scene",
    "SceneError",
    "build_fmu",
    "read_scene",
    "record",
    "report",
    "simulate",
    "sweep",
]


def __getattr__(name: str) -> Any:
    if name not in _PLACES:
        raise AttributeError(f"fmu_bearing has no '{name}'; public names are {', '.join(__all__)}")
    return getattr(import_module(f"fmu_bearing.{_PLACES[name]}"), name)


def __dir__() -> list[str]:
    return [*__all__, "__version__"]
