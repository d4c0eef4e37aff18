"""Fidelity response: the linear answer to every excitation, as a sum of lines.

===============  =============================================================
``lines``        which lines there are, and their displacements
``ball_orders``  what the form of turning balls consists of
``march``        start, and the state at any time
``set_lines``    what each bearing of a set excites in the whole of it
``set_march``    start of a set, and its state at any time
===============  =============================================================
"""
