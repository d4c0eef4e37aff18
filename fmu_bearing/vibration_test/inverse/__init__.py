"""The inverse of the vibration test: the law of the surfaces from measured bands and lines.

==============  ==========================================================================
``runs``        spectra by source, from which the energies of all laws follow; kept on disk
``energies``    energies per order in bands and lines
``measured``    measured values, checked, with their standard deviations
``posterior``   draws of the law that explain them: importance sampling
``remarks``     what to know of a surface, and values that none explains
==============  ==========================================================================
"""

from collections.abc import Mapping

from fmu_bearing.scene import Scene, SceneSource
from fmu_bearing.scene.imperfections import ASSUMED_EXPONENTS
from fmu_bearing.scene.surface import Surface, check_taken
from fmu_bearing.vibration_test.anderon import Unit, micrometres
from fmu_bearing.vibration_test.inverse.energies import energies
from fmu_bearing.vibration_test.inverse.measured import DEVIATION, Measured, check, measured
from fmu_bearing.vibration_test.inverse.posterior import DRAWS, Draws, Prior, posterior
from fmu_bearing.vibration_test.inverse.remarks import check_met, remarks
from fmu_bearing.vibration_test.inverse.runs import AMPLITUDE_UM, Bar, Spectra, spectra
from fmu_bearing.vibration_test.rig import BANDS, Piece, rig
from fmu_bearing.vibration_test.subject import subject

_AMPLITUDES = (1e-3, 20.0)  # um: A_1 of any surface
_BELOW, _ABOVE = 8.0, 2.0  # form of the balls, and A_1 below limits: an eighth to twice the grade's, assumed


def surface(
    bearing: SceneSource,
    L: float | None = None,  # noqa: N803 - the names of the bands
    M: float | None = None,  # noqa: N803
    H: float | None = None,  # noqa: N803
    *,
    lines: Mapping[str, float] | None = None,
    deviation: float = DEVIATION,
    at_most: bool = False,
    unit: Unit = "um/s",
    exact_law: bool = False,
    kind: str | None = None,
    grade: str | None = None,
    piece: Piece = "soft",
    speed_rpm: float | None = None,
    load_N: float | None = None,
    bar: Bar = iter,
) -> Surface:
    """Find the surfaces of a bearing from the vibration test of its supplier.

    The first time it runs the tests of each source by itself, about 210 runs (160 s of a processor for the
    7003C), and keeps their spectra. Then it takes seconds.

    Parameters
    ----------
    bearing : Scene, path or str
        A scene or its file (``.toml``), of a set its bearing; or a bearing of the catalogue by name.
    L, M, H : float, optional
        Measured rms velocities of the bands, in ``unit``.
    lines : mapping of str to float, optional
        Lines of the tester's spectrum by name, as ``{"f_i - f_r": 9.0}``: um/s rms.
    deviation : float
        Relative standard deviation of the values; of M 0.38 at least.
    at_most : bool
        Whether L, M and H are limits that the bearing meets.
    unit : str
        Of L, M and H: ``"um/s"`` or ``"anderon"``.
    exact_law : bool
        Whether every order has the law's amplitude; default: orders scatter about it.
    kind, grade : str, optional
        Materials of a bearing by name, tolerance class; as `vibration` takes them. The grade's form of the
        balls and, below limits, its amplitude set the bounds.
    piece, speed_rpm, load_N
        Loading piece, speed and axial load of the test.
    bar : callable
        Wraps the list of runs, to show progress.

    Returns
    -------
    Surface
        With 1,000 equally likely draws.

    Raises
    ------
    ValueError
        For values that are no test's, fewer than two, a scene with explicit harmonics or without
        imperfections, and values that no law from p = 0.9 to 2.1 explains.

    Examples
    --------
    >>> from fmu_bearing import surface
    >>> found = surface("7003C", L=41.0, M=42.0, H=54.0)
    >>> 1.3 < found.law.exponent.median < 1.5
    True
    """
    given = subject(bearing, kind, grade)
    check_taken(given.imperfections, given.name)
    tested = rig(given, piece=piece, speed_rpm=speed_rpm, load_N=load_N)  # refused before the runs
    scale = micrometres(tested, unit)
    bands = {name: value for name, value in zip(BANDS, (L, M, H), strict=True) if value is not None}
    bands = {name: value * scale[name] for name, value in bands.items()}
    check(bands, dict(lines or {}), deviation)
    found = spectra(given, piece, speed_rpm, load_N, bar)
    asked = measured(found, bands, dict(lines or {}), deviation, at_most)
    return from_spectra(found, given, asked, exact_law, DRAWS)


def from_spectra(found: Spectra, bearing: Scene, given: Measured, exact_law: bool, draws: int) -> Surface:
    """Find the surfaces of a bearing from measured values and the spectra of its sources.

    Raises
    ------
    ValueError
        For values that no law explains.
    """
    prior = prior_of(bearing, given, found.form_nm)
    drawn = posterior(energies(found, given.windows), given.values, prior, not exact_law, draws)
    check_met(drawn, prior, given)
    made = surface_of(bearing, given, drawn, exact_law)
    words = tuple(remarks(made, drawn, prior, given, found))
    return surface_of(bearing, given, drawn, exact_law, words)


def prior_of(bearing: Scene, given: Measured, form_nm: float) -> Prior:
    """Return the bounds of what is searched: those of the assumed law where there are limits alone."""
    form = (form_nm / _BELOW, form_nm * _ABOVE)
    if not all(value.at_most for value in given.values):
        return Prior(_AMPLITUDES, form)
    assert bearing.imperfections is not None
    own = bearing.imperfections.inner_race_amplitude_um or AMPLITUDE_UM
    return Prior((own / _BELOW, own * _ABOVE), form, ASSUMED_EXPONENTS)


def surface_of(
    bearing: Scene, given: Measured, drawn: Draws, exact_law: bool, words: tuple[str, ...] = ()
) -> Surface:
    """Return draws as a surface."""
    return Surface(
        bearing.bearing.designation or bearing.name, given.words, drawn.amplitude_um, drawn.exponent,
        drawn.ball_form_nm, drawn.seed, None if exact_law else drawn.scatter, words,
    )  # fmt: skip
