"""One page about a run: HTML that needs nothing but a browser, for whoever was not there.

``run``          the run that has all a report shows
``balls``        what every ball carries, out of the state
``subject``      the recording that sections ask
``heard``        what microphones heard, computed once for all sections of sound
``blocks``       what sections are made of: words, tables, charts, sounds
``look``         colours, fonts, an empty figure
``decimate``     fewer points with all peaks
``marks``        upright lines at the kinematic frequencies
``summary``      the figures on top, and what to be warned of
``conditions``   operating point, kinematic frequencies, choices
``assumptions``  which values are assumed
``motion``       velocities, orbits
``contacts``     loads and angles around the circle
``friction``     torque, shares, heats
``sound``        levels, spectra, third octaves, ranking, lines
``fall``         waterfall over time or speed
``balloon``      level over direction
``audio``        sounds to play
``page``         the page out of its sections; ``page.html.j2``, ``page.css``, ``page.js``
``make``         `report`: run or recording in, page out
"""

from fmu_bearing.reports.make import Report, make, report

__all__ = ["Report", "make", "report"]
