"""WHAT is simulated: frozen models read from TOML, in the units of the field.

================  =====================================================================
``base``          what all tables share: frozen, strict, all conflicts reported at once
``units``         the one place that converts to SI
``catalogue``     bearings, materials, lubricants and grades by name
``bearing``       geometry of rings, balls and cage
``material``      elastic and thermal constants; catalogue names
``lubricant``     oil, traction and film constants
``mounting``      preload, loads, pedestal, rotor, housing, bending of the rings
``imperfections`` waviness, ball spread, unbalance, by values or by grade, with a seed
``operation``     speed and temperatures at the start
``sound``         what radiates, how it is computed, where the microphones stand
``fidelity``      physics, integrator, accuracy, terms left out
``scene``         all of it together, with the checks that span several parts
``problems``      one line per problem, in the words of the scene file
``read``          TOML in; catalogue names become values
``values``        values of a scene by dotted key
``origins``       where each value comes from, and which are assumed
``estimate``      a bearing from its boundary dimensions
``template``      the text of a new scene
================  =====================================================================
"""

from fmu_bearing.scene.problems import SceneError
from fmu_bearing.scene.read import read_scene, read_scene_text
from fmu_bearing.scene.scene import Scene
from fmu_bearing.scene.units import si

__all__ = ["Scene", "SceneError", "read_scene", "read_scene_text", "si"]
