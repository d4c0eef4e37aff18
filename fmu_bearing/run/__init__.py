"""Runs: from a scene and its inputs to the values of its variables.

================  ===========================================================================
``names``         names of variables, with patterns and suggestions
``table``         tables to terminal, Markdown, CSV; rows of CSV files; the machine they were made on
``levels``        sound levels as they are drawn: absent before metering begins
``spectrum``      spectra of variables and of microphones, with names and units
``result``        `Run`: the results of a run, as CSV, netCDF, xarray, pandas; its pictures and spectra
``input_file``    CSV files of inputs: columns, units, decimal commas
``inputs``        inputs over time, checked against their ranges
``settings``      `Setting`: one way to compute a scene
``balls``         place, load and angle of every ball, read from the state
``arrays``        a bearing as flat arrays, for loops that read and restore the state
``metrics``       figures that compare runs, and the speed of a run
``choose``        fidelity ``auto``: the cheapest within the scene's accuracy, found by running it
``doubts``        what natural motions say about fidelities rings and response, asked of `modal`
``simulate_fmu``  a run of an FMU, by FMPy
``simulate``      `simulate`: a run over given inputs
``bearing``       `Bearing`: to initialise and step by hand
``build``         `build_fmu`: the FMU of a scene in one call
``pictures``      colours, labels and files of all pictures
``time_pictures`` variables over time
================  ===========================================================================
"""
