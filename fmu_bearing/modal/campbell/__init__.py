"""Modes over speed, what excites them, and where fidelities rings and response are in doubt.

====================  ==================================================================================
``excitation_lines``  excitation lines and the waves that each can move
``diagram``           modes over speed, and where they meet lines
``diagram_style``     what is drawn of it: colours, widths, dashes, which lines
``diagram_picture``   it as a Matplotlib figure
``over_speed``        `campbell`: modes of a scene over speed, followed by shape
``doubts``            where figures of rings and response are in doubt: whirls, short runs, weak damping
====================  ==================================================================================
"""
