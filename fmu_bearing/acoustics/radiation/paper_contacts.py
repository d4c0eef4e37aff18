"""Radiation model ``paper_contacts``: the sound-field paper's own method, sources at the contact points.

"Circumferential sound field of full-ceramic angular contact ball bearings" puts its boundary elements at the
contact points: surface pressures from the system of eq. 7, field pressures from eq. 8, distances by eq. 12.
Its Green's function lacks a 4 pi against the position coefficients of eq. 6 and the rows of eq. 8; here
G = e^{-jkR} / (4 pi R) throughout, and the coefficient on the surface is 1/2 (flat patch).

What it leaves open is assumed: one patch per contact of each ring with the race's share of
the ring's skin (2 pi r B / Z), the normal at the contact angle; one per pocket of the cage with its share of
the cage's skin, the normal along the orbit; two per ball, each half its surface, at its two contacts. As in
eq. 12 all patches lie in the bearing plane. A patch's own pressure is that of a baffled disc of its area at
its centre. The patches orbit with the balls, so a fixed filter acts on each circumferential harmonic of their
strengths; evenly spaced patches make eq. 7 circulant, one small system per harmonic. Sound is neither
shielded nor scattered by anything but the patches. For comparison, not for prediction.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.radiation.circle import MicrophoneCircle, check_outside
from fmu_bearing.acoustics.radiation.frequencies import fit_frequencies
from fmu_bearing.acoustics.radiation.radiators import BALLS, CAGE, INNER, OUTER, Air, Path, Radiators
from fmu_bearing.engine.layout import SD

_ANGLES = 128  # angles between microphone and source: orders far above those kept


@dataclass(frozen=True)
class _Family:
    """Patches of one kind: channel family, radius, area of one patch (m, m2), normal, sign of its motion.

    ``normal`` is the outward unit normal along x, r, theta; a patch moves by ``sign`` times its channel.
    """

    channels: int
    component: int
    radius: float
    area: float
    normal: tuple[float, float, float]
    sign: float


def contact_paths(radiators: Radiators, air: Air, circle: MicrophoneCircle, harmonics: int) -> list[Path]:
    """Paths from the normal accelerations at the contacts to microphones on a circle.

    ``harmonics`` is the highest circumferential order kept.

    Raises
    ------
    ValueError
        When the circle runs through the bearing or its housing.
    """
    check_outside(radiators, circle)
    families = _families(radiators)
    f = fit_frequencies()
    k = 2.0 * np.pi * f / air.sound_speed
    single, double = _field(families, k, circle.radius, circle.axial, harmonics)
    flight = circle.flight(air)
    wide = SD.family_size(harmonics)
    paths: list[Path] = []
    for m in range(harmonics + 1):
        # single, double: (cosine part, sine part) x family x frequency; a patch of family i answers j
        surface_responses = _surface(families, radiators.ball_count, k, m)
        channels: dict[int, NDArray[np.complex128]] = {}
        for i, family in enumerate(families):
            response = single[m, i] + np.einsum("jf,jf->f", double[m], surface_responses[:, i])
            response = response * (air.density * family.sign)
            channels[family.channels] = channels.get(family.channels, 0.0) + response
        cosine, sine = circle.order(m)
        for channel, response in channels.items():
            component = next(g.component for g in families if g.channels == channel)
            kind = SD.BALLS_KIND if component == BALLS else SD.RADIAL
            first = channel * wide + (0 if m == 0 else 2 * m - 1)
            paths.append(Path(component, first, flight, response, cosine, kind))
            if m:
                paths.append(Path(component, first + 1, flight, response, sine, kind))
    return paths


def _families(radiators: Radiators) -> list[_Family]:
    orbit, ball = 0.5 * radiators.pitch_diameter, 0.5 * radiators.ball_diameter
    sine, cosine = np.sin(radiators.contact_angle), np.cos(radiators.contact_angle)
    share = 2.0 * np.pi / radiators.ball_count
    inner, outer = orbit - ball * cosine, orbit + ball * cosine
    half = 2.0 * np.pi * ball**2
    out, inwards = (sine, cosine, 0.0), (-sine, -cosine, 0.0)
    # the normal of a ring's channel points from the inner race to the outer; the outer race looks inwards
    families = [
        _Family(SD.FAMILY_INNER, INNER, inner, share * inner * radiators.inner_ring.width, out, 1.0),
        _Family(SD.FAMILY_OUTER, OUTER, outer, share * outer * radiators.outer_ring.width, inwards, -1.0),
        _Family(SD.FAMILY_BALLS, BALLS, outer, half, out, 1.0),
        _Family(SD.FAMILY_BALLS, BALLS, inner, half, inwards, -1.0),
    ]
    if radiators.cage is not None:
        area = share * orbit * radiators.cage.width
        families.append(_Family(SD.FAMILY_CAGE, CAGE, orbit, area, (0.0, 0.0, 1.0), 1.0))
    return families


def _field(
    families: list[_Family], k: NDArray[np.float64], radius: float, axial: float, harmonics: int
) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
    """Harmonics of eq. 8 over the angle between microphone and patch, (order, family, frequency) each.

    Single layer per rate of normal velocity over the density; double layer per surface pressure. Only the
    part even in the angle: the normals along the orbit, whose double layer is odd, are taken as 0.
    """
    angle = 2.0 * np.pi * np.arange(_ANGLES) / _ANGLES
    shapes = np.cos(np.outer(np.arange(harmonics + 1), angle)) / _ANGLES
    shapes[1:] *= 2.0
    single = np.empty((harmonics + 1, len(families), len(k)), dtype=complex)
    double = np.empty_like(single)
    for i, family in enumerate(families):
        r = np.sqrt(radius**2 + family.radius**2 - 2.0 * radius * family.radius * np.cos(angle) + axial**2)
        nx, nr, _ = family.normal
        slope = -(nx * axial + nr * (radius * np.cos(angle) - family.radius)) / r  # dR/dn
        green = np.exp(-1j * np.outer(r, k)) / (4.0 * np.pi * r[:, None])
        single[:, i] = family.area * (shapes @ green)
        bent = -(1j * k + 1.0 / r[:, None]) * green * slope[:, None]
        double[:, i] = family.area * (shapes @ bent)
    return single, double


def _surface(families: list[_Family], count: int, k: NDArray[np.float64], m: int) -> NDArray[np.complex128]:
    """Eq. 7 for one harmonic: surface pressure over density per rate of velocity, (to, from, frequency)."""
    n = len(families)
    angle = 2.0 * np.pi * np.arange(count) / count
    turn = np.cos(m * angle)
    system = np.zeros((len(k), n, n), dtype=complex)
    drive = np.zeros_like(system)
    for i, to in enumerate(families):
        system[:, i, i] += 0.5
        for j, source in enumerate(families):
            square = to.radius**2 + source.radius**2 - 2.0 * to.radius * source.radius * np.cos(angle)
            apart = square > 1e-12
            r = np.sqrt(square[apart])
            slope = -source.normal[1] * (to.radius * np.cos(angle[apart]) - source.radius) / r
            green = np.exp(-1j * np.outer(k, r)) / (4.0 * np.pi * r)
            bent = -(1j * k[:, None] + 1.0 / r) * green * slope
            system[:, i, j] -= source.area * (bent @ turn[apart])
            drive[:, i, j] += source.area * (green @ turn[apart])
        disc = np.sqrt(to.area / np.pi)  # the patch itself: a disc, seen from its centre
        drive[:, i, i] += 0.5 * disc * np.sinc(k * disc / (2 * np.pi)) * np.exp(-0.5j * k * disc)
    responses: NDArray[np.complex128] = np.moveaxis(np.linalg.solve(system, drive).astype(complex), 0, -1)
    return responses
