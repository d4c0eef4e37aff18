"""Sound of bodies of revolution by boundary elements, all bodies scattering on each other.

==================  =======================================================================
``meridian``        contours of bodies and their line elements
``bodies``          the bodies of a scene: rings, cage, housing, shaft
``integrals``       single and double layer potentials for all circumferential orders
``solver``          the exterior Helmholtz problem, with CHIEF points and losses at the walls
``task``            what is solved for a scene, and the drives of its bodies
``rational``        rational functions of frequency, and the choice of the frequencies to solve
``band``            surface pressures over a band of frequencies, on one mesh; fields from them
``solution``        a task solved in all bands, kept on disk
``paths``           the radiation model ``bem``: from a scene's bodies to paths
==================  =======================================================================

Integrals are kernels of the engine (`engine.boundary_elements`), compiled ahead of time with all others.

Time factor e^{+j omega t}; accelerations in, pressures out; meridian points are (x, r) in m.
"""
