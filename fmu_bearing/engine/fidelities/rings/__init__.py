"""Fidelity rings: the rings' 11 degrees of freedom, stepped in time.

==============  =============================================================
``predictor``   first guess of a step
``march``       start, steps and their control
==============  =============================================================
"""
