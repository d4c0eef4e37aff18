"""A spindle's shaft on two bearings in ROSS 3: what its three elements per bearing do, and what they miss.

    python examples/rotor/round_trip.py --ross /path/to/environment/bin/python

ROSS 3.1 needs Python 3.13, so it runs in an environment of its own, as a process apart (`in_ross.py`).
This side writes the elements, lets ROSS read them and solve the rotor, and solves the same shaft by itself:
with springs in the same planes, and with all five freedoms of the bearings.

ROSS 3.1.0 gives the frequencies of the same planes within 3e-6. With rigid arms between the centres of the
balls and the planes these are within 0.03 % of five freedoms, one plane per bearing is 1.4 % off
(docs/results/ross.md).
"""

import argparse
import datetime
import json
import math
import pathlib
import shlex
import subprocess
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import PchipInterpolator
from scipy.linalg import block_diag, eig

from fmu_bearing import read_scene, stiffness
from fmu_bearing.engine.constants import RPM
from fmu_bearing.results.table import machine, markdown, write_csv
from fmu_bearing.steady.stiffness.planes import mirrored_matrix, plane_matrices

HERE = pathlib.Path(__file__).parent
SCENE = HERE.parent / "scenes" / "7003C-spindle.toml"
SPEEDS = np.linspace(5e3, 25e3, 5)  # r/min, of the table
ASKED = (15e3, 12.5e3)  # r/min: one of them, and one between two of them
PLACES = (0.040, 0.140)  # m: centres of the balls along the shaft; the rear bearing carries the other way
LENGTH, DIAMETER = 0.180, 0.017  # m
DISK = {"m": 0.1, "Id": 2e-5, "Ip": 4e-5}  # kg, kg m2: a tool at the nose
HIGHEST = 2.0 * math.pi * 4.8e3  # rad/s: below the shaft's torsion, which no bearing holds
FREEDOMS = 6  # of a node in ROSS: x, y, z and rotations about them
#: Ours (x, y, z, by, bz) among them: x, y, z of ROSS are Y, Z, X.
OURS = (2, 0, 1, 3, 4)
SEATS = ("bending", "rigid")  # of the shaft between centre and planes of a bearing
COLUMNS = (
    "seat", "r/min", "whirl", "ROSS, Hz", "damping ratio", "own, three planes, Hz", "damping ratio",
    "five freedoms, Hz", "damping ratio", "one plane, Hz", "damping ratio",
)  # fmt: skip


@dataclass(frozen=True)
class Layout:
    """Nodes of the rotor (m), and which of them are planes, centres of balls and load centres."""

    places: list[float]
    planes: list[int]
    centres: list[int]
    loads: list[int]

    @property
    def seats(self):
        """Return the elements between the outer planes of a bearing."""
        return [k for b in (0, 3) for k in range(self.planes[b], self.planes[b + 2])]


