"""The section about modes, and a page of its own.

``campbell_chart``   Campbell diagram, tables of modes and of crossings
``moving_shapes``    shapes of modes, for the script that moves them
``modes_section``    the section, and `modes_page`
"""
