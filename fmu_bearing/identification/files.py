"""Files of an identification: the scene with its new values, tables, a report, a picture."""

import os
import pathlib
from collections.abc import MutableMapping
from typing import Any

import tomlkit
from tomlkit.items import InlineTable, Table

from fmu_bearing.extras import available
from fmu_bearing.files import check_file, check_folder, write_whole
from fmu_bearing.identification.errors import IdentifyError
from fmu_bearing.identification.result import Compared, Estimate, Identified
from fmu_bearing.progress import Tell, silent
from fmu_bearing.results.base import table
from fmu_bearing.results.table import markdown, write_csv
from fmu_bearing.scene import read_scene_text
from fmu_bearing.scene.entries import anchored
from fmu_bearing.scene.read import read_scene
from fmu_bearing.scene.values import steps


def identified_toml(result: Identified, text: str | None = None) -> str:
    """Return a scene file with the identified values, their uncertainties as remarks.

    Parameters
    ----------
    found : Identified
    text : str, optional
        The scene file it started from: its remarks stay, but those behind identified values. Default: the
        scene as the program writes it.

    Raises
    ------
    SceneError
        If the text is not a scene.
    """
    document = tomlkit.parse(result.start.to_toml() if text is None else text)
    for estimate in result.estimates:
        for key in estimate.free.keys:
            _set(document, key, result.values[key], estimate.words)
    made = tomlkit.dumps(document)
    read_scene_text(made, "the identified scene")  # what is written can be read
    return made


def _set(document: MutableMapping[str, Any], key: str, value: float, remark: str) -> None:
    """Set a value at a dotted key, with a remark; tables that only the catalogue has are made."""
    *tables, (last, _) = steps(key)
    part: Any = document
    for name, place in tables:
        if name not in part:
            part[name] = tomlkit.table()
        if isinstance(part[name], str):  # the name of a catalogue entry, whose other values stay
            entry = tomlkit.table()
            entry["catalogue"] = str(part[name])
            part[name] = entry
        part = part[name] if place is None else part[name][place]
    part[last] = float(f"{value:.6g}")
    if last == "preload_N":
        for other in ("preload_class", "preload_offset_um"):  # it takes their place
            part.pop(other, None)
    if isinstance(part, Table) and not isinstance(part, InlineTable):
        part[last].comment(remark)


def output_paths(target: str | os.PathLike[str]) -> tuple[pathlib.Path, pathlib.Path]:
    """Return the scene file that is written, and the folder beside it for all else.

    Raises
    ------
    ValueError
        For a name that is not a TOML file.
    OSError
        Where they cannot be written.
    """
    path = check_file(target, ".toml", "the identified scene")
    return path, check_folder(path.with_suffix(""))


def write_all(
    result: Identified, target: str | os.PathLike[str], source: str | os.PathLike[str] | None = None,
    tell: Tell = silent, *, anyway: bool = False,
) -> list[pathlib.Path]:  # fmt: skip
    """Write the scene, and in a folder of its name tables, a report and, with Matplotlib, a picture.

    Parameters
    ----------
    found : Identified
    target : path
        Scene file to write, such as ``identified.toml``.
    source : path, optional
        Scene file that the search started from, for its remarks.
    tell : callable
        Takes a line where the picture is left out.
    anyway : bool
        Write although values and data contradict each other (``result.doubts``).

    Returns
    -------
    list of Path
        Files written.

    Raises
    ------
    IdentifyError
        With the doubts, unless ``anyway``.
    """
    path, folder = output_paths(target)
    if result.doubts and not anyway:
        way_out = (
            f"{path} is not written: correct the data, free other keys, or write it --anyway (anyway=True)"
        )
        raise IdentifyError("\n".join((*result.doubts, way_out)))
    text = None
    if source is not None:
        read_scene(source)
        text = anchored(pathlib.Path(source).read_text("utf-8-sig"), pathlib.Path(source).parent)
    write_whole(path, identified_toml(result, text).encode("utf-8"))
    files = [
        path,
        write_csv(folder / "levels.csv", *table(Compared, result.compared)),
        write_csv(folder / "values.csv", *table(Estimate, result.estimates)),
        write_csv(folder / "jacobian.csv", *jacobian_table(result)),
        write_whole(folder / "report.md", report(result).encode("utf-8")),
    ]
    if available("matplotlib", "a picture", "levels.png", tell):
        from fmu_bearing.identification.picture import identified_picture, save

        save(identified_picture(result), folder / "levels.png")
        files.append(folder / "levels.png")
    return files


def jacobian_table(result: Identified) -> tuple[list[str], list[list[str]]]:
    """Columns and rows of the slopes: dB per unit of ln(value), or per width of the bounds."""
    fitted = [one.datum.label for one in result.compared if one.datum.fit]
    units = ["dB per ln" if one.free.log else "dB per width of the bounds" for one in result.estimates]
    heads = ["value", *(f"{one.key}, {unit}" for one, unit in zip(result.estimates, units, strict=True))]
    rows = [[label, *(f"{v:.2f}" for v in row)] for label, row in zip(fitted, result.jacobian, strict=True)]
    return heads, rows


def report(result: Identified) -> str:
    """Return all tables and sentences as a page of Markdown."""
    keys = [estimate.key for estimate in result.estimates]
    correlation = [
        [key, *(f"{v:+.2f}" for v in row)] for key, row in zip(keys, result.correlation, strict=True)
    ]
    directions = [
        [f"{value:.3g}", *(f"{v:+.2f}" for v in row)]
        for value, row in zip(result.singular_values, result.directions, strict=True)
    ]
    parts = [
        f"# Identification of {result.scene.name}\n",
        misfit_words(result) + "\n",
        markdown(*table(Estimate, result.estimates)),
        "## Remarks\n",
        "".join(f"* {remark}\n" for remark in (*result.doubts, *result.remarks)) or "None.\n",
        "## Levels\n",
        markdown(*table(Compared, result.compared)),
        "## Slopes of the fitted levels\n",
        markdown(*jacobian_table(result)),
        "## Correlation\n",
        markdown(["", *keys], correlation),
        "## Singular values and their directions\n",
        "Of the slopes over the standard deviations of the levels: inverse standard deviations of the "
        "combinations of ln(value).\n",
        markdown(["singular value", *keys], directions),
    ]
    return "\n".join(parts)


def misfit_words(result: Identified) -> str:
    """Return one sentence on the misfit before and after, fitted and checked."""
    words = []
    for fit, name in ((True, "fitted"), (False, "checked")):
        count = sum(one.datum.fit is fit for one in result.compared)
        if count:
            before, after = result.rms(fit, before=True), result.rms(fit)
            words.append(f"{count} {name} values: {before:.1f} dB rms before, {after:.1f} dB after")
    seeds = "one seed" if len(result.seeds) == 1 else f"{len(result.seeds)} seeds"
    ended = "" if result.complete else " (interrupted)"
    return f"{'; '.join(words)}; searched with fidelity {result.fidelity}, averaged over {seeds}{ended}."
