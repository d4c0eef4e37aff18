"""Catalogues of one's own: bearings in TOML files that scenes name."""

import pytest

from fmu_bearing.identification.files import anchored
from fmu_bearing.scene import Scene, SceneError, read_scene, read_scene_text
from fmu_bearing.scene.entries import catalogue, entries, entry_text, using
from fmu_bearing.scene.origins import origins
from fmu_bearing.scene.template import new_scene
from tests.messages import says

HEAD = 'catalogues = ["bearings/own.toml"]\n'


@pytest.fixture
def own(tmp_path):
    """Write a file with one bearing, changed as given; return it."""
    text = entry_text(entries("bearings")["7003C"], "7003C").replace("[7003C", "[OWN")

    def write(old="", new="", name="own.toml"):
        path = tmp_path / "bearings" / name
        path.parent.mkdir(exist_ok=True)
        assert old in text
        path.write_text(text.replace(old, new, 1) if old else text + new, "utf-8")
        return path

    return write


def scene_text(head=HEAD):
    return head + new_scene("a", "7003C", sound=False).replace('catalogue = "7003C"', 'catalogue = "OWN"')


def refusal(folder, head=HEAD):
    with pytest.raises(SceneError) as caught:
        read_scene_text(scene_text(head), "a.toml", folder)
    return caught.value.problems


def test_a_scene_names_its_catalogue_from_its_folder(own, tmp_path, monkeypatch):
    own("ball_count = 12", "ball_count = 11")
    file = tmp_path / "a.toml"
    file.write_text(scene_text(), "utf-8")
    scene = read_scene(file)
    assert scene.bearing.ball_count == 11
    # the resolved scene knows no file
    assert "catalogues" not in scene.to_toml() and read_scene_text(scene.to_toml()) == scene
    found = {one.key: one for one in origins(file)}
    assert found["bearing.ball_count"].origin == "catalogue OWN of own.toml"
    assert not found["bearing.ball_count"].assumed and found["bearing.inner_conformity"].assumed
    monkeypatch.chdir(tmp_path)
    assert (
        scene.replace({"catalogues": ["bearings/own.toml"], "bearing.catalogue": "OWN"}).bearing.ball_count
        == 11
    )
    tables = scene.model_dump() | {"catalogues": ["bearings/own.toml"], "bearing": {"catalogue": "OWN"}}
    assert Scene.from_dict(tables).bearing.ball_count == 11


def test_files_in_use_hold_for_all_scenes_meanwhile(own):
    path = own()
    with using([path]):
        assert "OWN" in catalogue("bearings")
        assert read_scene_text(scene_text("")).bearing.ball_count == 12
        assert (
            read_scene_text(scene_text(), folder=path.parents[1]).bearing.ball_count == 12
        )  # one file, once
    assert "OWN" not in catalogue("bearings")


def test_errors_name_file_entry_and_key(own, tmp_path):
    path = own("bore_mm = 17.0", "boer_mm = 17.0")
    missing, unknown = refusal(tmp_path)
    where = f"a.toml: {path}: [OWN]"
    assert says(missing, f"{where} bore_mm ... for example bore_mm = 17.0")
    assert says(unknown, f"{where} boer_mm ... did you mean 'bore_mm'?")
    own("bore_mm = 23.4", "bore_mm = 29.0")
    assert any(f"{path}: [OWN] cage.bore_mm = 29.0 must be below" in line for line in refusal(tmp_path))
    own("ball_count = 12", "ball_count = ")
    (line,) = refusal(tmp_path)
    assert line.startswith(f"a.toml: {path}: not valid TOML")
    own(new="[half]\nbore_mm = 3.0\n")
    assert all(f"{path}: [half] " in line for line in refusal(tmp_path))
    path.unlink()
    assert refusal(tmp_path) == (f"a.toml: {path}: there is no such catalogue file",)
    for given in ('"own.toml"', "[3]", '[""]'):
        assert "allowed: a list of files" in refusal(tmp_path, f"catalogues = {given}\n")[0]


def test_a_name_of_the_package_is_refused_with_the_way_out(own, tmp_path):
    path = own("[OWN]", "[NSK-7003C]")
    path.write_text(path.read_text("utf-8").replace("[OWN.cage]", "[NSK-7003C.cage]"), "utf-8")
    (line,) = refusal(tmp_path)
    assert says(line, f"a.toml: {path}: [NSK-7003C] ... for example [my-NSK-7003C]")
    first, second = own(), own(name="more.toml")
    (line,) = refusal(tmp_path, 'catalogues = ["bearings/own.toml", "bearings/more.toml"]\n')
    assert line.startswith(f"a.toml: {second}: [OWN] is in {first}, too: give it a name of its own")


def test_a_scene_that_is_written_elsewhere_keeps_its_catalogue(own, tmp_path):
    own()
    moved = anchored(scene_text(), tmp_path)
    assert read_scene_text(moved, "a").bearing.ball_count == 12
    plain = scene_text("")
    assert anchored(plain, tmp_path) == plain
