"""Motion of the nose per force on it, over frequency: its receptance, with a tool on it, too.

======================  ===========================================================================
``transfer``            receptance of a linearised scene at its nose
``tool``                receptance at the tip of a tool on the nose
``receptance_table``    its table over speed, preload and frequency, and what follows
``receptance_files``    its CSV and universal file
``receptance_picture``  magnitude and phase, drawn
``scene_receptance``    `receptance`: the table of a scene
======================  ===========================================================================
"""
