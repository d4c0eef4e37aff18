"""Fidelity response: the linear answer to every excitation, as a sum of lines.

===============  =============================================================
``lines``        which lines there are, and their displacements
``ball_orders``  what the form of turning balls consists of
``march``        start, and the state at any time
===============  =============================================================
"""
