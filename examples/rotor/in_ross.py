"""The part of the round trip that runs in the environment of ROSS 3: JSON comes in, JSON goes out.

It reads the elements, returns their coefficients, puts them into a rotor and solves that. It knows nothing of
this program but the text of its files.
"""

import json
import pathlib
import sys
import tempfile
import warnings

import numpy as np

warnings.simplefilter("ignore")
import ross  # noqa: E402


def elements(texts, nodes, folder):
    """Read each text as a file; the node of the rotor replaces that of the file."""
    found = []
    for k, (text, node) in enumerate(zip(texts, nodes, strict=True)):
        file = pathlib.Path(folder) / f"element-{k}.toml"
        file.write_text(text, encoding="utf-8")
        element = ross.BearingElement.load(file)
        element.n, element.tag = node, f"element {k}"
        found.append(element)
    return found


def saved_again(element, folder):
    """Whether ROSS writes the element and reads the same one back."""
    # ROSS adds an element to a file that is there and reads the first one
    file = pathlib.Path(folder) / f"{element.tag} again.toml"
    element.save(file)
    return bool(ross.BearingElement.load(file) == element)


def shaft_of(asked, stiff):
    """Return the shaft's elements; with ``stiff`` seats rigid arms without mass lie over them."""
    steel = ross.Material("steel", rho=7850.0, E=2.1e11, G_s=8.1e10)
    rigid = ross.Material("rigid", rho=1e-3, E=2.1e13, G_s=8.1e12)
    lengths = np.diff(asked["nodes"])
    found = []
    for k, length in enumerate(lengths):
        found.append(ross.ShaftElement(L=length, idl=0.0, odl=asked["diameter"], material=steel, n=k))
        if stiff and k in asked["seats"]:
            found.append(ross.ShaftElement(L=length, idl=0.0, odl=asked["diameter"], material=rigid, n=k))
    return found


def solved(asked, bearings, stiff):
    """Return modes at each speed (rad/s, damping ratio, whirl) and the matrices of the shaft alone."""
    shaft, disk = shaft_of(asked, stiff), ross.DiskElement(n=0, **asked["disk"])
    rotor, alone = ross.Rotor(shaft, [disk], bearings), ross.Rotor(shaft, [disk])
    modes = []
    for speed in asked["speeds"]:
        modal = rotor.run_modal(speed, num_modes=24, sparse=False, matched_whirl=True)
        rows = zip(modal.wd, modal.damping_ratio, modal.whirl_direction(), strict=False)
        found = [[float(w), float(d), str(way)] for w, d, way in rows if 1.0 < w < asked["highest"]]
        modes.append(sorted(found))
    matrices = {"M": alone.M(0.0), "K": alone.K(0.0), "C": alone.C(0.0), "G": alone.G()}
    return {"modes": modes, "shaft": {name: np.asarray(m).tolist() for name, m in matrices.items()}}


def main(asked):
    """Return what ROSS makes of the elements."""
    with tempfile.TemporaryDirectory() as folder:
        bearings = elements(asked["elements"], asked["at"], folder)
        again = all([saved_again(element, folder) for element in bearings])
    speeds, frequencies = bearings[0].speed, bearings[0].frequency
    tables = [
        [[[element.K(f, v).tolist(), element.C(f, v).tolist()] for f in frequencies] for v in speeds]
        for element in bearings
    ]
    versions = {"ross": ross.__version__, "python": sys.version.split()[0], "numpy": np.__version__}
    return {
        "versions": versions, "saved_again": again, "tables": tables,
        "bending": solved(asked, bearings, False), "rigid": solved(asked, bearings, True),
    }  # fmt: skip


if __name__ == "__main__":
    # ROSS and its packages print, too: the answer is the last line
    print(json.dumps(main(json.load(sys.stdin))))
