"""FMI 2.0 co-simulation of the bearing, compiled or run by Python.

============== =====================================================================================
description    the table of variables as ``modelDescription.xml``; GUID
units          units and display units in the terms of FMI
documentation  the pages inside the FMU
reference      results of a short run inside the FMU
resources      scene and parameter array inside the FMU, and the fingerprint that binds them
package        writes the FMU: deterministic zip, in one of two flavours
native/        flavour native: kernels compiled ahead of time, shim in C, ``model.bin``
session        phases, value references and refusals around one ``Instance``
state          state of an instance as an object and as bytes
python_slave   the pythonfmu slave that the stub inside the FMU inherits from
host           ends the interpreter in hosts that are not Python
icon           draws ``model.png``
============== =====================================================================================

Building: ``scene -> prepare -> package.build``. A native FMU needs nothing but its library, which reads
``model.bin``. In a Python FMU (session, state, python_slave, host) pythonfmu's library imports the stub from
the FMU's resources, the stub imports ``python_slave``, which reads ``resources`` and drives a ``session``.
"""
