"""Error motion of the axis of rotation: what a probe at the nose of a spindle would read, from a run.

================  ==========================================================================
``axis_watch``    what a run's variables do not say: rates of the balls, tilt of a lone outer ring
``nose``          what is read at each part of a revolution: the axis at a point
``line_fit``      amplitudes of lines at known orders, by least squares
``polar_values``  synchronous and asynchronous error motion of a signal over revolutions
``at_speed``      error motion at one speed: directions, lines, parts of bearings and sources
``error_motion``  `error_motion`: a scene over speeds; its tables and files
``polar_plot``    polar plots: revolutions pale, mean contour bold
================  ==========================================================================

Terms follow ISO 230-7 and ASME B89.3.4, from memory: the texts were not at hand.
"""
