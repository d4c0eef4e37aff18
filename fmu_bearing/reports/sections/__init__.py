"""Sections about the run itself, and what the page shows above them.

``kinematic_marks``   lines at the kinematic frequencies
``summary``           the figures at the top, and the warnings
``verdict_table``     limits that are kept or passed, on the first screen
``assumptions``       which values are assumed
``conditions``        operating point, kinematic frequencies, choices
``arrangement``       of a set: the shaft, loads of its bearings, axial load, preload over temperatures
``what_to_change``    choices ranked by level, life and torque
``ring_motion``       velocities, orbits
``envelopes``         envelope spectra of accelerations, where a bearing has a defect
``error_motion``      error motion of the axis of rotation: values, lines, sources
``accelerometers``     what accelerometers read, and its spectra
``ball_contacts``     loads and angles around the circle
``seats``             what the fits of the rings do
``friction``          torque, shares, heats
"""
