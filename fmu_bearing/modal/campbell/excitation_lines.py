"""Excitation lines of a bearing: frequency over speed, and the waves round the bearing that each can move.

Waves of a race pass N balls at once. What they put on a ring is a wave of the order n only where their own
order is a multiple m N of the number of balls, n more or n less; it turns with or against the shaft
accordingly (Wensing 1998; Yhland 1992). The rule is exact for equal balls at equal angles.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.elastic.shaft import shaft_sections
from fmu_bearing.modal.modes.energies import BACKWARD, FORWARD, NEITHER
from fmu_bearing.prepare.bodies import inner_ring
from fmu_bearing.prepare.imperfections import ball_oversizes, ball_waves, race_harmonics
from fmu_bearing.results.defect_lines import CARRIERS
from fmu_bearing.scene import Scene, si
from fmu_bearing.scene.bearing import Bearing
from fmu_bearing.scene.defect import Defect
from fmu_bearing.scene.defect_conflicts import race_radius
from fmu_bearing.scene.member import set_of

_SIGNS = {FORWARD: "+", BACKWARD: "-"}


class Rates(NamedTuple):
    """Frequencies (Hz) at each speed: shaft, cage, ball about itself, balls past inner and outer race."""

    f_r: NDArray[np.float64]
    f_c: NDArray[np.float64]
    f_b: NDArray[np.float64]
    f_i: NDArray[np.float64]
    f_o: NDArray[np.float64]


@dataclass(frozen=True)
class Line:
    """An excitation of the rings.

    Attributes
    ----------
    name : str
        Its frequency by the kinematic ones: ``f_i + f_r``.
    source : str
        What makes it: ``unbalance``, ``ball sizes``, ``inner race``, ``outer race``, ``ball form``,
        ``defect 1`` and so on.
    surface_order : int
        Waves per turn of the surface; 0 where there is none.
    order, direction
        Of the wave on the rings that it can move.
    frequency : ndarray
        Hz, at each speed.
    amplitude : float
        m, on the surface of the scene, behind the contact filter; 0: the scene does not contain it.
    balls : int
        How many balls the bearing has that makes it.
    """

    name: str
    source: str
    surface_order: int
    order: int
    direction: str
    frequency: NDArray[np.float64]
    amplitude: float
    balls: int

    @property
    def present(self) -> bool:
        """Whether the scene contains it."""
        return self.amplitude > 0.0


def rates(
    speed: NDArray[np.float64], orbit: NDArray[np.float64], spin: NDArray[np.float64], balls: int
) -> Rates:
    """Return the frequencies at speeds of the shaft, the orbit and a ball in orbiting axes (rad/s)."""
    shaft, cage, ball = (np.abs(value) / (2.0 * math.pi) for value in (speed, orbit, spin))
    return Rates(shaft, cage, ball, balls * (shaft - cage), balls * cage)


def unbalance(scene: Scene) -> float:
    """Eccentricity (m) of what turns; of a set with heavy spots, wherever they lie, over shaft and rings."""
    own: float = 0.0 if scene.imperfections is None else si(scene.imperfections).unbalance
    spots = scene.assembly.heavy_spots
    if not spots:
        return own
    amount: float = sum(1e-6 * spot.amount_g_mm for spot in spots)  # kg m
    shaft = sum(section.mass for section in shaft_sections(scene, set_of(scene).shaft))
    return own + amount / (shaft + sum(inner_ring(bearing.scene).mass for bearing in scene.bearings()))


def kinds(scene: Scene) -> dict[str, list[int]]:
    """Return the bearings, from 0, of each kind by its words; equal bearings, or one, are under ""."""
    each = list(zip(scene.geometries, scene.materials_of_each, strict=True))
    found: list[list[int]] = []
    for number, one in enumerate(each):
        same = next((numbers for numbers in found if each[numbers[0]] == one), None)
        if same is None:
            found.append([number])
        else:
            same.append(number)
    if len(found) == 1:
        return {"": found[0]}
    return {
        f"bearing{'s' * (len(numbers) > 1)} {', '.join(str(number + 1) for number in numbers)}": numbers
        for numbers in found
    }


def lines(scene: Scene, at: Rates, orders: set[int], highest: float, eccentric: float = 0.0) -> list[Line]:
    """Return all lines that can move waves of the ``orders`` below ``highest`` (Hz) at some speed.

    ``scene``: of a single bearing; ``eccentric``: `unbalance` of all that turns, m.
    """
    excitations = [*_shaft_and_sizes(scene, at, orders, eccentric), *_races(scene, at, orders, highest)]
    excitations += [*_ball_form(scene, at, orders, highest), *lines_of_defects(scene, at, orders, highest)]
    return [line for line in excitations if float(line.frequency.min()) <= highest]


def _shaft_and_sizes(scene: Scene, at: Rates, orders: set[int], eccentric: float) -> Iterator[Line]:
    if 1 in orders:
        yield Line("f_r", "unbalance", 0, 1, FORWARD, at.f_r, eccentric, scene.bearing.ball_count)
    sizes = ball_oversizes(scene)
    count = sizes.size
    spectrum = np.abs(np.fft.rfft(0.5 * sizes)) / count
    for n in sorted(orders - {0}):
        if n <= count // 2:
            amplitude = float(spectrum[n]) * (1.0 if 2 * n == count else 2.0)
            yield Line(_times(n, "f_c"), "ball sizes", 0, n, FORWARD, n * at.f_c, amplitude, count)


def _races(scene: Scene, at: Rates, orders: set[int], highest: float) -> Iterator[Line]:
    balls = scene.bearing.ball_count
    inner, outer = (
        dict(zip(race.orders.tolist(), race.amplitudes.tolist(), strict=True))
        for race in race_harmonics(scene)
    )
    for m in range(1, _most(at.f_i, highest) + 1):
        for n in sorted(orders):
            for direction, sign in ((FORWARD, 1), (BACKWARD, -1)) if n else ((NEITHER, 0),):
                order = m * balls + sign * n
                frequency = m * at.f_i + sign * n * at.f_r
                name = _times(m, "f_i") + (f" {_SIGNS[direction]} {_times(n, 'f_r')}" if n else "")
                # below zero it turns the other way; orders of a bearing stay above
                if order > 0 and frequency.min() > 0.0:
                    amplitude = inner.get(order, 0.0)
                    yield Line(name, "inner race", order, n, direction, frequency, amplitude, balls)
    for m in range(1, _most(at.f_o, highest) + 1):
        for n in sorted(orders):
            for direction, sign in ((FORWARD, -1), (BACKWARD, 1)) if n else ((NEITHER, 0),):
                order = m * balls + sign * n
                if order > 0:
                    amplitude = outer.get(order, 0.0)
                    yield Line(
                        _times(m, "f_o"), "outer race", order, n, direction, m * at.f_o, amplitude, balls
                    )


def _ball_form(scene: Scene, at: Rates, orders: set[int], highest: float) -> Iterator[Line]:
    amplitudes, _ = ball_waves(scene)
    balls = scene.bearing.ball_count
    for q in range(2, _most(at.f_b, highest) + 1, 2):
        # balls turn at phases of chance: each order gets what one of them has, over the root of their number
        amplitude = abs(float(amplitudes[q - 1])) / math.sqrt(balls) if q <= amplitudes.size else 0.0
        for n in sorted(orders):
            if n > balls // 2:
                continue
            for direction, sign in ((FORWARD, 1), (BACKWARD, -1)) if n else ((NEITHER, 0),):
                frequency = q * at.f_b + sign * n * at.f_c
                name = _times(q, "f_b") + (f" {_SIGNS[direction]} {_times(n, 'f_c')}" if n else "")
                if frequency.min() > 0.0:
                    yield Line(name, "ball form", q, n, direction, frequency, amplitude, balls)


def lines_of_defects(
    scene: Scene, at: Rates, orders: set[int], highest: float, whose: str = ""
) -> Iterator[Line]:  # fmt: skip
    """Yield the lines of local defects: of each the orders of its height round the race or the ball.

    Like waves of these orders, those of a race move the ring by multiples m N of the number of balls, n more
    or n less. A ball's meets both races in each of its turns. ``scene``: of a single bearing; ``whose``:
    words behind the number of a defect, as " of bearing 2".
    """
    balls = scene.bearing.ball_count
    for number, defect in enumerate(scene.imperfections.defect if scene.imperfections else (), start=1):
        source = f"defect {number}{whose}"
        multiple, carrier, _ = CARRIERS[defect.on]
        base = multiple * getattr(at, carrier)
        for m in range(1, _most(base, highest) + 1):
            name = _times(multiple * m, carrier)
            for n in sorted(orders):
                if defect.on == "ball" and n > balls // 2:
                    continue
                for direction, sign in ((FORWARD, 1), (BACKWARD, -1)) if n else ((NEITHER, 0),):
                    if defect.on == "outer":
                        # waves of the standing ring turn the other way
                        order, side, step = m * balls - sign * n, "", 0.0 * at.f_r
                    elif defect.on == "inner":
                        order, side, step = m * balls + sign * n, "f_r", sign * n * at.f_r
                    else:
                        order, side, step = multiple * m, "f_c", sign * n * at.f_c
                    beside = f" {_SIGNS[direction]} {_times(n, side)}" if n and side else ""
                    frequency = m * base + step
                    if order > 0 and frequency.min() > 0.0:
                        amplitude = defect_order(scene.bearing, defect, order)
                        # one ball of all has it
                        amplitude /= balls if defect.on == "ball" else 1.0
                        yield Line(name + beside, source, 0, n, direction, frequency, amplitude, balls)


def defect_order(bearing: Bearing, defect: Defect, order: int) -> float:
    """Amplitude (m) of an order of a defect's height round its race or ball, to rank lines.

    Of a rigid ball that sinks in between the edges, as deep as the defect at most; of the area that its path
    cuts out, with the spectrum of a triangle. A defect narrower than the contact moves the rings less: the
    contact bridges it.
    """
    half, radius = 0.5e-3 * defect.along_mm, 0.5e-3 * bearing.ball_diameter_mm
    around = rolling = radius
    if defect.on != "ball":
        around = 1e-3 * race_radius(bearing, defect.on)
        rolling = 1.0 / (1.0 / radius + (1.0 if defect.on == "inner" else -1.0) / around)
    deep = 1e-6 * defect.depth_um
    edge = min(half, math.sqrt(2.0 * rolling * deep))
    area = 2.0 * deep * (half - edge) + edge**3 / (3.0 * rolling)
    return float(area / (math.pi * around) * np.sinc(order * half / (2.0 * math.pi * around)) ** 2)


def _most(frequency: NDArray[np.float64], highest: float) -> int:
    """How many multiples of a frequency begin below ``highest`` at the lowest speed, within reason."""
    return min(int(highest / max(float(frequency.min()), 1.0)), _MOST)


def _times(n: int, name: str) -> str:
    return name if n == 1 else f"{n} {name}"


_MOST = 24  # multiples of a passing frequency: their waves are shorter than a contact
