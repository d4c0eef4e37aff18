"""The shaft of a set of bearings: its matrices and how its planes move.

=============  ==========================================================================
``sections``   its cylinders
``beam``       the flexible one as a chain of Timoshenko elements, in one plane
``flexible``   the same in a few coordinates: Craig-Bampton on nose and bearings
``model``      matrices of a shaft, and how its planes move
``make``       the shaft of a scene
=============  ==========================================================================
"""

from fmu_bearing.elastic.shaft.make import shaft_model
from fmu_bearing.elastic.shaft.model import ShaftModel, rigid_transform
from fmu_bearing.elastic.shaft.sections import shaft_sections

__all__ = ["ShaftModel", "rigid_transform", "shaft_model", "shaft_sections"]
