"""WHAT is simulated: frozen models read from TOML, in the units of the field.

================  =====================================================================
``bearing``       geometry of rings, balls and cage
``material``      elastic and thermal constants; catalogue names
``lubricant``     oil, traction and film constants
``mounting``      preload, loads, pedestal, rotor, housing
``imperfections`` waviness, ball spread, unbalance, with a seed
``sound``         what radiates, how it is computed, where the microphones stand
``fidelity``      level, tolerance, terms left out
``scene``         all of it together, with the checks that span several parts
``read``          TOML in, one-line errors out
``units``         the one place that converts to SI
================  =====================================================================
"""

from fmu_bearing.scene.read import SceneError, read_scene, read_scene_text
from fmu_bearing.scene.scene import Scene
from fmu_bearing.scene.units import si

__all__ = ["Scene", "SceneError", "read_scene", "read_scene_text", "si"]
