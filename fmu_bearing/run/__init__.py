"""Runs: from a scene and its inputs to the values of its variables.

================  ===========================================================================
``input_file``    CSV files of inputs: columns, units, decimal commas
``inputs``        inputs over time, checked against their ranges
``settings``      `Setting`: one way to compute a scene
``march``         a bearing stepped from point to point, read at each; progress, Ctrl-C
``figures``       figures of a run: the table of their names, units and how they are read
``metrics``       figures that compare runs
``paces``         the speed of a run, with constant inputs and with inputs that move
``conditions``    speeds under which candidates of fidelity ``auto`` are compared
``choose``        fidelity ``auto``: the cheapest within the scene's accuracy, found by running it
``simulate_fmu``  a run of an FMU, by FMPy
``simulate``      `simulate`: a run over given inputs
``bearing``       `Bearing`: to initialise and step by hand
``build``         `build_fmu`: the FMU of a scene in one call
``realtime``      `realtime`: what communication steps cost beside the clock
``step_times``    its result: table and advice
================  ===========================================================================
"""
