"""The engine: Numba kernels on flat float64 arrays. No scene, no file, no FMI.

=====================  =======================================================================
``sources``             hash of source files, for caches and for what must fit together
``jit``                compiler flags and the cache of compiled kernels
``layout``             places in the flat arrays ``p u s z w``
``constants``          constants of nature and convention
``status``             status codes of the entries
``choices``            what a scene may choose, with its numbers in ``p``: one table each
``lanes``              four balls at a time
``complex_numbers``    complex numbers in flat arrays
``dense``              small dense matrices: product, elimination, inverse, complex equations
``eigen``              eigenvalues and eigenvectors of small complex matrices
``mechanics``          forces and equations of motion of balls, cage and rings
``newton``             the Newton system in accelerations: Jacobian, factors, solution
``statics``            quasi-static equilibrium, the first guess of the operating point
``steady``             operating point: the steady state of the full equations, where a run starts
``sound``              filters from motion to microphones, level meters
``readout``            from the state to outputs, losses and motion samples
``spindle``            bearings together: their shaft and housing, their joint equations, rest and sound
``fidelities``         how the state is stepped: full, rings, response
``boundary_elements``  integrals over line elements of bodies of revolution, for sound
``reference``          explicit integration, first-order form and played sound, for comparison
``abi``                public entry points: ``init``, ``step``, ``outputs``
=====================  =======================================================================

Kernels allocate nothing, raise nothing and return status codes; work space is passed in.
"""
