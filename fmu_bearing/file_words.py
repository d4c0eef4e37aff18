"""Messages about files that serve no purpose: why one cannot be read, and what one holds instead."""

import os
import re
import tempfile
import zipfile

from fmu_bearing.files import no_room, plain_file, read_text

__all__ = ["absent", "instead", "one_line", "text_of", "trouble", "why"]

EMPTY, SCENE, SWEEP, FMU, TABLE = "an empty file", "a scene", "a sweep", "an FMU", "a table of values (CSV)"
RESULT, RECORDING, CATALOGUE = "a result of a run", "a recording", "a catalogue of bearings"
DATASET = "a plan of a data set"
SURFACE, NETCDF = "a surface found from a vibration test", "a netCDF or HDF5 file"

#: What a file has to hold, and where one comes from.
_DUE = {
    SCENE: "a scene is a TOML file, which `fmu-bearing scene new` writes",
    SWEEP: "a sweep is a TOML file with scene and [axes]",
    DATASET: "a plan of a data set is a TOML file with scene, runs and [[class]]",
    FMU: "`fmu-bearing build` makes an FMU of a scene",
    TABLE: "write lines of values under a line of names",
    RESULT: "`fmu-bearing simulate` writes results, as .csv or .nc",
    RECORDING: "`fmu-bearing sound` writes recordings, as .npz",
    CATALOGUE: "a catalogue is a TOML file with one table per bearing",
    SURFACE: "`fmu-bearing vibration --measured` writes one",
    NETCDF: "`fmu-bearing simulate` writes results as .nc",
}
#: Which commands read what is given.
_READ = {
    SCENE: "`fmu-bearing info` and most other commands read scenes",
    SWEEP: "`fmu-bearing sweep` runs it",
    DATASET: "`fmu-bearing dataset` runs it",
    FMU: "`fmu-bearing simulate` runs an FMU, `validate` checks one",
    TABLE: "`fmu-bearing plot` and `compare` read results of runs",
    RECORDING: "`fmu-bearing sound`, `report` and `compare` read recordings",
    SURFACE: "a scene names it as surface in [imperfections], `fmu-bearing sound` as --surface",
}
MAT, MODELICA = "a MATLAB file (.mat)", "a result file of a Modelica tool (.mat)"
WORKBOOK = "a workbook of a spreadsheet"
TDMS, MDF, PARQUET = "a LabVIEW file (.tdms)", "a measurement file (MDF)", "a Parquet file"
UNIVERSAL = "a universal file (.uff), which programs of modal analysis read"
_CSV = "write it as CSV, `time` (s) first:"
#: How what other programs write becomes a table; said where a table or a result is due.
_CONVERT = {
    MAT: f"{_CSV} `writetimetable` or `writetable` in MATLAB, `scipy.io.loadmat` in Python (files of version "
    "7.3: h5py)",
    MODELICA: f'{_CSV} outputFormat="csv" in OpenModelica, "Export result" in Dymola',
    WORKBOOK: "save its sheet as CSV (UTF-8)",
    TDMS: f"{_CSV} nptdms in Python (`to_csv` of its data frame)",
    MDF: f'{_CSV} asammdf in Python (`export("csv")`)',
    UNIVERSAL: f"{_CSV} pyuff in Python reads it; a run is saved as .csv or .nc beside it",
    PARQUET: f"{_CSV} `pandas.read_parquet(...).to_csv(..., index=False)`",
}
_BEGINNINGS = {
    b"MATLAB": MAT,
    b"TDSm": TDMS,
    b"MDF ": MDF,
    b"PAR1": PARQUET,
    b"\xd0\xcf\x11\xe0": WORKBOOK,  # of Excel before 2007
    b"\x89HDF": NETCDF,
    b"-1\n": UNIVERSAL,
    b"-1\r\n": UNIVERSAL,
    b"RIFF": "a WAV file",
    b"\x89PNG": "a picture",
    b"%PDF": "a PDF file",
    b"<": "a page or picture in HTML or XML",
    b"{": "a JSON file",
}
_OF_MODELICA = b"Aclass\0"  # first matrix of a result file (Modelica tools write version 4 of .mat)
_OF_SCENE = re.compile(r"^\s*\[+\s*(bearing|mounting|spindle|operation|lubricant)\b", re.MULTILINE)
_OF_SWEEP = re.compile(r"^\s*\[\s*axes\s*\]", re.MULTILINE)
_OF_DATASET = re.compile(r"^\s*\[\[\s*class\s*\]\]", re.MULTILINE)
_OF_SURFACE = re.compile(r"^\s*\[\s*draws\s*\]", re.MULTILINE)
_LONGEST = 300  # characters of a library's words that are repeated
_HEAD = 65_536  # bytes that are looked at; the tables of a scene begin among the first


