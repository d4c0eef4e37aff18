"""A run: from a scene and its inputs to the values of its variables.

================  ===========================================================================
``extras``        packages that only some commands need
``names``         variables as people write them
``table``         tables to terminal, Markdown, CSV; the machine they were made on
``result``        `Run`: what a run leaves behind, as CSV, netCDF, xarray
``inputs``        inputs over time, held against their ranges
``settings``      `Setting`: one way to compute a scene
``arrays``        a bearing on bare flat arrays, for loops that need the state itself
``metrics``       the figures by which runs are compared, and the pace of a run
``choose``        fidelity ``auto``: the cheapest within the scene's accuracy, found by running it
``simulate_fmu``  a run of an FMU, by FMPy
``simulate``      `simulate`: a run over given inputs
``bearing``       `Bearing`: to initialise and step by hand
``build``         `build_fmu`: the FMU of a scene in one call
``pictures``      what all pictures share
``time_pictures`` variables over time
================  ===========================================================================
"""
