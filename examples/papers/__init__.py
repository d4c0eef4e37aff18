"""The three papers side by side with this package: ``python -m examples.papers.run``, or ``make papers``.

================  =========================================================================================
``run``           the command: calibrates, runs all cases on the cores given, writes the pages
``case``          one operating point of a scene and its recording, kept on disk so that runs continue
``hearing``       levels of a recording, source by source; the papers' radiation models add energies
``calibration``   the one scalar of each page, the amplitude of the imperfections
``page``          verdicts, tables, Markdown, CSV
``charts``        the pictures
``multi_source``  the multi-source paper: 7003C in a spindle, four points, 10,000 to 40,000 r/min
``circles``       circles of 24 points and the sound-field paper's statements on them
``sound_field``   the sound-field paper: full-ceramic 7009C and its steel twin, circles of 24 points
``impact_noise``  the impact-noise paper: dry 7003C held all round, springs for a cage
================  =========================================================================================

One dynamic run per operating point serves all microphones and all radiation models but ``paper``. The
scalars of ``paper`` are formed while the bearing runs.
"""
