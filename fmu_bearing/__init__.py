"""Angular contact ball bearings of steel and ceramics, with their sound, as FMI 2.0 co-simulation FMUs.

One way through, with no way back::

    scene.toml -> Scene -> Model (flat numbers + names) -> engine: init / step / outputs -> what people read

==================  =========================================================================
``scene``           WHAT is simulated: frozen models read from TOML, catalogue
``elastic``         bending of the rings: sections, finite elements, modes
``acoustics``       transfer functions from motion to microphones, filters, spectra
``prepare``         scene to numbers, once: contacts, masses, imperfections, the model
``interface``       THE table of variables
``engine``          Numba kernels on flat arrays: mechanics, solvers, sound
``instance``        one running bearing, for the library and for the FMU alike
``fmi``             the FMI face: XML, native library, slave, the written ``.fmu``
``files``           writing files that other processes may read
``study``           reference trajectories, and level ``full`` for general-purpose integrators
==================  =========================================================================

Axes: X bearing axis, Y horizontal, Z up. Positive speed is right-handed about +X; preload pushes the inner
ring towards +X; angles count from 12 o'clock with positive rotation. SI units inside; scene files use the
units in their key names.

>>> from fmu_bearing.scene import read_scene
>>> from fmu_bearing.prepare.model import prepare
>>> from fmu_bearing.instance import Instance
>>> bearing = Instance(prepare(read_scene("examples/scenes/7003C-bare.toml")))  # doctest: +SKIP
>>> bearing.initialise(); bearing.step(1e-3); bearing.get("friction_torque")  # doctest: +SKIP
"""

__version__ = "0.1.0"
