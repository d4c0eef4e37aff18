"""Which file Windows is asked for, by the resource locations that hosts there pass.

``path.c`` is compiled as for Windows, with a stand-in for the three functions that it calls. What it opens
first is looked at; further lines are its other attempts, for nothing is ever found.
"""

import subprocess

import pytest

from . import toy

PLAIN = r"C:/runs/resources/model.bin"
EXTENDED = r"\\?\C:\runs\resources\model.bin"


@pytest.fixture(scope="module")
def asked(compiler, tmp_path_factory):
    """A function: the files that are asked for, for a location as text or bytes."""
    program = tmp_path_factory.mktemp("windows") / "paths"
    folder = toy.HERE / "windows"
    sources = [folder / "paths.c", toy.SHIM / "path.c", toy.SHIM / "text.c"]
    toy.run(
        [compiler, *toy.WARNINGS, "-D_WIN32", f"-I{folder}", f"-I{toy.SHIM}", *map(str, sources),
         "-o", str(program), "-lm"]
    )  # fmt: skip

    def ask(location):
        done = subprocess.run(
            [str(program), location], capture_output=True, text=True, check=True, timeout=600
        )
        return done.stdout.splitlines()

    return ask


@pytest.mark.parametrize(
    ("location", "file"),
    [
        ("file:///C:/runs/resources", PLAIN),
        ("file:///C:/my%20runs/resources/", "C:/my runs/resources/model.bin"),
        ("file://C:/runs/resources", PLAIN),
        ("C:\\runs\\resources\\", r"C:\runs\resources\model.bin"),
        ("file://server/share/resources", "//server/share/resources/model.bin"),
    ],
)
def test_usual_locations(asked, location, file):
    assert asked(location)[0] == file


@pytest.mark.parametrize(
    "location",
    [
        r"\\?\C:\runs\resources",
        "\\\\?\\C:\\runs\\resources\\",
        "//?/C:/runs/resources",
        r"file:///\\?\C:\runs\resources",
        r"file:\\?\C:\runs\resources",
        "file:////?/C:/runs/resources",
        "file://///?/C:/runs/resources",
        "file:///%5C%5C%3F%5CC:%5Cruns%5Cresources",
        "file:///%5C%5C%3F%5CC%3A/runs/resources/",
    ],
)
def test_extended_paths_have_backslashes_alone(asked, location):
    r"""Behind \\?\ Windows takes a slash for a letter; paths longer than 260 letters need this."""
    assert asked(location)[0] == EXTENDED


def test_extended_paths_of_servers_and_devices(asked):
    assert asked(r"\\?\UNC\server\share\resources")[0] == r"\\?\UNC\server\share\resources\model.bin"
    assert asked("//./C:/runs/resources")[0] == r"\\.\C:\runs\resources\model.bin"


def test_code_page_of_the_system_is_tried_where_the_path_is_no_utf8(asked):
    assert asked("file:///C:/Läufe")[0] == "C:/L<e4>ufe/model.bin"
    assert asked(b"file:///C:/L\xe4ufe")[0] == "C:/L<e4>ufe/model.bin"
    assert asked("file:///C:/L%E4ufe")[0] == "C:/L<e4>ufe/model.bin"
    # UTF-8 comes first: in the code page the same bytes are two letters
    assert asked("file:///C:/L%C3%A4ufe")[:2] == ["C:/L<e4>ufe/model.bin", "C:/L<c3><a4>ufe/model.bin"]
