"""Fidelity rings: the rings' 11 degrees of freedom, stepped in time.

==============  =============================================================
``predictor``   first guess of a step
``march``       steps and their control
``start``       where rings and balls begin at rest
``restart``     from one communication point to the next; rest, where a step fails
==============  =============================================================
"""
