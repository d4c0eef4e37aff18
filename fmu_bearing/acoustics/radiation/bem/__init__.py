"""Sound of bodies of revolution by boundary elements, all bodies scattering on each other.

==================  =======================================================================
``meridian``        contours of bodies and their line elements
``bodies``          the bodies of a scene: rings, cage, housing, shaft
``integrals``       single and double layer potentials for all circumferential orders
``solver``          the exterior Helmholtz problem, with CHIEF points and losses at the walls
``solution``        one scene's surface pressures over frequency, kept on disk; fields from them
``paths``           the radiation model ``bem``: from a scene's bodies to paths
==================  =======================================================================

Time factor e^{+j omega t}; accelerations in, pressures out; meridian points are (x, r) in m.
"""
