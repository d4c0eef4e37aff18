"""Parts of the page on architecture made from the code: floors, rooms, arrays, fidelities and methods.

Each function returns Markdown; ``hooks.py`` puts it into the page that asks for it.
"""

import ast
import configparser
import importlib
import re
from pathlib import Path

from fmu_bearing.engine.choices import FIDELITIES, METHODS
from fmu_bearing.scene import SceneError, read_scene
from fmu_bearing.scene.read import with_fidelity

ROOT = Path(__file__).parents[2]
PACKAGE = ROOT / "fmu_bearing"
LAYOUT = PACKAGE / "engine" / "layout"
#: Arrays of the state table, in the order in which the page names them.
ARRAYS = ("p", "u", "s", "z", "w", "c", "y")

_NAMES = re.compile(r"`\w+`(?:, `\w+`)*(?=\s|$)")


def floors():
    """Floors of the package, highest first, and the contracts besides, from ``.importlinter``."""
    contracts = configparser.ConfigParser()
    contracts.read(ROOT / ".importlinter", encoding="utf-8")
    lines = ["```text"]
    for floor in contracts["importlinter:contract:floors"]["layers"].split("\n"):
        if floor.strip():
            lines.append(floor.strip().replace(" | ", "     "))
    lines += ["```", "", _row(("contract", "who", "must not import")), _row(["---"] * 3)]
    for section in contracts.sections():
        contract = contracts[section]
        if contract.get("type") == "forbidden":
            who, whom = (
                ", ".join(f"`{name.removeprefix('fmu_bearing.')}`" for name in contract[key].split())
                for key in ("source_modules", "forbidden_modules")
            )
            lines.append(_row((contract["name"], who, whom)))
    return "\n".join(lines)


def rooms():
    """Every module with what it holds: the packages, then one table for each of them."""
    first, rows = _map(PACKAGE)
    lines = [_row(("package", "holds")), _row(["---"] * 2)]
    lines += [_row((_shown(names), text)) for names, text in rows]
    for names, _ in rows:
        for name in names:
            if (PACKAGE / name).is_dir():
                first, _ = _map(PACKAGE / name)
                lines += ["", f"### `{name}`", "", first, "", _row(("module", "holds")), _row(["---"] * 2)]
                lines += _modules(PACKAGE / name, "")
    return "\n".join(lines)


def _modules(folder, path):
    """Rows for the modules of a package, those of a package within it below its own row."""
    for names, text in _map(folder)[1]:
        yield _row((_shown(names, path), text))
        for name in names:
            if (folder / name / "__init__.py").exists():
                yield from _modules(folder / name, f"{path}{name}/")


def _map(folder):
    """Return the first sentence and the rows (names, text) of a package's docstring."""
    text = ast.get_docstring(ast.parse((folder / "__init__.py").read_text("utf-8"))) or ""
    rows = []
    for line in text.replace("``", "`").splitlines():
        names = _NAMES.match(line)
        if names is not None:
            rows.append((re.findall(r"\w+", names[0]), line[names.end() :].strip()))
        elif rows and line.startswith(" "):  # a row that goes on
            rows[-1] = (rows[-1][0], f"{rows[-1][1]} {line.strip()}")
        elif rows:
            break
    return text.split("\n", 1)[0].replace("``", "`"), rows


def _shown(names, path=""):
    return ", ".join(f"`{path}{name}`" for name in names)


def state():
    """Places of the arrays: name, place, size, and the comment beside it."""
    lines = []
    for name in ARRAYS:
        lines += ["", f"### `{name}`", "", *_places(name)]
    return "\n".join(lines)


def _places(name):
    """Lines for one module of the layout: a table for each counter of places."""
    source = (LAYOUT / f"{name}.py").read_text("utf-8")
    module = importlib.import_module(f"fmu_bearing.engine.layout.{name}")
    text = source.splitlines()
    tables, counters = [], {}
    for node in ast.parse(source).body:
        if not (isinstance(node, ast.Assign) and isinstance(node.value, ast.Call)):
            continue
        target, call = ast.unparse(node.targets[0]), node.value
        remark = text[node.end_lineno - 1].partition("  # ")[2]
        above = _above(text, node.lineno)
        called = ast.unparse(call.func)
        if called == "Places":
            counters[target] = []
            tables.append((above, counters[target]))
        elif called in counters and not target.startswith("_"):
            if above:
                counters[called].append(_row(("", "", "", f"*{above}*")))
            size = _size(ast.unparse(call.args[0]) if call.args else "1", module)
            counters[called].append(_row((f"`{target}`", getattr(module, target), size, remark)))
        elif called.endswith(".index"):
            if "index" not in counters:
                counters["index"] = []
                tables.append(("", counters["index"]))
            meaning = f"`{call.args[0].value}`" + (f": {remark}" if remark else "")
            counters["index"].append(_row((f"`{target}`", getattr(module, target), "", meaning)))
    lines = []
    for title, rows in tables:
        lines += [f"{title[0].upper()}{title[1:]}:", ""] if title else []
        lines += [_row(("name", "place", "size", "unit, meaning")), _row(["---"] * 4), *rows, ""]
    return lines


def _size(expression, module):
    """Size of a place as a number, with the expression that it comes from."""
    number = eval(expression, dict(vars(module)))
    if expression.isdigit():
        return number
    plain = re.sub(r"\b_(?=[A-Z])", "", expression)  # modules of the layout import each other as _C, _Y
    return f"{number} = `{plain}`"


def _above(text, number):
    """Return the comment in the lines right above line ``number``."""
    found = []
    for line in reversed(text[: number - 1]):
        if not line.startswith("# "):
            break
        found.insert(0, line[2:].strip())
    return " ".join(found)


def fidelities():
    """Which fidelity reads which method, and with which the rings may bend, as the scene accepts it."""
    bending = read_scene(ROOT / "examples" / "scenes" / "7009C-full-ceramic.toml")
    lines = [_row(("fidelity", *(f"`{method}`" for method in METHODS))), _row(["---"] * (1 + len(METHODS)))]
    for model in FIDELITIES:
        cells = []
        for method in METHODS:
            if model != "full":
                cells.append("not read; rigid rings" if not _accepts(bending, model, method) else "not read")
            else:
                cells.append("bending or rigid rings" if _accepts(bending, model, method) else "rigid rings")
        lines.append(_row((f"`{model}`", *cells)))
    return "\n".join(lines)


def _accepts(scene, model, method):
    try:
        with_fidelity(scene, model=model, method=method)
    except SceneError:
        return False
    return True


def _row(cells):
    return "| " + " | ".join(str(cell).replace("|", "\\|") for cell in cells) + " |"
