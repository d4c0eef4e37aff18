"""The grooves of a bearing from the axial stiffness that its maker prints."""

import math
from numbers import Real
from typing import NamedTuple

from fmu_bearing.scene.base import SceneError
from fmu_bearing.scene.bearing import Bearing
from fmu_bearing.scene.preload import elastic_of
from fmu_bearing.scene.problems import shown
from fmu_bearing.scene.read import SceneSource, scene_of
from fmu_bearing.scene.values import limits

#: What a stiffness is printed of, and how many bearings hold the shaft there.
HOLDERS = {"pair": 2, "bearing": 1}


class Conformities(NamedTuple):
    """Groove radius over ball diameter of both races."""

    inner: float
    outer: float


def conformity_from_stiffness(
    scene: SceneSource, stiffness_N_um: float, preload_N: float, *, of: str = "pair", offset: float = 0.0
) -> Conformities:
    """Return the conformities with which a scene's bearing has the axial stiffness that its maker prints.

    The rings are rigid and at rest and move along the axis; contacts follow Hertz, and the contact angle
    grows with the load (Harris 2006). A
    rigid pair that faces each other is twice as stiff as each of its bearings under its preload. Axial
    stiffness determines the sum of both conformities alone; ``offset`` divides it.

    Parameters
    ----------
    scene : Scene or path
        Number and diameter of the balls, pitch diameter, contact angle and materials are taken from it. The
        stiffness has to be that of a bearing with these materials: ceramic balls are stiffer by a tenth.
    stiffness_N_um : float
        Axial stiffness as printed, N/um; a scalar.
    preload_N : float
        Preload it is printed for, N; a scalar. Of a pair that of each bearing, which is the pair's.
    of : str
        ``"pair"``: of two rigidly preloaded bearings; ``"bearing"``: of one under a constant axial force.
    offset : float
        Outer minus inner conformity; 0: one number for both races. Bearings from dimensions have 0.005.

    Returns
    -------
    Conformities
        ``inner``, ``outer``; the forward computation returns the stiffness to 1e-6 of it.

    Raises
    ------
    SceneError
        If the file cannot be read; for a stiffness or a preload that is not positive; for a stiffness that no
        conformity a scene may have gives at this preload, with the range that they give.

    Examples
    --------
    >>> from fmu_bearing import conformity_from_stiffness, read_scene
    >>> scene = read_scene("examples/scenes/7003C-spindle.toml").replace({"materials.balls": "GCr15"})
    >>> found = conformity_from_stiffness(scene, 25.0, 40.0)
    >>> round(found.inner, 4), found.outer == found.inner
    (0.5217, True)
    >>> found = conformity_from_stiffness(scene, 12.5, 40.0, of="bearing", offset=0.005)
    >>> round(found.inner, 4), round(found.outer, 4)
    (0.5193, 0.5243)
    """
    found = scene_of(scene)
    if of not in HOLDERS:
        raise SceneError(f"a stiffness is of a {' or a '.join(HOLDERS)}, not of '{of}'")
    for words, value, unit in (("stiffness", stiffness_N_um, "N/um"), ("preload", preload_N, "N")):
        if not isinstance(value, Real) or not 0.0 < value < math.inf:
            raise SceneError(f"{words} {shown(value)} {unit} is refused: allowed are positive finite numbers")
    from fmu_bearing.formulas.axial import StiffnessRange, conformities  # with SciPy, which few scenes need

    b, m = found.bearing, found.materials
    if b.is_deep_groove:
        raise SceneError(
            f"{found.name}: makers print no axial stiffness of deep groove bearings; give "
            "bearing.inner_conformity and bearing.outer_conformity"
        )
    low, high = limits(Bearing.model_fields["inner_conformity"])
    if not abs(offset) < high - low:
        raise SceneError(
            f"offset {offset:g} of the outer conformity is refused: allowed are less than {high - low:.4g}, "
            f"as conformities of {low:g} to {high:g} are"
        )
    count = HOLDERS[of]
    elastic = elastic_of(m.inner_ring), elastic_of(m.outer_ring), elastic_of(m.balls)
    shape = b.ball_count, b.ball_diameter_mm, b.pitch_diameter_mm, b.nominal_angle_deg
    try:
        return Conformities(
            *conformities(stiffness_N_um / count, preload_N, *shape, elastic, offset, (low, high))
        )
    except StiffnessRange as problem:
        raise SceneError(
            f"stiffness {stiffness_N_um:g} N/um of a {of} at {preload_N:g} N is refused: conformities of "
            f"{low:g} to {high:g} give {count * problem.least:.4g} to {count * problem.most:.4g} N/um with "
            f"{b.ball_count} balls of {b.ball_diameter_mm:g} mm at {b.nominal_angle_deg:g} deg ({m.kind}); "
            "check the preload, whether it is of a pair or of one bearing, materials and balls"
        ) from None
