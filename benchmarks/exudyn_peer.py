"""EXUDYN's ball bearing (``exudyn.machines.CreateBallBearing``) with our bearing's geometry and loads.

It has balls of six degrees of freedom, Hertz contact in toroidal grooves, dry friction and a cage on springs;
no oil film, no waviness, a fixed outer ring. It runs at a contact angle of zero, with our ball load from
interference: off the groove's plane its sphere-torus contact (1.13.6) gives even a frictionless ball a force
along the groove, and an angular contact bearing built of it shakes itself apart.
"""

import contextlib
import io
import time
import warnings
from dataclasses import dataclass

import numpy as np

from fmu_bearing.arrays import Arrays
from fmu_bearing.engine.constants import GRAVITY
from fmu_bearing.engine.layout import P, U, Z


@dataclass(frozen=True)
class Run:
    """What one run gave: wall and CPU s for ``simulated`` s, and how far the inner ring moved meanwhile."""

    simulated: float
    wall: float
    cpu: float
    drift: float  # m, inner ring, vertical, over the timed part
    note: str = ""


def version() -> str | None:
    """Version of the installed package, or None."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            import exudyn
            from exudyn.machines import CreateBallBearing  # noqa: F401
    except ImportError:
        return None
    return exudyn.__version__


def timed(bearing: Arrays, step: float, settle: float, duration: float) -> Run:
    """Run a bearing like ``bearing`` (initialised) for ``settle``, then for ``duration`` (s) timed."""
    with warnings.catch_warnings(), contextlib.redirect_stdout(io.StringIO()):
        warnings.simplefilter("ignore")
        return _timed(bearing, step, settle, duration)


def _timed(bearing: Arrays, step: float, settle: float, duration: float) -> Run:
    import exudyn as exu

    system, inner = _build(bearing)
    settings = exu.SimulationSettings()
    settings.solutionSettings.writeSolutionToFile = False
    integration = settings.timeIntegration
    integration.newton.useModifiedNewton = True
    integration.newton.absoluteTolerance = 1e-4
    integration.newton.relativeTolerance = 1e-4
    # the balls stay in contact: its switching logic may not force the step down
    integration.discontinuous.iterationTolerance = 1e3
    integration.discontinuous.useRecommendedStepSize = False
    settings.linearSolverType = exu.LinearSolverType.EigenSparse
    settings.parallel.numberOfThreads = 1
    integration.verboseMode = 0
    places, wall, cpu = [], 0.0, 0.0
    try:
        # at least one step first: it builds what the solver keeps
        settle = max(settle, step)
        for begin, end in ((0.0, settle), (settle, settle + duration)):
            integration.startTime, integration.endTime = begin, end
            integration.numberOfSteps = round((end - begin) / step)
            clock, used = time.perf_counter(), time.process_time()
            system.SolveDynamic(settings, updateInitialValues=True)
            wall, cpu = time.perf_counter() - clock, time.process_time() - used
            places.append(
                system.GetObjectOutputBody(inner, exu.OutputVariableType.Position, [0.0, 0.0, 0.0])[1]
            )
    except Exception as problem:  # its solver raises types of its own
        return Run(duration, float("nan"), float("nan"), float("nan"), f"failed: {type(problem).__name__}")
    return Run(duration, wall, cpu, float(places[1] - places[0]))


def _build(bearing: Arrays):
    """Bearing with its outer ring fixed and its axis along z; returns the system and the inner ring."""
    import exudyn as exu
    from exudyn.machines import CreateBallBearing, GetBallBearingData
    from exudyn.utilities import InertiaCylinder, MarkerBodyRigid

    p, u = bearing.p, bearing.u
    balls, pitch = int(p[P.BALLS]), float(p[P.PITCH_RADIUS])
    radius, speed = 0.5 * float(p[P.DIAMETER]), float(u[U.SPEED])
    races = [p[P.RACES + k * P.RACE_SIZE :][: P.RACE_SIZE] for k in range(2)]
    # the load of our balls, as interference at a contact angle of zero
    load = bearing.z[Z.BEARING_OUTPUTS.index("contact.inner.load_mean")]
    approach = float((load / races[0][P.RACE_STIFFNESS]) ** (2.0 / 3.0))
    data = GetBallBearingData(
        [0, 0, 1], 2.6 * pitch, 1.4 * pitch, 2.2 * radius, balls, radiusBalls=radius, radiusCage=pitch,
        innerGrooveRadius=races[0][P.RACE_GROOVE], outerGrooveRadius=races[1][P.RACE_GROOVE],
    )  # fmt: skip
    data["radiusBalls"] += approach
    system = exu.SystemContainer().AddSystem()
    gravity = [0.0, -GRAVITY, 0.0]
    inertia = InertiaCylinder(1.0, 1.0, 1.0, axis=2)
    inertia.mass = float(p[P.INNER_MASS])
    inertia.inertiaTensor = np.diag([p[P.INNER_TRANSVERSE]] * 2 + [p[P.INNER_POLAR]])
    inner = system.CreateRigidBody(
        referencePosition=[0, 0, 0], nodeType=exu.NodeType.RotationRxyz, inertia=inertia,
        initialAngularVelocity=[0, 0, speed], gravity=gravity,
    )  # fmt: skip
    system.CreateCoordinateConstraint(
        itemNumbers=[inner, None], coordinates=[5, None], velocityLevel=True, offset=speed, show=False
    )
    system.CreateForce(itemNumber=inner, loadVector=[0, -float(np.hypot(u[U.LOAD_Y], u[U.LOAD_Z])), 0])
    ground = system.CreateGround()
    on_inner, on_outer = (
        system.AddMarker(MarkerBodyRigid(bodyNumber=body, localPosition=[0, 0, 0]))
        for body in (inner, ground)
    )
    contact = {
        "contactStiffness": races[0][P.RACE_STIFFNESS],
        "contactStiffnessExponent": 1.5,
        "contactDamping": 1.5 * p[P.CONTACT_DAMPING] * races[0][P.RACE_STIFFNESS] * approach**0.5,
        "dynamicFriction": p[P.MU],
        "frictionProportionalZone": 0.1,
    }
    # rolling without slip: orbit of the balls' centres and their own turning, both absolute
    orbit = 0.5 * speed * (1.0 - radius / pitch)
    spin = -0.5 * speed * (pitch / radius - 1.0)
    density = p[P.BALL_MASS] / (4 / 3 * np.pi * radius**3)
    items = CreateBallBearing(
        system, data, on_inner, on_outer, density, 1400.0, cageInitialAngularVelocity=[0, 0, orbit],
        ballsInitialAngularVelocity=[0, 0, spin], gravity=gravity, springStiffnessCage=1e5,
        springDampingCage=1.0, contactParametersRingBalls=contact,
    )  # fmt: skip
    for place in items["outerRingBallContacts"]:
        system.SetObjectParameter(place, "contactStiffness", races[1][P.RACE_STIFFNESS])
    system.Assemble()
    return system, inner
