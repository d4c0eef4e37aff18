"""Small motions of a bearing or of a set on its shaft: natural modes, Campbell diagram, receptance.

================  ========================================================================
``equations``     fidelity `full` linearised about a steady state, of a bearing and of a set
``modes``         natural frequencies and damping, and what moves in each mode
``campbell``      modes over speed and what excites them; where fidelities are in doubt
``table_points``  points of a table over speed and preload
``receptance``    motion of the nose per force on it, over frequency
================  ========================================================================
"""
