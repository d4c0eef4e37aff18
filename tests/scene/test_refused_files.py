"""What is wrong with a file as a whole: absent, unreadable, no TOML, too large, of another program."""

import pickle
import time

import pytest

from fmu_bearing.scene import SceneError, read_scene, read_scene_text
from tests.scene.refusals import TEXT, problems


def test_missing_file(tmp_path):
    with pytest.raises(SceneError, match=r"none\.toml: there is no such scene file"):
        read_scene(tmp_path / "none.toml")


@pytest.mark.parametrize("path", [".", "a\0b"])
def test_what_is_no_file(path):
    with pytest.raises(SceneError, match="cannot be read"):
        read_scene(path)


def test_text_that_is_not_utf_8(tmp_path):
    path = tmp_path / "latin.toml"
    path.write_bytes("name = 'é'".encode("latin-1"))
    with pytest.raises(SceneError, match="UTF-8"):
        read_scene(path)


def test_byte_order_mark_and_windows_line_ends_are_read(tmp_path):
    path = tmp_path / "windows é #1.toml"
    path.write_bytes(b"\xef\xbb\xbf" + TEXT.replace("\n", "\r\n").encode("utf-8"))
    assert read_scene(path) == read_scene_text(TEXT)


@pytest.mark.parametrize("text", ["name = \n", "a = 1\na = 2\n", "x = " + "[" * 100_000])
def test_toml_syntax(text):
    with pytest.raises(SceneError, match="b.toml: not valid TOML"):
        read_scene_text(text, "b.toml")


def reported(text):
    """Message about a text, and the seconds of a core that it took."""
    begin = time.process_time()
    with pytest.raises(SceneError) as caught:
        read_scene_text(text, "a.toml")
    return str(caught.value), time.process_time() - begin


@pytest.mark.parametrize("above", [True, False])
def test_a_file_of_another_program_is_answered_at_once(above):
    """20,000 keys that no scene has; a search through all of them for each takes a thousand times as long.

    Ten times as many keys take ten times as long, so the machine's own speed does not count; a search for
    each key would take a hundred times as long.
    """

    def answer(count):
        keys = "".join(f"key_{k} = {k}\n" for k in range(count))
        return reported(keys + TEXT if above else f"{TEXT}[sound.circle]\n{keys}")

    few = min(answer(2_000)[1] for _ in range(3))
    message, seconds = answer(20_000)
    assert seconds < 40.0 * few
    lines = message.splitlines()
    assert len(lines) == 21
    # the circle also lacks its three keys, which are listed first
    first = 0 if above else 3
    assert f"key_{19 - first} is not a key of a scene" in lines[19]
    assert (
        lines[20]
        == f"a.toml: and {19_980 + first} more problems, which are listed once these 20 are corrected"
    )


def test_twenty_problems_are_reported_without_a_rest():
    keys = "".join(f"key_{k} = {k}\n" for k in range(20))
    message = reported(keys + TEXT)[0]
    assert len(message.splitlines()) == 20 and "more problems" not in message


@pytest.mark.parametrize(
    ("old", "more", "words"),
    [
        ("preload_N = 500.0", "preload_N = 1.0", "'preload_N = 1.0' gives a key or table twice"),
        (
            "preload_N = 500.0",
            "'preload_N' = [\n 1,\n 2]",
            "'2]' gives a key or table twice",
        ),
        (
            "[mounting]",
            "[[sound.microphone]]\n[mounting]",
            "'[mounting]' gives a key or table twice",
        ),
        (
            "preload_N = 500.0",
            "rotor = { a = 1, a = 2 }",
            "'rotor = { a = 1, a = 2 }' gives a key or table twice: keep one",
        ),
    ],
)
def test_a_key_that_is_given_twice_is_named_with_its_line(old, more, words):
    text = TEXT.replace(old, f"{old}\n{more}", 1)
    message = reported(text)[0]
    assert words in message, message
    last = text.splitlines().index(old) + 1 + len(more.splitlines())
    assert f"not valid TOML: line {last}: " in message


def test_a_key_that_is_given_twice_at_the_end_of_the_file():
    assert "line 3: 'b = 2' gives a key or table twice: keep one" in reported("[a]\nb = 1\nb = 2")[0]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("x = " + "[" * 100_000, "its brackets are nested too deeply"),
        (TEXT + "x = " + "[" * 2000 + "]" * 2000, "its brackets are nested too deeply"),
        ("x = " + "{a = " * 3000 + "1" + "}" * 3000, "its brackets are nested too deeply"),
        ("x = [\n" + "[\n" * 3000, "its brackets are nested too deeply"),
        ("[" + ".".join("a" * 60_000) + "]\nb = 1", "line 1 names a table more than 50 levels deep"),
        (".".join("a" * 60_000) + " = 1", "line 1 names a table more than 50 levels deep"),
        ("[" + ".".join("a" * 40) + "]\nb = 1", "a is not a key of a scene"),
        (TEXT + "x = " + "[" * 200 + "]" * 200, "is not a key of a scene"),
    ],
)
def test_deep_nesting_is_explained(text, words):
    message, seconds = reported(text)
    assert words in message and "recursion" not in message and seconds < 2.0


def test_a_key_with_a_line_break_or_without_end_stays_one_line():
    lines = problems(text=f'"a\\nb" = 1\n{"x" * 10_000} = 1\n{TEXT}')
    assert len(lines) == 2 and lines[0].startswith(r"a\nb is not") and len(lines[1]) < 300


@pytest.mark.parametrize("what", [[1], None, 3.5, b"a.toml", {"name": "a"}])
def test_what_is_no_path_is_refused_by_its_type(what):
    with pytest.raises(SceneError, match=f"not .*{type(what).__name__.replace('NoneType', 'None')}"):
        read_scene(what)


def test_empty_file_names_every_table():
    lines = problems(text="")
    for table in "bearing materials lubricant mounting operation".split():
        assert any(f"{table} is missing: the table [{table}]" in line for line in lines)
    assert any('catalogue = "7003C"' in line for line in lines)
    assert 'name is missing, for example name = "7003C-spindle"' in lines[0]
    assert len(lines) == 6


def test_error_survives_pickling():
    error = SceneError("a: one\na: two")
    again = pickle.loads(pickle.dumps(error))
    assert again.problems == ("a: one", "a: two")
