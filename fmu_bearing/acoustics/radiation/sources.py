"""Sound of single vibrating bodies: pressure per unit acceleration, against frequency.

All functions share one convention: time factor e^{+j omega t}, first argument frequencies in Hz (an array of
any shape, zero allowed), lengths in m, air density in kg/m3, sound speed in m/s; the result is complex, in
Pa per m/s2, and contains the flight time from the body's centre. Per acceleration rather than per velocity,
because these functions stay finite at zero frequency.

Exact one: `oscillating_sphere`. Low-frequency one: `compact_dipole`. As printed in the multi-source paper
("Acoustic model of ceramic angular contact ball bearing based on multi-sound source method"), errors
included: `paper_ball` (eqs. 15, 17), `paper_point` (eqs. 18, 20), `paper_piston` (eqs. 27, 29); of eqs.
36-42 the magnitude, `paper_cylinder_causal`.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import h2vp

Spectrum = NDArray[np.complex128]


def _wavenumber(frequency: ArrayLike, sound_speed: float) -> NDArray[np.float64]:
    return 2.0 * np.pi * np.asarray(frequency, dtype=float) / sound_speed


def oscillating_sphere(
    frequency: ArrayLike,
    distance: ArrayLike,
    cosine: ArrayLike,
    radius: float,
    density: float,
    sound_speed: float,
) -> Spectrum:
    """Pressure around a rigid sphere shaken along a line, per acceleration of its centre.

    Exact. ``cosine`` is that of the angle between the acceleration and the direction to the observer;
    it and ``distance`` (from the centre) broadcast against ``frequency``. Source: Morse and Ingard (1968). It
    is a point dipole times `sphere_factor`.
    """
    volume = 2.0 * np.pi * radius**3  # effective: displaced volume plus half of it as added mass
    point = compact_dipole(frequency, distance, cosine, volume, density, sound_speed)
    return point * sphere_factor(frequency, radius, sound_speed)


def sphere_factor(frequency: ArrayLike, radius: float, sound_speed: float) -> Spectrum:
    """Exact dipole strength of a shaken sphere over its low-frequency value; 1 at zero frequency."""
    ka = _wavenumber(frequency, sound_speed) * radius
    return 2.0 * np.exp(1j * ka) / (2.0 + 2j * ka - ka**2)


def cylinder_factor(frequency: ArrayLike, radius: float, sound_speed: float) -> Spectrum:
    """Exact dipole strength per length of a shaken infinite cylinder over its low-frequency value."""
    ka = np.atleast_1d(_wavenumber(frequency, sound_speed) * radius)
    low = ka < 1e-6
    safe = np.where(low, 1.0, ka)
    factor = np.where(low, 1.0, -2j / (np.pi * safe**2 * h2vp(1, safe)))
    shaped: Spectrum = factor.reshape(np.shape(frequency))
    return shaped


def compact_dipole(
    frequency: ArrayLike,
    distance: ArrayLike,
    cosine: ArrayLike,
    effective_volume: ArrayLike,
    density: float,
    sound_speed: float,
) -> Spectrum:
    """Pressure of a body much smaller than the wavelength, per acceleration of the body.

    p = rho V a cos(theta) (1 + j k r) e^{-jkr} / (4 pi r^2), where the effective volume V is the displaced
    volume plus the added mass over the air density (see `effective`). Source: Dowling and Ffowcs Williams
    (1983; sound of a shaken compact body).
    """
    k = _wavenumber(frequency, sound_speed)
    r = np.asarray(distance, dtype=float)
    strength = density * np.asarray(effective_volume) * np.asarray(cosine) / (4.0 * np.pi * r**2)
    return strength * (1.0 + 1j * k * r) * np.exp(-1j * k * r)


def paper_ball(
    frequency: ArrayLike, distance: ArrayLike, radius: float, density: float, sound_speed: float
) -> Spectrum:
    """Ball source of the multi-source paper, eqs. 15 and 17 as printed, per d|v|/dt.

    The printed phase makes the sign opposite to the exact one. The paper gives |v| no direction, so
    cos(theta) is taken as 1 (assumed; an upper bound).
    """
    k = _wavenumber(frequency, sound_speed)
    r = np.asarray(distance, dtype=float)
    # arctan(1/kr) is pi/2 - arctan(kr); dividing by j omega then leaves a real factor -1
    size = density * radius**3 * np.sqrt(1.0 + (k * r) ** 2) / (2.0 * r**2)
    return -size * np.exp(1j * (np.arctan(k * r) - k * r))


def paper_point(
    frequency: ArrayLike, distance: ArrayLike, radius: float, density: float, sound_speed: float
) -> Spectrum:
    """Point source of the multi-source paper, eqs. 18 and 20 as printed, per derivative of eq. 19."""
    k = _wavenumber(frequency, sound_speed)
    r = np.asarray(distance, dtype=float)
    return density * radius**2 / r * np.exp(-1j * k * r)


def paper_piston(
    frequency: ArrayLike,
    distance: ArrayLike,
    outer_diameter: float,
    inner_diameter: float,
    density: float,
    sound_speed: float,
) -> Spectrum:
    """End face of a ring in the multi-source paper, eqs. 27 and 29 as printed, per axial acceleration."""
    k = _wavenumber(frequency, sound_speed)
    r = np.asarray(distance, dtype=float)
    return density * (outer_diameter**2 - inner_diameter**2) / (8.0 * r) * np.exp(-1j * k * r)


def paper_cylinder_causal(
    frequency: ArrayLike, distance: float, radius: float, density: float, sound_speed: float
) -> Spectrum:
    """Mantle of a ring in the multi-source paper, eqs. 36-42, per d|v_yz|/dt, its phase made causal.

    Magnitude and flight time are the printed ones; cos(theta) is 1 (assumed, as for `paper_ball`). The
    printed phase belongs to no real impulse response (its imaginary part is even in frequency); the squared
    magnitude, a ratio of polynomials in k^4, has one minimum-phase factor, positive at zero frequency.
    """
    k = _wavenumber(frequency, sound_speed)
    r, a = distance, radius
    middle = ((1.0 / r + r / a**2) ** 2 - 2.0 / a**2) / np.pi**2  # k^4 in (k^3 B_r)^2 + (k^3 B_i)^2
    corner = 4.0 / (np.pi**2 * r * a**2)
    zeros = np.roots([r**2 / 16.0, 0, 0, 0, middle, 0, 0, 0, corner**2])  # k = s / j leaves k^4 = s^4
    poles = np.roots([0.25, 0, 0, 0, 4.0 / (np.pi**2 * a**4)])
    zeros, poles = zeros[zeros.real < 0], np.repeat(poles[poles.real < 0], 2)
    s = 1j * k[..., None]
    factor = np.prod((s - zeros) / (s - poles), axis=-1) * r
    return density * factor * np.exp(-1j * k * r)
