"""What people do with a bearing: run it beside slower, surer methods, vary it, look at it.

``arrays``       a bearing on bare flat arrays, for loops that need the state itself
``first_order``  level ``full`` as x' = g(t, x), for general-purpose integrators
``reference``    the trajectory that other results are held against, by two integrators
"""
