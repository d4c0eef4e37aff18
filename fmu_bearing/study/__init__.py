"""What people do with a bearing: run it beside slower, surer methods, vary it, look at it.

``simulate``        `simulate`: a run over given inputs; ``simulate_fmu``: of an FMU, by FMPy
``inputs``          inputs of a run over time, held against their ranges
``run``             `Run`: what it leaves behind, as CSV, netCDF, xarray
``bearing``         `Bearing`: to initialise and step by hand
``build``           `build_fmu`: the FMU of a scene in one call
``names``           variables as people write them
``extras``          packages that only some studies need
``arrays``          a bearing on bare flat arrays, for loops that need the state itself
``figures``         the figures by which runs are compared, and the pace of a run
``settings``        `Setting`: one way to compute a scene
``first_order``     level ``full`` as x' = g(t, x), for general-purpose integrators
``reference``       the trajectory that other results are held against, by two integrators
``tradeoff``        what accuracy costs: levels, methods, steps, strips, terms against the reference
``chart``           error against speed, drawn
``choose``          level ``auto``: the cheapest within the scene's accuracy, found by running it
``sensitivity``     what rests on assumed values
``values``          values of a scene by dotted key
``sounding``        scenes that sound alike
``sweep``           a scene over a grid of its values, on all cores or a cluster, resumable
``recording``       `record`: a run with the engine's channels kept
``recorded``        `Recording`: such a run or an FMU's, in files
``heard``           its pressures and levels at any microphone
``sound_measure``   what is measured on a recording: spectra, circles, planes, power, run-ups
``listen``          all that is usually asked of a recording, measured at once
``sound_tables``    such measurements as tables
``sound_pictures``  and as pictures
``time_pictures``   variables over time; ``pictures``: what all pictures share
``validate``        what FMI 2.0 asks of an FMU, checked
``report``          one HTML page about a run
``table``           tables to terminal, Markdown, CSV; the machine they were made on
"""
