"""What printed papers compute beside runs of a bearing; the examples compare it with what they print.

============  ======================================================================
``impact``    balls that hit each other on one line, and their sound
``assembly``  modes of a whole bearing whose balls stick or slide: contact conditions C1 to C4
``chance``    matches of peaks with natural frequencies, beside what chance gives
============  ======================================================================

Nothing else imports this package: no run, no command, no FMU.
"""
