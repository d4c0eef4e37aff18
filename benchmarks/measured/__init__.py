"""What others measured or printed, beside what the package computes: ``python -m benchmarks.measured.run``.

==============  ==============================================================================
``sources``     where the values come from; ``sources.toml``, ``values.csv``: numbers alone
``stiffness``   pairs of NSK and TPI: stiffness, offset of the faces, rules of thumb
``friction``    torque of the 7210B, heat of the 35 mm bearing
``parts``       what each part of the friction is worth, in tables
``motion``      speed of the cage, vibration
``defects``     envelopes of pits and spalls
``compared``    all of it, by source, with the range that the assumed inputs give
``findings``    what each source says, misses first
``page``        the page, its table, its figures
==============  ==============================================================================
"""
