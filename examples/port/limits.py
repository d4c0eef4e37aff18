"""How large a communication step each coupling bears, and what it does to frequency and damping of the mode.

    python examples/port/limits.py --plot port.png

A set with the same rotor inside (``[spindle.shaft]``) is the truth. Figures and conditions: docs/coupling.md.
"""

import argparse

import numpy as np
from couple import SCENE, SCHEMES, Bearings, damped, run
from numpy.typing import NDArray
from rotor import PORT, Rotor, cylinder, with_arm

from fmu_bearing.instance import Instance
from fmu_bearing.prepare.model import prepare
from fmu_bearing.results.picture_parts import save, single
from fmu_bearing.scene import Scene, read_scene

LENGTH, RADIUS = 0.2, 0.0085  # m
PUSH = 1e-3  # N s at X = 0, upwards
DURATION = 4e-3  # s
STEPS = (5e-6, 1e-5, 1.5e-5, 2e-5, 2.25e-5, 2.5e-5, 3e-5, 5e-5, 7e-5)  # s
SHORT = (1e-5, 3e-5)  # s
_SEEN = 8.0  # samples per period that show a damping ratio


def with_shaft(scene: Scene) -> Scene:
    """Return the scene with the same rotor as a shaft of its own."""
    data = scene.model_dump()
    data["spindle"]["shaft"] = {
        "sections_mm": [[1e3 * LENGTH, 2e3 * RADIUS, 0.0]], "material": data["spindle"]["shaft"]["material"],
        "temperature_degC": 40.0,
    }  # fmt: skip
    return Scene.from_dict(data)


def inside(scene: Scene, h: float = 5e-6) -> NDArray[np.float64]:
    """Return what the nose of the set's own shaft does after the push, upwards."""
    one = Instance(prepare(with_shaft(scene)), tell=lambda _: None)
    one.initialise()
    begin, rows = one.get("shaft.nose.displacement.z"), []
    for k in range(round(DURATION / h)):
        one.set("nose.force.z", PUSH / h if k == 0 else 0.0)
        one.step(h)
        rows.append(one.get("shaft.nose.displacement.z") - begin)
    return np.array(rows)


def rotors(scene: Scene, bearings: Bearings) -> dict[str, Rotor]:
    """Return the rigid rotor, and one with 0.1 kg at 250 mm on an arm of 1.5 kHz; with the inner rings."""
    shaft = scene.spindle.shaft  # type: ignore[union-attr]
    rigid = cylinder(LENGTH, RADIUS, bearings.one.get("shaft_speed"), shaft.material.density_kg_m3)
    bent = with_arm(rigid, 0.1, 0.25, 1500.0, 0.005)
    return {"rigid": rigid.with_rings(*bearings.rings()), "bending": bent.with_rings(*bearings.rings())}


def study(steps: tuple[float, ...] = STEPS) -> tuple[tuple[float, float], list[tuple[str, str, float, str]]]:
    """Return frequency and damping ratio inside, and what each coupling makes of them, as text."""
    scene = read_scene(SCENE).replace({"fidelity.model": "full"})
    truth = damped(inside(scene)[20:], 5e-6)
    bearings = Bearings(scene)
    bearings.start(np.zeros(PORT))
    found = []
    for name, rotor in rotors(scene, bearings).items():
        push = np.zeros(rotor.count)
        push[2] = PUSH
        for scheme in SCHEMES:
            for h in steps:
                rows = run(bearings, rotor, scheme, h, DURATION, push)
                found.append((name, scheme, h, _told(rows, h, name == "rigid")))
    return truth, found


def _told(rows: NDArray[np.float64], h: float, single: bool) -> str:
    """Return frequency and damping ratio of a ``single`` mode that samples resolve, else what it becomes."""
    if len(rows) < round(DURATION / h):
        return "runs away"
    row = rows[round(1e-4 / h) :, 2]
    frequency, ratio = damped(row, h)
    if single and frequency * h < 1.0 / _SEEN:
        return f"{frequency:.0f} Hz, {ratio:.4f}"
    quarter = len(row) // 4
    begin, end = (np.ptp(part) for part in (row[:quarter], row[-quarter:]))
    return "decays" if end < begin else "grows"


def picture(path: str, truth: tuple[float, float], found: list[tuple[str, str, float, str]]) -> None:
    """Draw damping ratios of the rigid rotor's mode over the step."""
    figure, axes = single((7.0, 3.6))
    for scheme in SCHEMES:
        points = [
            (1e6 * h, float(text.rsplit(" ", 1)[1]))
            for name, one, h, text in found
            if name == "rigid" and one == scheme and "Hz" in text
        ]
        axes.plot(*zip(*points, strict=True), "o-", label=scheme)
    axes.axhline(truth[1], color="0.4", linestyle="--", label="shaft inside")
    axes.set(xlabel="communication step, us", ylabel="damping ratio", ylim=(0.0, 0.06))
    axes.legend()
    save(figure, path)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--plot", metavar="FILE")
    parser.add_argument("--short", action="store_true", help="two steps alone")
    given = parser.parse_args()
    true, rows = study(SHORT if given.short else STEPS)
    print(f"shaft inside: {true[0]:.0f} Hz, damping ratio {true[1]:.4f}")
    for row in rows:
        print(f"{row[0]:8} {row[1]:13} {1e6 * row[2]:4.0f} us  {row[3]}")
    if given.plot:
        picture(given.plot, true, rows)
