"""What fidelities rings and response share: balls in static equilibrium between the races.

===============  =============================================================================
``rows``         coordinates and components; places of the balls between state and work space
``ball_form``    form and waviness of the balls under both races
``balls``        each ball at rest between the races, and what it puts on the rings
``transverse``   the balls' own motion across their tracks, as far as rings feel it
``ball_motion``  each ball's own motion there, for its sound
``uneven``       losses that are held: with even balls, and what uneven ones add
``held``         cage speed, friction and heats, found at the steady state and held
``linearised``   derivatives of the rings' accelerations, and their static equilibrium
``whirls``       the rings' equations at a complex frequency, by the full ones and the condensed ones
``modes``        what the rings' modes lack in mass and damping
``publish``      from the rings' own state to the one that outputs and sound read
``shared``       start, inputs, clock and sound samples
===============  =============================================================================

Both leave out the cage's motion and slip. Friction torque and heats belong to
the steady state. Work in is set equal to the heats: the energy residual is zero by construction.
"""
