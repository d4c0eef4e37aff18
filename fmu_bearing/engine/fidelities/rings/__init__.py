"""Fidelity rings: the rings' degrees of freedom, stepped in time; of a set, its coordinates.

===============  =============================================================
``predictor``    first guess of a step
``march``        steps of a single bearing and their control
``start``        where rings and balls begin at rest
``restart``      from one communication point to the next; rest, where a step fails
``coupled``      the equations of condensed bearings, shaft and housing of a set
``set_held``     what the bearings of a set hold, as the set loads them
``set_march``    steps of a set and their control
``set_restart``  a set from one communication point to the next; rest, where a step fails
===============  =============================================================
"""
