"""Boundary elements on a rigid ring: time and memory per frequency at stated errors, ours beside bempp-cl."""

import importlib.util
import time
import tracemalloc

import numpy as np

from benchmarks.bem_peer import DENSITY, SPEED, ring_pressures
from fmu_bearing.acoustics.radiation.bem.meridian import ring
from fmu_bearing.acoustics.radiation.bem.solver import Scatterer

COLUMNS = ("solver", "frequency", "unknowns", "s once", "s per frequency", "memory", "largest error")
RING = (0.035, 0.0296, 0.01)
ORDERS = 9
_EXACT = 2e-4  # m: elements of the reference, a quarter of ours
_ELEMENTS = 0.0012
_PEER_MESHES = ((32, 1.5e-3), (64, 0.8e-3))  # divisions round the ring, longest side of a triangle (m)


def points(count: int = 16) -> np.ndarray:
    """Microphones 200 mm from the ring in a plane through its axis, shape (count, 3)."""
    angle = 2.0 * np.pi * (np.arange(count) + 0.25) / count
    return np.stack([0.2 * np.cos(angle), np.full(count, 0.01), 0.2 * np.sin(angle)], axis=1)


def ours(frequency: float, size: float) -> tuple[np.ndarray, int, float, float]:
    """Pressures per axial and radial acceleration, unknowns, s once, s per frequency for all orders."""
    k, places = 2.0 * np.pi * frequency / SPEED, points()
    clock = time.perf_counter()
    scatterer = Scatterer([ring("ring", 0, *RING[:2], -RING[2] / 2, RING[2] / 2)], k, ORDERS, size)
    across = np.hypot(places[:, 1], places[:, 2])
    potentials = scatterer.field_potentials(np.stack([places[:, 0], across], axis=1))
    once, clock = time.perf_counter() - clock, time.perf_counter()
    system, normals = scatterer.at(k), DENSITY * scatterer.mesh.node_normals()
    single, double = potentials(k)
    heard = []
    for order in range(ORDERS):
        drive = normals[:, :1] if order == 0 else normals[:, 1:]
        there = single[order] @ drive + double[order] @ system.pressure(order, drive)
        heard.append(there[:, 0] * (places[:, 2] / across if order else 1.0))
    return np.array(heard[:2]), scatterer.mesh.size, once, time.perf_counter() - clock


def _error(found: np.ndarray, exact: np.ndarray) -> float:
    """Largest error in dB within 10 dB of each pattern's maximum."""
    worst = 0.0
    for one, other in zip(found, exact, strict=True):
        heard = np.abs(other) > 10 ** (-10 / 20) * np.abs(other).max()
        worst = max(worst, float(np.abs(20.0 * np.log10(np.abs(one / other)[heard])).max()))
    return worst


def rows(quick: bool) -> list[list[str]]:
    """One row per solver, mesh and frequency."""
    found = []
    ours(1000.0, 0.003)  # compiled
    peer = importlib.util.find_spec("bempp_cl") is not None
    for frequency in (5000.0,) if quick else (1000.0, 5000.0, 20_000.0):
        exact = ours(frequency, _EXACT)[0]
        heard, unknowns, once, each = ours(frequency, _ELEMENTS)
        tracemalloc.start()
        ours(frequency, _ELEMENTS)
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        found.append(_row("ours, orders 0 to 8", frequency, unknowns, once, each, peak, _error(heard, exact)))
        for around, size in _PEER_MESHES if peer and not quick else ():
            ring_pressures(*RING, frequency, points(), around, size)  # compiled
            clock = time.perf_counter()
            tracemalloc.start()
            heard, unknowns = ring_pressures(*RING, frequency, points(), around, size)
            peak = tracemalloc.get_traced_memory()[1]
            tracemalloc.stop()
            took = time.perf_counter() - clock
            found.append(_row("bempp-cl, 3-D", frequency, unknowns, 0.0, took, peak, _error(heard, exact)))
    if not peer:
        found.append(["bempp-cl", "", "", "", "", "", "not installed"])
    return found


def _row(name, frequency, unknowns, once, each, peak, error) -> list[str]:
    spent = [f"{once:.3f}" if once else "", f"{each:.3f}"]
    return [name, f"{frequency:g} Hz", str(unknowns), *spent, f"{peak / 1e6:.0f} MB", f"{error:.2f} dB"]
