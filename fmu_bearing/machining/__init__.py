"""How deep a spindle may cut before it chatters, from the receptance at its tip.

====================  ===========================================================================
``zero_order``        cuts by their mean over a revolution: depths at the limit of stability
``lobes_result``      limit of the depth over speed, and the verdict at the scene's speed
``lobes_picture``     that limit, drawn
``stability``         `lobes`: the limit of a scene over its speeds
====================  ===========================================================================
"""
