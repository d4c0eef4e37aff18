"""The table of variables: name, unit, causality, range, description, place in the engine's flat arrays.

The FMU's XML and value references, ``get`` and ``set`` of the library, and the table in the documentation are
all made from it. Names are a contract, because users' harnesses depend on them.

===================  =================================================================
``variable``         one variable, and defaults for its unit
``inputs``           speed, loads, temperatures and other inputs, and their values
``outputs``          outputs and local variables, computed in each step
``bearing_outputs``  those of one bearing
``microphones``      those of microphones
``accelerometers``   those of accelerometers
``parameters``       parameters, set before initialisation, and constants
``table``            all variables, in the order of the value references
``names``            patterns of names, and suggestions for misspelt ones
``fmu_names``        the table as the FMU of a scene shows it
===================  =================================================================
"""

from fmu_bearing.interface.fmu_names import flat, fmu_variables
from fmu_bearing.interface.parameters import RADIATORS
from fmu_bearing.interface.table import variables
from fmu_bearing.interface.variable import Variable

__all__ = ["RADIATORS", "Variable", "flat", "fmu_variables", "variables"]
