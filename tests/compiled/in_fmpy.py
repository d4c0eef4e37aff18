"""An FMU in FMPy: a run, then a state that is kept, left and taken again. ``python in_fmpy.py FILE.fmu``

Run by an environment that holds a wheel and what it needs, and nothing else.
"""

import sys

import numpy as np
from fmpy import extract, read_model_description, simulate_fmu
from fmpy.fmi2 import FMU2Slave

STEP = 1e-3  # s
NAMES = ("friction_torque", "inner_ring.velocity.z", "heat.oil")


def main():
    """Run the FMU named on the command line; a wrong value ends it with the reason."""
    file = sys.argv[1]
    result = simulate_fmu(file, stop_time=5 * STEP, output_interval=STEP, output=list(NAMES))
    for name in NAMES:
        check(np.all(np.isfinite(result[name])), f"{name} has values that are not finite")
    # the order of a spindle bearing without much load: N.mm to tenths of N.m
    check(1e-4 < result["friction_torque"][-1] < 1.0, "friction_torque is not that of a bearing")
    states(file)


def states(file):
    """Step, go back to a kept state and to its bytes, and step again: every bit is equal."""
    about = read_model_description(file)
    numbers = [one.valueReference for one in about.modelVariables if one.name in NAMES]
    fmu = FMU2Slave(
        guid=about.guid,
        unzipDirectory=extract(file),
        modelIdentifier=about.coSimulation.modelIdentifier,
        instanceName="first",
    )
    fmu.instantiate()
    fmu.setupExperiment(startTime=0.0)
    fmu.enterInitializationMode()
    fmu.exitInitializationMode()
    fmu.doStep(0.0, STEP)
    state = fmu.getFMUState()
    written = fmu.serializeFMUState(state)

    def onwards():
        values = []
        for k in (1, 2):
            fmu.doStep(k * STEP, STEP)
            values.append(fmu.getReal(numbers))
        return values

    first = onwards()
    fmu.setFMUState(state)
    check(onwards() == first, "a state that was kept does not go on as before")
    again = fmu.deserializeFMUState(written)
    fmu.setFMUState(again)
    check(onwards() == first, "a state from its bytes does not go on as before")
    fmu.freeFMUState(state)
    fmu.freeFMUState(again)
    fmu.terminate()
    fmu.freeInstance()


def check(right, problem):
    """End the process with a reason unless all is right."""
    if not right:
        sys.exit(f"error: {problem}")


if __name__ == "__main__":
    main()
