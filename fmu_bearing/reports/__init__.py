"""A report about a run: one HTML page that needs a browser only.

============  ===========================================================================
``page``      parts of a section, their style, and the page from its sections
``data``      what the sections read: the run, the recording, levels at the microphones
``sections``  summary, verdicts, choices, shaft, motion, loads, friction
``sound``     levels, spectra, waterfall, directivity, sounds to play
``modes``     Campbell diagram, tables of modes, moving shapes; a page of their own
``make``      `report`: from a run or a recording to the page
============  ===========================================================================
"""

from fmu_bearing.reports.make import Report, make, report
from fmu_bearing.reports.modes.modes_section import modes_page

__all__ = ["Report", "make", "modes_page", "report"]
