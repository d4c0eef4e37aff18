"""What a designer asks of a bearing: ratings, operating point, verdicts.

===================  ================================================================
``rating``           ratings and makers' limits of the bearing of a scene
``operating_point``  a bearing at its operating point, without a run
``set_points``       the bearings of a set at their operating points, and the life of all
``set_stiffness``    static stiffness of a set at its nose over speed and preload
``verdicts``         figure, limit, source and judgement of what a designer asks
``fresh``            `new_scene`: a scene at an operating point that the verdicts find good
===================  ================================================================
"""
