"""Stiffness and damping of a bearing for rotor programs.

=====================  ===========================================================================
``impedance``          forces on the inner ring per motion, balls eliminated at the frequency
``planes``             two planes whose radial springs stand for tilt and coupling
``stiffness_table``    K and C over speed, preload and frequency, and what follows from them
``stiffness_limits``   what limits them, in sentences
``stiffness_files``    their CSV and netCDF
``stiffness_picture``  K and C over speed, drawn
``ross``               bearing elements for the rotor program ROSS
``scene_stiffness``    `stiffness`: the table of a scene
=====================  ===========================================================================
"""
