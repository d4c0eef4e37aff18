"""What the sections read.

``observed_run``   the run of a scene with all variables that a report shows
``subject``        the recording, with checks for values that it may lack
``curves``         variables over time, thinned before the last turns
``microphones``    pressures, levels and spectra at the microphones, computed once for all sections
"""
