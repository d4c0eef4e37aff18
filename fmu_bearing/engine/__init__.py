"""The engine: Numba kernels on flat float64 arrays. No scene, no file, no FMI.

=====================  =======================================================================
``layout``             places in the flat arrays ``p u s z w``
``abi``                what the outside calls: ``init``, ``step``, ``outputs``
``mechanics``          forces and equations of motion of balls, cage and rings
``solvers``            quasi-static start, Jacobian, block-arrow algebra, ESDIRK4(3)
``sound``              filters from motion to microphones, level meters
``jit``                compiler flags and the cache of compiled kernels
=====================  =======================================================================

Kernels allocate nothing, raise nothing and return status codes; work space is passed in.
"""
