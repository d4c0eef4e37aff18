"""Sound of bodies for which the field is known in closed form, and of the paper's cylinder as printed.

Conventions are those of `fmu_bearing.acoustics.radiation.sources`: time factor e^{+j omega t}, frequencies in
Hz, lengths in m; results are complex, in Pa per m/s2.
"""

import numpy as np
from scipy.special import h2vp, hankel2


def _wavenumber(frequency, sound_speed):
    return 2.0 * np.pi * np.asarray(frequency, dtype=float) / sound_speed


def pulsating_sphere(frequency, distance, radius, density, sound_speed):
    """Pressure around a sphere whose surface breathes, per radial surface acceleration.

    Exact. ``distance`` counts from the centre and broadcasts against ``frequency``. Source: any text on
    radiation from spheres, for example Morse and Ingard (1968).
    """
    k = _wavenumber(frequency, sound_speed)
    r = np.asarray(distance, dtype=float)
    return density * radius**2 / r * np.exp(-1j * k * (r - radius)) / (1.0 + 1j * k * radius)


def oscillating_cylinder(
    frequency,
    distance,
    cosine,
    radius,
    density,
    sound_speed,
):
    """Pressure around an infinite rigid cylinder shaken across its axis, per acceleration.

    Exact and two-dimensional: what eqs. 31-34 of the multi-source paper aim at, propagation counted once.
    ``distance`` counts from the axis.
    """
    k = _wavenumber(frequency, sound_speed)
    k, r, cosine = np.broadcast_arrays(k, np.asarray(distance, float), np.asarray(cosine, float))
    low = k * radius < 1e-6
    safe = np.where(low, 1.0 / radius, k)
    moving = -hankel2(1, safe * r) / (safe * h2vp(1, safe * radius))
    result = (density * cosine * np.where(low, radius**2 / r, moving)).astype(complex)
    return result


def baffled_ring_on_axis(
    frequency,
    distance,
    outer_radius,
    inner_radius,
    density,
    sound_speed,
):
    """Pressure on the axis of a flush annular face moving in a rigid baffle, per acceleration.

    Exact; ``distance`` counts from the face. The two edge waves of the Rayleigh integral, written as a
    product so that zero frequency needs no limit.
    """
    k = _wavenumber(frequency, sound_speed)
    z = np.asarray(distance, dtype=float)
    far, near = np.hypot(z, outer_radius), np.hypot(z, inner_radius)
    half = 0.5 * (far - near)
    return density * 2.0 * half * np.sinc(k * half / np.pi) * np.exp(-0.5j * k * (far + near))


def paper_cylinder(frequency, distance, radius, density, sound_speed):
    """Mantle of a ring in the multi-source paper, eqs. 36-42 as printed, per d|v_yz|/dt.

    cos(theta) is 1 (assumed, as for `paper_ball`). A0, B_r and B_i are multiplied through by powers of k so
    that the value at zero frequency, rho a^2 / r, needs no limit.
    """
    k = _wavenumber(frequency, sound_speed)
    r = np.asarray(distance, dtype=float)
    a = radius
    denominator = k**4 / 4.0 + 4.0 / (np.pi**2 * a**4)  # k^4 (1/4 + (2/(pi k^2 a^2))^2)
    real = k**2 / (np.pi * r) + k**2 * r / (np.pi * a**2)  # k^3 B_r
    imaginary = k**4 * r / 4.0 - 4.0 / (np.pi**2 * r * a**2)  # k^3 B_i
    return density * (real - 1j * imaginary) / (1j * denominator) * np.exp(-1j * k * r)
