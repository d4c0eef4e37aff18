"""From a scene to the numbers of the engine, once per scene; plain Python, which may be slow and may raise.

==================  ===================================================================
``bodies``          masses and inertias from the scene's dimensions
``fits``            how interference of ring and shaft or housing moves the races
``contacts``        oil and friction, rolling resistance and films of the races
``surfaces``        power law, contact filter and highest orders of races and balls
``imperfections``   waviness of races and balls, ball sizes, from a seed
``defect_shapes``   spalls, pits, dents and scratches as depths below the surface
``defect_contact``  a ball at one place over a defect: load, energy and slope
``defects``         tables of the contact over a defect
``defect_blocks``   defects and their tables as the engine's numbers
``flexure``         bending modes of the rings as the engine's coordinates
``step_limits``     bearings in which nothing asks for short steps
``sound_block``     the sound block, kept on disk
``accelerometers``  the blocks of accelerometers of each bearing
``spindle``         parameters of a set of bearings on one shaft
``unread_outputs``  switches of what need not be computed, because no variable shows it
``lengths``         lengths of the engine's arrays that go with the parameters
``model``           packs everything into the flat parameter array of the engine
==================  ===================================================================
"""
