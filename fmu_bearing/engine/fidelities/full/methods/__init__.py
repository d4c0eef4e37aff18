"""The Runge-Kutta methods of fidelity full, as data.

Each has an explicit first stage, one diagonal entry and its last stage at the new state. Places in a method's
block of coefficients are in ``layout.tableau`` (``TAB``).

===========  ==============================================
``tableau``  packs the coefficients of one method
``esdirk4``  implicit, fourth order: the default
``trbdf2``   implicit, second order
``rk4``      explicit, fourth order
``table``    all of them in one array, and where each begins
===========  ==============================================
"""
