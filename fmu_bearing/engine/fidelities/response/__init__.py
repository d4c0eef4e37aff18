"""Fidelity response: the linear answer to every excitation, as a sum of lines.

==========  =============================================================
``lines``   which lines there are, and their displacements
``march``   start, and the state at any time
==========  =============================================================
"""
