"""Fidelity response: the linear response to every excitation, as a sum of lines.

===================  =============================================================
``samples``          forces and places of the balls round their orbit, by orders
``lines``            which lines a bearing has, and its response to them
``strongest_lines``  the heaviest of them
``ball_orders``      what the form of turning balls consists of
``bearing``          one bearing's part: derivatives, its own lines, its balls
``coupled_lines``    what each bearing of a set excites in the whole of it
``ball_sound``       what the balls do in the sound of a line
``line_sound``       levels and pressures of all lines
``equilibrium``      where rings and balls rest, and all lines about it at once
``exchange``         how renewed lines take the place of those in use
``pieces``           the same in pieces, beside the lines in use
``drift``            what goes along with inputs that drift, between renewals
``renewal``          when pieces are made, and what is taken over of them
``march``            start, and the state at any time
===================  =============================================================
"""
