"""The Newton system in accelerations: (I - cv Jv - cx Jx) d = r.

===============  ==============================================================================
``jacobian``     blocks of the Jacobian by differences, all balls per perturbation
``springs``      springs between balls in that system: a small dense correction
``block_arrow``  factors and solves it: a small block per ball, one border for the bodies
``modes``        flexural modes in it: their rows and columns, and the inverse of what the balls leave
===============  ==============================================================================
"""
