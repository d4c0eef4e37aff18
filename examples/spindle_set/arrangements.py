"""Draw the usual arrangements of bearings on one shaft: ``python arrangements.py [FILE]``, a second."""

import argparse
import pathlib

from fmu_bearing import Scene, read_scene
from fmu_bearing.results.picture_parts import save
from fmu_bearing.steady.drawing import set_figure

PAIR = pathlib.Path(__file__).with_name("7003C-DB.toml")
SETS = {
    "DB (O): + -": "+-",
    "DF (X): - +": "-+",
    "DT: + +, under a load towards +x": "++",
    "TBT (O): + + -": "++-",
    "QBC (O): + + - -": "++--",
    "QFC (X): - - + +": "--++",
}
_FIRST, _APART, _BEYOND = 20.0, 24.0, 20.0  # mm


def scenes() -> dict[str, Scene]:
    """Return the arrangements by their titles: 7003C side by side on a plain shaft."""
    base = read_scene(PAIR).model_dump(mode="json", exclude_none=True)
    found = {}
    for title, signs in SETS.items():
        length = _FIRST + _APART * (len(signs) - 1) + _BEYOND
        base["spindle"] = {
            "shaft": {"sections_mm": [[length, 17.0, 0.0]]},
            "bearing": [
                {"position_mm": _FIRST + _APART * k, "carries": f"{sign}x"} for k, sign in enumerate(signs)
            ],
            "load": {"force_x_N": 100.0},
        }
        found[title] = Scene.from_dict(base)
    return found


def main() -> None:
    """Write the picture."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("file", nargs="?", default="arrangements.png", help="picture to write")
    save(set_figure(scenes()), parser.parse_args().file)


if __name__ == "__main__":
    main()
