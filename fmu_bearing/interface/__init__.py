"""THE table of variables: name, unit, causality, range, sentence, place in the engine's flat arrays.

Everything people meet by name comes from here: the FMU's XML and value references, the library's ``get``
and ``set``, the documentation's table. Names are a contract: harnesses depend on them.

==============  ======================================================================
``variable``    one variable, and what is usual for its unit
``inputs``      what drives the bearing
``outputs``     what is read after each step: outputs and local variables
``parameters``  what is set before initialisation, and constants
``table``       all of it, in the order of the value references
==============  ======================================================================
"""

from fmu_bearing.interface.parameters import RADIATORS
from fmu_bearing.interface.table import variables
from fmu_bearing.interface.variable import Variable

__all__ = ["RADIATORS", "Variable", "variables"]
