"""The three papers side by side with this package: ``python -m examples.papers.run``, or ``make papers``.

=====================  ======================================================================================
``run``                the command: identifies, runs all cases on the cores given, writes the pages
``runs``               cases evaluated in processes, results kept on disk
``case``               one operating point of a scene with one seed, and its recording
``values``             values of a paper (``data/*.csv``), fitted or checked; intervals of rounded ones
``identification``     free numbers of a scene from the fitted values alone
``statements``         statements judged seed by seed, and their classes
``floor``              a floor under a spindle, by images
``hearing``            levels of a recording, source by source; the papers' radiation models add energies
``page``               tables, Markdown, CSV
``charts``             the pictures
``lines``              points, components and lines of the multi-source paper, and its statements on them
``multi_source``       the multi-source paper: 7003C in a spindle, four points, 10,000 to 40,000 r/min
``printed``            its printed equations on the paper's own system
``printed_motion``     eqs. 1 to 6 as printed, corrected and beside the product: tables, command line
``printed_runs``       runs of these equations, and what is read from them
``printed_equations``  their right-hand side in plain NumPy, a switch for each fault
``printed_forces``     contacts, traction, pockets and lands for them
``printed_field``      eqs. 1 to 3 of the sound-field paper as printed, corrected and beside the product
``circles``            circles of 24 points and the sound-field paper's statements on them
``sound_field``        the sound-field paper: full-ceramic 7009C and its steel twin, circles of 24 points
``impact_noise``       the impact-noise paper: dry 7003C held all round, springs for a cage
``impact``             balls that hit each other on one line, and their sound
``assembly``           modes of a whole bearing whose balls stick or slide: contact conditions C1 to C4
``chance``             matches of peaks with natural frequencies, beside what chance gives
=====================  ======================================================================================

One dynamic run per operating point and seed serves all microphones and all radiation models but ``paper``.
The scalars of ``paper`` are formed while the bearing runs.
"""
