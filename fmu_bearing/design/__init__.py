"""What a designer asks of a bearing: ratings, operating point, verdicts.

===================  ================================================================
``rating``           ratings and makers' limits of the bearing of a scene
``operating_point``  a bearing at its operating point, without a run
``verdicts``         figure, limit, source and judgement of what a designer asks
===================  ================================================================
"""
