"""Status codes: what `init` and `step` return."""

OK = 0
NOT_CONVERGED = 1  # the step did not converge at the smallest internal step
BAD_INPUT = 2  # an input is not finite or out of range
BAD_STEP = 3  # communication step not positive or not finite
NO_START = 4  # the quasi-static start did not converge
TOO_SOFT = 5  # the loads push the outer ring sideways by more than 0.3 of the pitch radius
RIGID_ONLY = 6  # flexible rings, and a fidelity that knows rigid ones only
OTHER_FIDELITY = 7  # a fidelity that the parameters of this set of bearings were not made for
DEEP_DEFECT = 8  # a local defect in which loaded balls leave a race, and fidelity rings
