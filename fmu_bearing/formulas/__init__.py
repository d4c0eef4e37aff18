"""Closed formulas of the field on plain numbers: contacts, ratings, makers' rules, fits.

==============  =====================================================================================
``hertz``       contact of two bodies
``half_space``  contact of two bodies with any gap between them
``axial``       axial load and displacement of a bearing at rest
``iso281``      dynamic load rating, equivalent load, basic and modified life, viscosity ratio
``iso76``       static load rating and safety
``iso16281``    reference rating life from the loads of the balls
``makers``      preload classes, speed limits and the least preload by makers' catalogues
``seals``       friction of contact seals by SKF's formula, and the speed limit of their lips
``clearances``  radial clearance of deep groove bearings by its group (ISO 5753-1)
``fits``        a ring on its shaft or in its housing: pressure, race, hoop stress, speed of loss
``tolerances``  ISO 492 and ISO 286: limits of bores, outside diameters, shafts and housings
==============  =====================================================================================
"""
