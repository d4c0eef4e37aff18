"""FMI 2.0 co-simulation of the bearing, compiled or run by Python.

=================  ===================================================================================
``units``          units and display units in the terms of FMI
``fmu_model``      a model with its variables as the FMU shows them
``description``    the table of variables as ``modelDescription.xml``; GUID
``terminals``      variables that belong to one connection, as ``terminalsAndIcons.xml``
``documentation``  the pages inside the FMU
``icon``           draws ``model.png``
``resources``      scene and parameter array inside the FMU, and the fingerprint that binds them
``reference``      results of a short run inside the FMU
``native``         flavour native: kernels compiled ahead of time, shim in C, ``model.bin``
``package``        writes the FMU: deterministic zip, in one of two flavours
``state``          state of an instance as an object and as bytes
``session``        phases, value references and refusals around one ``Instance``
``python_slave``   the pythonfmu slave that the stub inside the FMU inherits from
``host``           ends the interpreter in hosts that are not Python
=================  ===================================================================================

Building: ``scene -> prepare -> package.build``. A native FMU needs nothing but its library, which reads
``model.bin``. In a Python FMU (session, state, python_slave, host) pythonfmu's library imports the stub from
the FMU's resources, the stub imports ``python_slave``, which reads ``resources`` and drives a ``session``.
"""
