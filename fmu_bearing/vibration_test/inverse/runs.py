"""Spectra of the vibration test by source, from which the energies of all laws follow; kept on disk.

The answer of a race is linear in its waves. One run has all orders of the inner race, which sound apart.
Orders of the outer race share lines: each run has those that differ by whole numbers of balls. The form of
the balls is drawn from many seeds and at three exponents, with rigid rings, which costs an eighth; some seeds
are run with rings that bend, too, for the ratio of the two, which hardly depends on the exponent.
"""

import hashlib
import math
import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.engine.sources import rooms_digest, source_hash
from fmu_bearing.files import cache_root, read_arrays
from fmu_bearing.prepare.imperfections import race_harmonics
from fmu_bearing.scene import Scene
from fmu_bearing.scene.imperfections import RACES, Harmonic
from fmu_bearing.scene.read import with_fidelity
from fmu_bearing.vibration_test.reading import reading
from fmu_bearing.vibration_test.rig import BENDING, Piece, rig

#: Law of both races in these runs: amplitude A_1 (um) and exponent. What is found does not depend on them.
AMPLITUDE_UM, EXPONENT = 0.3, 1.35
#: Exponents at which the form of the balls is run: the ends of what is searched, and the middle.
BALL_EXPONENTS = (0.9, 1.5, 2.1)
#: Draws of the axes of the balls. With eight, results depend on which: one ball form makes most of M.
BALL_SEEDS = 64
#: Of these with rings that bend, at one exponent: the ratio varies by 40 % in energy from seed to seed.
BENT_SEEDS = 12
BENT_AT = 1  # place in `BALL_EXPONENTS`
_MOST = 200  # harmonics of a race that a scene may have
_ROUND_FORM = 80.0  # nm: of balls whose scene says that they are round
_FOLDER = "vibration"
#: A run: its name and its scene.
Run = tuple[str, Scene]
#: Wraps the list of runs, and yields them.
Bar = Callable[[Sequence[Run]], Iterable[Run]]


@dataclass(frozen=True, eq=False)
class Spectra:
    """Energies (um/s)^2 of the bins of the vibration test, by source.

    Attributes
    ----------
    scene : Scene
        Of the test, with the law of `AMPLITUDE_UM` and `EXPONENT`.
    form_nm : float
        Form of the balls in these runs.
    frequency : ndarray, shape (bins,)
        In Hz.
    orbit : float
        Speed at which the balls orbit, over the shaft's.
    inner : ndarray, shape (bins,)
        Of the inner race.
    outer : ndarray, shape (runs, bins)
        Of the orders of the outer race that are ``residues`` more than whole numbers of balls.
    residues : ndarray of int, shape (runs,)
    rigid : ndarray, shape (exponents, seeds, bins)
        Of the form of the balls, rings rigid.
    bent : ndarray, shape (some seeds, bins)
        The same of the first `BENT_SEEDS` seeds at the exponent `BENT_AT` with rings that bend.
    """

    scene: Scene
    form_nm: float
    frequency: NDArray[np.float64]
    orbit: float
    inner: NDArray[np.float64]
    outer: NDArray[np.float64]
    residues: NDArray[np.int64]
    rigid: NDArray[np.float64]
    bent: NDArray[np.float64]


_ARRAYS = ("frequency", "inner", "outer", "residues", "rigid", "bent")


def spectra(
    bearing: Scene, piece: Piece = "soft", speed_rpm: float | None = None, load_N: float | None = None,
    bar: Bar = iter,
) -> Spectra:  # fmt: skip
    """Return the spectra of a bearing, from disk where they were made before.

    Parameters
    ----------
    bearing : Scene
        With imperfections, whose law and seeds do not count.
    piece, speed_rpm, load_N
        As `rig` takes them.
    bar : callable
        Wraps the list of runs, to show progress.
    """
    first, form = _reference(bearing)
    made = _Runs(first, form, {"piece": piece, "speed_rpm": speed_rpm, "load_N": load_N})
    path = cache_root() / _FOLDER / f"{_key(made.rig(first))}.npz"
    return _load(path, made) or _save(path, _run(made, bar))


def _reference(bearing: Scene) -> tuple[Scene, float]:
    """Return the bearing with the law of the runs, no imperfection beside it, and the form of its balls."""
    flaws = bearing.imperfections
    assert flaws is not None, "a bearing under test has imperfections"
    form = flaws.ball_form_nm or _ROUND_FORM
    law = {f"imperfections.{race}_race_amplitude_um": AMPLITUDE_UM for race in RACES}
    rest: dict[str, Any] = {
        "unbalance_um": 0.0, "ball_diameter_spread_nm": 0.0, "ball_waviness_nm": 0.0, "ball_form_nm": form,
        "order_scatter_seed": None, "highest_order": None, "waviness_exponent": EXPONENT, "seed": 0,
        "defect": (),
    }  # fmt: skip
    return bearing.replace(law | {f"imperfections.{key}": value for key, value in rest.items()}), form