def why(problem: Exception) -> str:
    """Return why a file could not be read or written, in one line without Python's own words."""
    if isinstance(problem, UnicodeDecodeError):
        if problem.object[:4] in (b"\xff\xfe\0\0", b"\0\0\xfe\xff"):
            return "it is UTF-32: save it as UTF-8"
        if problem.object[:2] in (b"\xff\xfe", b"\xfe\xff"):
            return "it is UTF-16: save it as UTF-8"
        return f"byte {problem.start + 1} is no character of it: save it as UTF-8"
    if isinstance(problem, OSError) and problem.strerror:
        return problem.strerror[0].lower() + problem.strerror[1:]
    return str(problem)


def one_line(problem: Exception) -> str:
    """Return why a library could not read a file, as `why`, in one line that is never empty."""
    words = " ".join(why(problem).split())
    return words[:_LONGEST] if words else type(problem).__name__


def absent(path: str | os.PathLike[str], kind: str = "file") -> str:
    """Say that there is no such file, or not even its folder."""
    folder = os.path.dirname(os.fspath(path))
    where = f": there is no folder {folder}" if folder and not os.path.isdir(folder) else ""
    return f"there is no such {kind}{where}"


def text_of(path: str | os.PathLike[str], due: str, most: float = 1e9, kind: str = "file") -> str:
    """Return the text of a file in UTF-8, of ``most`` bytes or fewer.

    Raises
    ------
    ValueError
        With `trouble`, and where it holds something else than is ``due``.
    """
    try:
        text = read_text(path, most)
    except (OSError, ValueError) as problem:
        raise ValueError(trouble(path, due, problem, kind)) from None
    if mistaken := instead(path, due):
        raise ValueError(mistaken)
    return text


def trouble(
    path: str | os.PathLike[str], due: str, problem: Exception, kind: str = "file", known: bool = True
) -> str:
    """Return why a file that has to hold what is ``due`` cannot be read: absent, another one, damaged.

    ``kind``: what it is called where it is absent; ``known``: whether the problem is said in words of ours.
    """
    if isinstance(problem, FileNotFoundError):
        return absent(path, kind)
    if not known:
        if full := no_room(tempfile.gettempdir(), problem):
            return f"cannot be unpacked: {full}"
        return instead(path, due) or f"is not {due}, or damaged: {one_line(problem)}"
    text = " as text in UTF-8" if isinstance(problem, UnicodeDecodeError) else ""
    return instead(path, due) or f"cannot be read{text}: {why(problem)}"


def instead(path: str | os.PathLike[str], due: str) -> str:
    """Say what a file holds where something else is due; empty where that is not known.

    Parameters
    ----------
    path : path
    due : str
        What the file had to hold: one of the constants of this module.
    """
    kind = _holds(path)
    fits = kind == due or (kind, due) == (TABLE, RESULT) or (kind == EMPTY and due != SCENE)
    if not kind or fits:
        return ""
    tabular = due in (TABLE, RESULT)
    ways = [_DUE[due], _READ.get(kind, ""), _CONVERT.get(kind, "") if tabular else ""]
    return f"is not {due}, but {kind}: {'; '.join(way for way in ways if way)}"


def _holds(path: str | os.PathLike[str]) -> str:
    """Return what a file holds by its first bytes; empty: unknown, or it cannot be read."""
    try:
        with plain_file(path).open("rb") as file:
            head = file.read(_HEAD)
    except OSError:
        return ""
    if zipfile.is_zipfile(path):
        return _archive(path)
    known = next((words for mark, words in _BEGINNINGS.items() if head.lstrip().startswith(mark)), "")
    if not known and _OF_MODELICA in head[:64]:
        return MODELICA
    if not known and b"\0" in head and os.fspath(path).lower().endswith(".mat"):
        return MAT  # of version 4, which has no mark of its own
    if known or b"\0" in head:
        return known
    text = head.decode("utf-8-sig", errors="ignore")
    first = next((line for line in text.splitlines() if line.strip() and line.lstrip()[0] != "#"), "")
    if not first:
        return EMPTY
    if _OF_SCENE.search(text):
        return SCENE
    if _OF_SWEEP.search(text):
        return SWEEP
    if _OF_DATASET.search(text):
        return DATASET
    if _OF_SURFACE.search(text):
        return SURFACE
    if "=" not in first and any(mark in first for mark in ",;\t"):
        return TABLE
    return ""


def _archive(path: str | os.PathLike[str]) -> str:
    try:
        with zipfile.ZipFile(path) as archive:
            names = archive.namelist()
    except Exception:  # zipfile raises what it comes upon
        return "a damaged archive"
    if "modelDescription.xml" in names:
        return FMU
    if "head.npy" in names:
        return RECORDING
    if "xl/workbook.xml" in names or {"mimetype", "content.xml"} <= set(names):
        return WORKBOOK
    return "a NumPy archive" if any(name.endswith(".npy") for name in names) else "a ZIP archive"
