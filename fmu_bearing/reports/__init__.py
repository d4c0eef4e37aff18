"""A report about a run: one HTML page that needs a browser only.

``run``          the run of a scene with all variables that a report shows
``subject``      the recording, as the sections read it
``blocks``       parts of a section: words, tables, charts, sounds
``look``         colours, fonts, an empty figure
``marks``        lines at the kinematic frequencies
``decimate``     fewer points with all peaks
``summary``      the figures at the top, and the warnings
``verdicts``     limits that are kept or passed, on the first screen
``conditions``   operating point, kinematic frequencies, choices
``assumptions``  which values are assumed
``changes``      what to change: choices ranked by level, life and torque
``campbell``     Campbell diagram, tables of modes and of crossings
``shapes``       shapes of modes, for the script that moves them (``shapes.js``)
``modes``        the section about modes, and `modes_page`: a page of its own
``motion``       velocities, orbits
``contacts``     loads and angles around the circle
``friction``     torque, shares, heats
``heard``        pressures, levels and spectra at the microphones, computed once for all sections
``sound``        levels, spectra, third octaves, ranking, lines
``fall``         waterfall over time or speed
``balloon``      level over direction
``audio``        sounds to play
``spindle``      the page about a set of bearings on one shaft, from statics
``page``         the page from its sections; ``page.html.j2``, ``page.css``, ``page.js``
``make``         `report`: from a run or a recording to the page
"""

from fmu_bearing.reports.make import Report, make, report
from fmu_bearing.reports.modes import modes_page

__all__ = ["Report", "make", "modes_page", "report"]