def layout(table):
    """Return the nodes for a table's planes."""
    at = [centre + place for centre in PLACES for place in table.planes().places]
    # load centre: coupling over radial stiffness, at rest in the middle of the speeds
    k = table.static[len(table.speeds) // 2, 0]
    lever = float(k[1, 4] / k[1, 1])
    loads = [PLACES[0] + lever, PLACES[1] - lever]
    nodes = sorted({0.0, 0.5 * sum(PLACES), LENGTH, *PLACES, *at, *loads})
    return Layout(nodes, *([nodes.index(place) for place in places] for places in (at, PLACES, loads)))


def ask(command, asked):
    """Run the other side and return its answer."""
    script = (HERE / "in_ross.py").read_text(encoding="utf-8")
    done = subprocess.run(
        [*shlex.split(command), "-c", script], input=json.dumps(asked), capture_output=True, text=True
    )
    if done.returncode:
        raise SystemExit(f"{command} failed:\n{done.stderr}")
    return json.loads(done.stdout.strip().splitlines()[-1])


def between(table, values):
    """Return a function of the frequency (rad/s) from values over the table's frequencies, as ROSS has it."""
    return PchipInterpolator(2.0 * math.pi * table.frequencies, values, extrapolate=True)


def both_ways(table):
    """Return K and C over the frequency at the one speed of a table, of a bearing and its mirror image."""
    own = [table.K[0, 0], table.C[0, 0]]
    return own, [mirrored_matrix(one) for one in own]


def whole(table):
    """Return K(w) and C(w) of both bearings, shape (5, 5), at the one speed of a table."""
    return [[between(table, one) for one in pair] for pair in both_ways(table)]


def in_planes(table, a):
    """Return K(w) and C(w), shape (3, 3), of planes at -a, 0, a (m) from both bearings' balls."""
    held = [[plane_matrices(one, a) for one in pair] for pair in both_ways(table)]
    return [[between(table, one[k]) for one in pair] for pair in held for k in range(3)]


def translations(pair):
    """Return K(w) and C(w) without tilt, shape (3, 3)."""
    return [lambda w, one=one: one(w)[:3, :3] for one in pair]


def rotor(shaft, nodes, pairs):
    """Return functions K(w), C(w) of the rotor with a pair K(w), C(w) of the first freedoms at each node."""

    def added(which, own):
        def matrix(w):
            found = own.copy()
            for node, pair in zip(nodes, pairs, strict=True):
                one = pair[which](w)
                at = node * FREEDOMS + np.array(OURS[: len(one)])
                found[np.ix_(at, at)] += one
            return found

        return matrix

    return added(0, shaft["K"]), added(1, shaft["C"])


def modes(shaft, speed, k, c, starts):
    """Damped frequencies (rad/s) and damping ratios in order, each with the bearing of its own frequency."""
    size, found = shaft["K"].shape[0], []
    # unit masses and states w0 q, q': else stiff short elements cost 4 digits of a frequency
    unit = 1.0 / np.sqrt(np.diag(shaft["M"]))
    unit, w0 = unit[:, None] * unit, HIGHEST
    b = block_diag(np.eye(size), unit * shaft["M"])
    for place, start in enumerate(starts):
        w = start
        for _ in range(20):
            damping = c(w) + speed * shaft["G"]
            a = np.block([[np.zeros((size, size)), w0 * np.eye(size)], [unit * -k(w) / w0, unit * -damping]])
            values = eig(a, b, right=False)
            values = values[np.isfinite(values) & (values.imag > 1.0)]
            value = values[np.argsort(values.imag)[place]]
            w, before = float(value.imag), w
            if abs(w - before) < 1e-9 * w:
                break
        found.append((w, float(-value.real / abs(value))))
    return found


def compare(answer, tables, nodes, a):
    """Return rows of the table of modes, and ROSS's largest difference from our planes by speed."""
    rows, worst = [], {}
    for seat in SEATS:
        shaft = {name: np.array(matrix) for name, matrix in answer[seat]["shaft"].items()}
        for rpm, of_ross in zip(ASKED, answer[seat]["modes"], strict=True):
            bearings = whole(tables[rpm])
            ways = (
                (nodes.planes, in_planes(tables[rpm], a)),
                (nodes.centres, bearings),
                (nodes.loads, [translations(pair) for pair in bearings]),
            )
            starts = [w for w, _, _ in of_ross]
            own = [modes(shaft, rpm * RPM, *rotor(shaft, at, pairs), starts) for at, pairs in ways]
            for (w, damping, way), *others in zip(of_ross, *own, strict=True):
                cells = [seat, f"{rpm:.0f}", way.lower()]
                for value, ratio in ((w, damping), *others):
                    cells += [f"{value / (2.0 * math.pi):.2f}", f"{ratio:.5f}"]
                rows.append(cells)
                worst[rpm] = max(worst.get(rpm, 0.0), abs(others[0][0] / w - 1.0))
    return rows, worst


def differences(answer, table):
    """Return the largest difference of ROSS's coefficients at the points of the table, over the largest."""
    tables = np.array(answer["tables"])  # element, speed, frequency, K or C, 3, 3
    order = np.array([1, 2, 0])
    worst = 0.0
    both = [table.planes(mirrored=mirrored) for mirrored in (False, True)]
    for which, name in enumerate(("K", "C")):
        own = np.concatenate([getattr(one, name) for one in both])[..., order[:, None], order]
        worst = max(worst, float(np.abs(tables[:, :, :, which] - own).max() / np.abs(own).max()))
    return worst


def main():
    """Write the elements, have ROSS use them, compare."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--ross", required=True, help="Python of the environment with ROSS 3")
    parser.add_argument("--output-dir", "-o", type=pathlib.Path, default=pathlib.Path("out/rotor"))
    given = parser.parse_args()
    scene = read_scene(SCENE)
    (table,) = stiffness(scene, SPEEDS).bearings
    files = [*table.to_ross(given.output_dir / "front.toml")]
    files += table.to_ross(given.output_dir / "rear.toml", mirrored=True)
    nodes = layout(table)
    asked = {
        "nodes": nodes.places, "seats": nodes.seats, "diameter": DIAMETER, "disk": DISK, "at": nodes.planes,
        "elements": [file.read_text(encoding="utf-8") for file in files],
        "speeds": [rpm * RPM for rpm in ASKED], "highest": HIGHEST,
    }  # fmt: skip
    answer = ask(given.ross, asked)
    # between the speeds of the table ROSS interpolates, and ours is computed there
    at_speeds = {rpm: stiffness(scene, [rpm]).bearings[0] for rpm in ASKED}
    rows, worst = compare(answer, at_speeds, nodes, table.planes().a)
    lines = [
        "# A shaft on two bearings in ROSS",
        "",
        *sentences(table, answer, rows, worst),
        "",
        markdown(COLUMNS, rows),
    ]
    (given.output_dir / "ross.md").write_text("\n".join(lines), encoding="utf-8")
    write_csv(given.output_dir / "ross.csv", COLUMNS, rows)
    print("\n".join(lines))


def sentences(table, answer, rows, worst):
    """Return the page's sentences."""
    versions, planes = answer["versions"], table.planes()
    off = 100.0 * table.plane_errors().max(axis=(0, 1))
    apart = {
        seat: max(abs(float(row[3]) / float(row[7]) - 1.0) for row in rows if row[0] == seat)
        for seat in SEATS
    }
    one = max(abs(float(row[9]) / float(row[7]) - 1.0) for row in rows if row[0] == "rigid")
    mm = ", ".join(f"{1e3 * place:g}" for place in planes.places)
    return [
        f"`examples/rotor/round_trip.py` made this page. ROSS {versions['ross']} ran on Python "
        f"{versions['python']} in an environment of its own; this program on {machine()}; "
        f"{datetime.date.today()}.",
        "",
        f"Scene {table.scene.name}, {table.preloads[0]:g} N, tables of {len(table.speeds)} speeds and "
        f"{len(table.frequencies)} frequencies. A shaft of steel, {1e3 * DIAMETER:g} mm thick and "
        f"{1e3 * LENGTH:g} mm long, with a tool of {DISK['m']:g} kg, is held by two bearings that carry "
        f"opposite ways. Their planes are at {mm} mm from the centres of the balls.",
        "",
        f"* ROSS reads the six elements, writes them, and reads the same again: {answer['saved_again']}.",
        "* At the points of the table its coefficients differ from ours by "
        f"{differences(answer, table):.0e}.",
        "* It solves each mode with the coefficients of the mode's own frequency. Our solution with springs "
        f"in the same planes differs by at most {worst[ASKED[0]]:.0e} at {ASKED[0]:.0f} r/min, a speed of "
        f"the table, and by {worst[ASKED[1]]:.0e} at {ASKED[1]:.0f} r/min, between two of its speeds.",
        "* The outer planes are beside the balls. A shaft that bends in between moves frequencies by up to "
        f"{100.0 * apart['bending']:.2g} % against five freedoms at their centre. With rigid arms "
        f"without mass over these seats both agree within {100.0 * apart['rigid']:.2g} %; one plane with "
        f"the whole radial stiffness is off by up to {100.0 * one:.2g} %.",
        f"* At the points of the table the three planes have radial, axial and tilt stiffness of the bearing "
        f"within {off[0]:.0e} %, its coupling within {off[1]:.2g} %. They leave out axial coupling of "
        f"up to {off[2]:.2g} %.",
    ]


if __name__ == "__main__":
    main()
