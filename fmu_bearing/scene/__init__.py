"""Scenes: frozen models of what is simulated, read from TOML, in the units of the field.

================  =====================================================================
``catalogue``     files: bearings, materials, lubricants, grades, and NSK's sizes with printed ratings
``estimate``      a bearing from its boundary dimensions
``nsk``           NSK's sizes: printed figures, derived balls, entries of the catalogue
``deep_groove``   deep groove bearings of series 60, 62, 63: printed ratings, derived balls, entries
``dimension_series`` boundary dimensions by series (ISO 15)
``conformity``    conformities that give a printed stiffness
``symbols``       what the signs of makers' designations mean, with sources
``designation``   what a designation says; which name a misspelt or short one may mean
``entries``       entries by name: the package's, makers' sizes, those of users' files
``own_bearing``   a bearing of one's own: dimensions, what its designation says, its balls
``preload``       newtons of a preload class or of an offset of the ring faces
``template``      the text of a new scene
``set_template``  its tables of a set of bearings on one shaft
``words``         a scene in a line: materials, supply, temperatures, no preload
``base``          base class of all tables: frozen, strict, reports all conflicts at once; `SceneError`
``bearing``       geometry of rings, balls and cage
``seal``          its seals: kind, diameter of the lips, or their torque
``material``      elastic and thermal constants; catalogue names
``lubricant``     oil, traction and film constants
``mounting``      preload, loads, pedestal, rotor, housing, bending of the rings
``spindle``       a set of bearings on one shaft, in the place of a mounting
``shaft``         its shaft, in sections or of another model
``housing``       the housing of a set where it radiates: its place, what it needs
``tool``          the tool on the nose, and the cut that it takes
``imperfections`` waviness, ball spread, unbalance, by values or by grade, with a seed
``defect``        local defects of races and balls: shape, size, place
``defect_conflicts`` what does not fit between them and their bearing
``surface``       `Surface`: the law of surfaces found from a measurement, with its uncertainty
``surface_file``  its file, and the median law for scenes that name it
``operation``     speed and temperatures at the start
``sound``         radiator, radiation model, metering, microphones
``accelerometer`` sensors on outer rings and housings
``fidelity``      physics, integrator, accuracy, terms left out
``fmu``           names, inputs and outputs of the FMU
``scene``         all tables together, with the checks that span several tables
``assembly``      what holds them together: shaft, preload, where the file has them
``member``        the bearings of a scene, each as the scene of a single one
``seats``         fits of the rings: the tables of the seats
``fit``           interferences by classes, partners of the rings
``fit_conflicts`` what does not fit together with fits
``fit_file``      fits in the file: the class by grade, preloads of the loose bearing
``exclusions``    what a scene cannot have, why, and the way out
``toml_text``     syntax of TOML, with lines and keys in its errors
``problems``      error messages, one line per problem, with the keys of the file
``origins``       where each value comes from, and which are assumed
``values``        values by dotted key: read, put in, compared
``read``          `Scene`: from TOML or dictionaries, or changed; catalogue names become values
``units``         conversion of field units to SI
================  =====================================================================
"""

from fmu_bearing.scene.base import SceneError
from fmu_bearing.scene.read import Scene, SceneSource, read_scene, read_scene_text, scene_of
from fmu_bearing.scene.units import si

__all__ = ["Scene", "SceneError", "SceneSource", "read_scene", "read_scene_text", "scene_of", "si"]
