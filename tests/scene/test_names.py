"""Names in letters of any script: of scenes, bearings and microphones, in files and in FMUs."""

import re
import zipfile
from xml.etree import ElementTree

import pytest

from fmu_bearing import Recording, Run, SceneError, build_fmu, read_scene, record, simulate
from fmu_bearing.fmi.description import identifier
from fmu_bearing.scene.designation import ascii_word
from fmu_bearing.scene.scene import scene_name
from tests.conftest import EXAMPLES

SCENE = EXAMPLES / "7003C-bare.toml"
NAMES = ["Prüfstand Größe 3", "主轴轴承-1", "Подшипник 7003", "ベアリング", "Ρουλεμάν", "7003C-spindle"]


def named(tmp_path, name):
    text = SCENE.read_text("utf-8").replace('name = "7003C-bare"', f'name = "{name}"')
    text = text.replace('name = "P1"', f'name = "{name[:20]}"')
    file = tmp_path / f"{name}.toml"
    file.write_text(text, "utf-8")
    return file


@pytest.mark.heavy
@pytest.mark.parametrize("name", NAMES)
def test_a_scene_may_have_any_letters(tmp_path, name):
    scene = read_scene(named(tmp_path, name)).replace(
        {"bearing.designation": name[:20], "fidelity.model": "response"}
    )
    assert scene.name == name
    assert re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*", identifier(scene))
    run = simulate(scene, 2e-3, outputs=["friction_torque"])
    for ending in ("csv", "nc"):
        back = Run.load(run.save(tmp_path / f"{name}.{ending}"))
    assert back.name == name and back.scene == scene
    record(scene, 0.01).save(tmp_path / f"{name}.npz")
    assert Recording.load(tmp_path / f"{name}.npz").microphones[0][0] == name[:20]


@pytest.mark.parametrize("name", ["a/b", "a\nb", "_a", " a", "-a", "a:b", "a" * 61, "", "a\u200bb", '7"b'])
def test_names_that_are_none(name):
    with pytest.raises(SceneError, match="name = .* is refused; allowed: text of 1 to 60 letters"):
        read_scene(SCENE).replace({"name": name})


@pytest.mark.parametrize("flavour", ["python", "native"])
def test_an_fmu_has_the_name_and_a_safe_file(tmp_path, monkeypatch, flavour):
    monkeypatch.chdir(tmp_path)
    scene = read_scene(named(tmp_path, "Prüfstand 主轴")).replace({"bearing.designation": "7003C-Größe"})
    made = build_fmu(scene, flavour=flavour)
    assert made.path.name == "Bearing7003C_Groesse.fmu"
    with zipfile.ZipFile(made.path) as archive:
        root = ElementTree.fromstring(archive.read("modelDescription.xml"))
        assert all(file.isascii() for file in archive.namelist())
    assert root.get("modelName") == "Prüfstand 主轴"
    assert root.find("CoSimulation").get("modelIdentifier") == "Bearing7003C_Groesse"
    assert simulate(made.path, 2e-3).name == "Prüfstand 主轴"


def test_words_in_ascii():
    assert ascii_word("7003C/P4") == "7003C_P4"
    assert ascii_word("Größe Ø Ärger") == "Groesse___Aerger"
    assert ascii_word("u\u0308é") == "uee"  # decomposed, as macOS names files
    assert ascii_word("主轴7003") == "__7003"


STEMS = [
    ("a+b(c)", "a-b-c-"), ("_x", "x"), ("主轴", "主轴"), ("u\u0308", "ü"), ("~", "scene"),
    ("x" * 80, "x" * 60),
]  # fmt: skip


@pytest.mark.parametrize(("stem", "name"), STEMS)
def test_a_scene_is_named_after_its_file(stem, name):
    assert scene_name(stem) == name
    assert read_scene(SCENE).replace({"name": scene_name(stem)}).name == name


def test_a_picture_says_that_letters_are_absent(tmp_path, monkeypatch):
    from fmu_bearing.results import picture_parts

    monkeypatch.setattr(picture_parts, "_FONTS", ())  # as on a machine without them
    figure, axes = picture_parts.single((3.0, 2.0))
    axes.set_title("主轴")
    with pytest.warns(UserWarning, match=r"boxes in place of letters .* install Noto Sans CJK") as caught:
        picture_parts.save(figure, tmp_path / "picture.png")
    assert len(caught) == 1
