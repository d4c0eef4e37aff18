"""What a designer asks of a scene's bearings: ratings, operating point, verdicts.

===================  ================================================================
``rating``           ratings and makers' limits of the bearing of a scene
``heat``             watts by where friction loses them, and by what they warm
``temperatures``     steady temperatures by a network of conductances
``torque_range``     the range beside a friction torque, from what a scene assumes
``operating_point``  a scene's bearings at their operating point, without a run
``mounted``          a bearing on its seats in closed form
``fits``             `fits`: what the tolerances of the seats do, in five columns
``fit_table``        its tables for people
``fit_curves``       its curves over speed and temperature
``fit_pictures``     their pictures
``fit_verdicts``     verdicts on the seats
``measured``         how far figures were from what others measured
``preload_verdicts`` verdicts on the preload, or on the load of a deep groove bearing
``seal_verdicts``    verdict on the lips of the seals
``verdict``          figure, limit, source and judgement
``verdicts``         the verdicts on each bearing, and on all together
``fresh``            `new_scene`: a scene at an operating point that the verdicts find good
===================  ================================================================
"""
