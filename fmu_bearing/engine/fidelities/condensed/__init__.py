"""What fidelities rings and response share: balls at rest between the races, and what full has beside them.

=====================  ==============================================================================
``rows``               coordinates and components; places of the balls between state and work space
``ball_form``          form and waviness of the balls under both races
``defects``            local defects under the balls
``balls``              each ball at rest between the races, and what it puts on the rings
``families``           motions of rings, cage and patterns of the balls that do not act on each other
``operator``           what balls and cage do beside that, by modes of the linearised full equations
``contact_forces``     what contacts do as a ball leaves its place of rest
``dynamic_stiffness``  what balls and cage do beside balls at rest, at one complex rate
``drives``             what drives these modes
``patterns``           the modes stepped in time
``phi``                what a drive leaves in a mode within a step
``transverse``         what holds a ball across its track and drags it along
``ball_motion``        each ball's own motion there, for its sound
``uneven``             losses that are frozen: with even balls, and what uneven ones add
``carried``            losses where no steady state is found: of quasi-static balls under the loads across
``frozen``             cage speed, friction and heats, found at the steady state and frozen
``linearised``         derivatives of the rings' accelerations, and their static equilibrium
``publish``            from the rings' own state to the one that outputs and sound read
``shared``             start, inputs, clock and sound samples
=====================  ==============================================================================

Both are linear in slip and in the cage's motion. Friction torque and heats belong to
the steady state. Work in is set equal to the heats: the energy residual is zero by construction.
"""
