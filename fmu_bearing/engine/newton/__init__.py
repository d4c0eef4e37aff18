"""The Newton system in accelerations: (I - cv Jv - cx Jx) d = r.

===================  ==========================================================================
``traction_slopes``  derivatives of a contact's traction by sliding, spin, entrainment and load
``contact_slopes``   derivatives of force and moment on a ball by its motion against one body
``body_slopes``      the bodies' own share: supports, gyroscopes, the cage's lands
``jacobian``         blocks of the Jacobian from these, by the levers of ball and bodies
``springs``          springs between balls in that system: a small dense correction
``block_arrow``      factors and solves it: a small block per ball, one border for the bodies
``modes``            flexural modes in it: rows, columns, and the inverse of what the balls leave
===================  ==========================================================================
"""
