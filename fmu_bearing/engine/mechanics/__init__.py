"""Forces and equations of motion.

================  ===========================================================================
``triples``       vectors of three components, of four balls at a time
``powers``        logarithm and exponential to base 2, branch-free
``trigonometry``  sine and cosine of the ball angles, branch-free
``conditions``    inputs turned into constants of one communication step
``pose``          where a ball is in a body's own frame, and how fast it moves there
``contact``       axes of a contact, heights of both surfaces, load by Hertz's law and its slopes
``inlet``         rolling resistance of the oil at the inlets of the contacts
``race``          load, damping, traction strips and hysteresis of all balls on one race
``traction``      Eyring's law, the multi-source paper's and heated oil on the same strips
``ball_waves``    waviness that turns with the balls, and the turning of their axes
``defects``       local defects of races and balls, from their tables
``cage``          pockets and land guidance
``springs``       springs between neighbouring balls in place of a cage
``seals``         torque of the seals between the rings
``flexure``       flexural modes of the rings
``bodies``        forces on rings and cage that do not come through the balls
``equations``     the right-hand side: accelerations, power and heat
``energy``        stored energy
================  ===========================================================================

Sign rules: forces and moments are those *on the ball*; the body takes their opposite at the same
point, so that Newton's third law holds to rounding. Moments on a body are about its centre.
"""
