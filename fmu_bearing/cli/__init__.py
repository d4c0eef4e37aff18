"""The command ``fmu-bearing``; one file per command or family of commands.

================  ==================================================================
``base``          the application, refusals, exit codes, files that are there
``options``       options that several commands have
``settings``      what --set and --fidelity make of a scene
``build``         the FMU of a scene
``scenes``        scene new, check, show, catalogue
``info``          the operating point, without a run
``runs``          simulate, plot
``compare``       two scenes, recordings or runs side by side
``sound``         levels, spectra, directivity, WAV
``envelope``      envelope spectra, with the lines of defects
``studies``       choose, tradeoff, sensitivity, changes
``several``       sensitivity to several values at once
``stiffness``     K and C over speed, preload and frequency, and of a set's shaft
``receptance``    motion of the nose per force on it, over frequency
``lobes``         how deep a spindle may cut before it chatters
``fits``          what tolerances of shaft and housing do
``sweep``         a scene over a grid of its values
``dataset``       labelled waveforms of many runs
``identify``      numbers of a scene from measured levels
``realtime``      what steps cost beside the clock, by fidelity
``modes``         natural frequencies, and over speed what excites them
``vibration``     the vibration test of a bearing by itself
``inverse``       its --measured: a surface from values of a supplier
``error_motion``  error motion of the nose over speeds
``validate``      checks of an FMU
``report``        a page about a run
``warm_up``       compile before the first run needs it
================  ==================================================================
"""

# importing a file registers its commands
from fmu_bearing.cli import (  # noqa: F401
    build,
    compare,
    dataset,
    envelope,
    error_motion,
    fits,
    identify,
    info,
    lobes,
    modes,
    realtime,
    receptance,
    report,
    runs,
    scenes,
    sound,
    stiffness,
    studies,
    sweep,
    validate,
    vibration,
    warm_up,
)  # fmt: skip
from fmu_bearing.cli.base import app

__all__ = ["app"]
