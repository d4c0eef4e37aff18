"""Values of variables over time: their names, tables, files, spectra and pictures.

==================  ===========================================================================
``variable_names``  names of variables, with patterns and suggestions
``base``            the base of all results: values with units, from which JSON, tables and files follow
``table``           tables to terminal, Markdown, CSV; the machine they were made on
``column_units``    units of columns as people write them
``rows``            rows and columns of CSV files: separators, decimal commas, titles with units
``even_steps``      whether times and frequencies are evenly spaced
``levels``          sound levels as they are drawn: absent before metering begins
``picture_parts``   colours, labels and files of all pictures
``spectra``         spectra of variables and of microphones, with names and units
``series``          variables over time, with names and units
``time_pictures``   pictures of them
``balls``           place, load and angle of every ball, read from the state
``rates``           how fast the balls orbit and spin, read from the state
``defect_lines``    lines that local defects make, by their names
``uff``             universal files, for programs of modal analysis: signals, responses, mode shapes
``result``          `Run`: the results of a run, as CSV, netCDF, xarray, pandas; its pictures and spectra
==================  ===========================================================================
"""
