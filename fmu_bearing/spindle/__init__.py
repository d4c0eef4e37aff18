"""Sets of bearings on one shaft: statics.

===============  =======================================================================
``member``       one bearing of a set: forces and stiffness where the shaft puts it
``supports``     what holds the outer rings and gives way
``assembly``     all bearings at their places, preloaded; loads of the scene
``equilibrium``  where shaft and supports come to rest under loads
``axial``        lift-off, growth of preload, spacing that keeps it
``statics``      what a scene's set does under a load
``drawing``      a set drawn to scale, with its lines of contact
===============  =======================================================================

Shaft axes: X from the nose to the rear, Z up, origin at the nose. A bearing that carries force on the shaft
towards -X is mirrored, not turned: its own x' and tilts change sign; y, z, azimuths and spin stay.
"""