@dataclass(frozen=True)
class _Runs:
    """Scenes of the runs."""

    scene: Scene
    form: float
    options: dict[str, Any]

    def rig(self, scene: Scene, rigid: bool = False) -> Scene:
        """Return the test of a scene."""
        return rig(scene, rigid=rigid, **self.options)

    def inner(self) -> Scene:
        """Return the test of the inner race alone."""
        return self._alone("inner race")

    def outer(self) -> Iterator[tuple[int, Scene]]:
        """Yield the tests of orders of the outer race that share no line, with their residue."""
        first = self._alone("outer race")
        count = first.bearing.ball_count
        waves = race_harmonics(first)[1]
        for residue in sorted({m % count for m in _lobes()}):
            own = np.flatnonzero(waves.orders % count == residue)
            for begin in range(0, own.size, _MOST):
                harmonics = [
                    Harmonic(
                        order=int(waves.orders[k]),
                        amplitude_um=1e6 * float(waves.amplitudes[k]),
                        phase_deg=math.degrees(float(waves.phases[k])),
                    )
                    for k in own[begin : begin + _MOST]
                ]
                yield residue, first.replace({
                    "imperfections.outer_race_amplitude_um": None,
                    "imperfections.outer_race_harmonic": harmonics,
                })  # fmt: skip

    def balls(self, exponent: float, count: int, rigid: bool) -> Iterator[Scene]:
        """Yield the tests of the form of the balls alone, by seed."""
        alone = self._alone("form of the balls", rigid)
        for seed in range(count):
            law = {"imperfections.waviness_exponent": exponent, "imperfections.seed": seed}
            yield alone.replace(law)

    def _alone(self, source: str, rigid: bool = False) -> Scene:
        assert self.scene.imperfections is not None
        alone = self.scene.model_copy(update={"imperfections": self.scene.imperfections.alone(source)})
        return self.rig(with_fidelity(alone, model="rings") if rigid else alone, rigid)


def _lobes() -> range:
    """Lobes with which the outer ring moves and bends."""
    return range(-BENDING[-1], BENDING[-1] + 1)


def _run(made: _Runs, bar: Bar) -> Spectra:
    outer = list(made.outer())
    scenes: list[Run] = [("inner race", made.inner()), *(("outer race", one) for _, one in outer)]
    middle = BALL_EXPONENTS[BENT_AT]
    scenes += [("balls, rings that bend", one) for one in made.balls(middle, BENT_SEEDS, rigid=False)]
    for exponent in BALL_EXPONENTS:
        scenes += [("balls", one) for one in made.balls(exponent, BALL_SEEDS, rigid=True)]
    readings = [reading(scene) for _, scene in bar(scenes)]
    energies = np.array([one.energy for one in readings])
    bent_from = 1 + len(outer)
    rigid_from = bent_from + BENT_SEEDS
    return Spectra(
        made.rig(made.scene), made.form, readings[0].frequency, readings[0].orbit, energies[0],
        energies[1:bent_from], np.array([residue for residue, _ in outer]),
        energies[rigid_from:].reshape(len(BALL_EXPONENTS), BALL_SEEDS, -1), energies[bent_from:rigid_from],
    )  # fmt: skip


def _key(scene: Scene) -> str:
    """Digest (24 hex digits) of the scene of the test and of the code that runs it."""
    code = f"{source_hash()} {rooms_digest('elastic', 'formulas', 'prepare')} {np.__version__}"
    runs = f"{BALL_EXPONENTS} {BALL_SEEDS} {BENT_SEEDS} {BENT_AT}"
    named = scene.model_copy(update={"name": "test"})
    return hashlib.sha256(f"{named.model_dump_json()} {code} {runs}".encode()).hexdigest()[:24]


def _load(path: Path, made: _Runs) -> Spectra | None:
    """Return kept spectra; None: there are none, or they are damaged."""
    try:
        kept = read_arrays(path)
        arrays = {name: kept[name] for name in _ARRAYS}
        orbit = float(kept["orbit"])
    except (OSError, ValueError, KeyError):
        return None
    shape = (len(BALL_EXPONENTS), BALL_SEEDS, arrays["frequency"].size)
    if arrays["rigid"].shape != shape or not all(np.isfinite(one).all() for one in arrays.values()):
        return None
    return Spectra(made.rig(made.scene), made.form, orbit=orbit, **arrays)


def _save(path: Path, spectra: Spectra) -> Spectra:
    """Keep spectra; a cache that cannot be written is no reason to fail."""
    small = {"inner", "outer", "rigid", "bent"}  # seven digits are enough
    arrays = {
        name: getattr(spectra, name).astype(np.float32) if name in small else getattr(spectra, name)
        for name in _ARRAYS
    }
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        partial = path.with_suffix(f".{os.getpid()}.npz")
        np.savez(partial, orbit=spectra.orbit, **arrays)
        partial.replace(path)
    except OSError:
        pass
    return spectra
