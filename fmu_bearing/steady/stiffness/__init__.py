"""Stiffness and damping of a scene's bearings for rotor programs, and stiffness of their shaft.

=====================  ===========================================================================
``planes``             springs and dampers in three planes that replace tilt and coupling
``stiffness_table``    K and C of a bearing over speed, preload and frequency, and what follows
``stiffness_limits``   what limits them, in sentences
``stiffness_files``    their CSV and netCDF
``stiffness_picture``  K and C over speed, drawn
``ross``               bearing elements for the rotor program ROSS
``bearing_stiffness``  all of these for one bearing
``nose_stiffness``     static stiffness of a set's shaft at its nose over speed and preload
``scene_stiffness``    `stiffness`: the tables of a scene
=====================  ===========================================================================
"""
