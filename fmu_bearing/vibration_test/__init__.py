"""The vibration test of a bearing by itself, as makers run it: radial velocity of the outer ring in bands.

=============  ==========================================================================
``rig``        `rig`: the scene of the test, from the scene of a bearing
``reading``    `reading`: what the sensor of the tester reads, from one run
``subject``    the bearing under test: by its name in the catalogue, or of a scene
``band``       what was read in one band
``anderon``    the unit of vibration testers
``lines``      lines of the spectrum, named, and the energy of each wave
``remarks``    what to know of the figures
``files``      the picture of the bands, tables of lines and spectra
``inverse``    `surface`: from measured values to the law of the surfaces
``vibration``  `vibration`: the test over seeds, on both pieces, each source alone
=============  ==========================================================================
"""
