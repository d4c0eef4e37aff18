"""Gate scenes: frozen files that take no value from a default, a catalogue or an example.

Gates of all designs and speed goals run on them. A better default or a better example then moves no gate,
and a gate that moves has moved because what is computed has changed.
"""

import hashlib
import json
import tomllib

import pytest

from fmu_bearing.scene import read_scene
from tests.conftest import GATES

#: SHA-256 of what each file is read as: remarks and layout do not count, every value does.
FROZEN = {
    "7003C-bare": "93275fba85f79a8a71f0d4ee80d531a9114edabedb18a607d0da08bad277e381",
    "7003C-impact": "db4572d540e67b0fcebc3e824409a0002126eae7da8fb1df60ac2bb2589e4e99",
    "7003C-spindle": "d6b49b80770202e5e7d7180a71dfe97f0603238174f3b3014936df657f2f8169",
    "7009C-full-ceramic": "f95ed2ec585ca4b420d622ba6fe5e7889bd5c5271373c277774df3088d21f147",
    "7009C-steel": "8eb3e791dc02fb4d33d5b91c79bf449ad1c450c9fc650609b176c23c956590d8",
}
#: Keys that stand for values elsewhere.
REFERENCES = {"catalogue", "grade"}


def text_of(name):
    return (GATES / f"{name}.toml").read_text(encoding="utf-8")


def values(name):
    """Everything that the scene model holds after reading the file; what is absent is left out."""
    return read_scene(GATES / f"{name}.toml").model_dump(mode="json", exclude_none=True)


def digest(data):
    return hashlib.sha256(json.dumps(data, sort_keys=True).encode("utf-8")).hexdigest()


def keys(data, path=""):
    """Dotted keys of all tables and values, members of lists numbered from 1 as in messages about scenes."""
    for key, value in data.items():
        dotted = f"{path}.{key}".lstrip(".")
        yield dotted
        if isinstance(value, dict):
            yield from keys(value, dotted)
        elif isinstance(value, list):
            for k, member in enumerate(value, start=1):
                if isinstance(member, dict):
                    yield from keys(member, f"{dotted}[{k}]")


def defaulted(data, written):
    """Keys of the model that the file does not give."""
    return sorted(set(keys(data)) - set(keys(written)))


def test_every_gate_scene_is_known():
    assert sorted(path.stem for path in GATES.glob("*.toml")) == sorted(FROZEN)


@pytest.mark.parametrize("name", FROZEN)
def test_no_gate_scene_takes_a_value_from_a_default(name):
    missing = defaulted(values(name), tomllib.loads(text_of(name)))
    assert not missing, (
        f"tests/scenes/gates/{name}.toml takes defaults for {', '.join(missing)}: write out there the value "
        "with which the scene computes what it computed before the key existed"
    )


@pytest.mark.parametrize("name", FROZEN)
def test_no_gate_scene_refers_to_the_catalogue(name):
    written = tomllib.loads(text_of(name))
    assert not [key for key in keys(written) if key.rpartition(".")[2] in REFERENCES]
    # a material may be a name alone
    assert all(isinstance(material, dict) for material in written["materials"].values())


@pytest.mark.parametrize("name", FROZEN)
def test_gate_scenes_are_read_as_written(name):
    assert values(name) == tomllib.loads(text_of(name))
    assert values(name)["name"] == name


@pytest.mark.parametrize("name", FROZEN)
def test_gate_scenes_say_that_they_are_frozen(name):
    first, source, *_ = text_of(name).splitlines()
    assert first.startswith("# Gate scene: frozen. Gates and speed goals run on it; ")
    assert source.startswith(f"# Source: examples/scenes/{name}.toml ")


@pytest.mark.parametrize("name", FROZEN)
def test_gate_scenes_are_frozen(name):
    found = digest(values(name))
    assert found == FROZEN[name], (
        f"gate scenes are frozen, and tests/scenes/gates/{name}.toml holds other values than it did: take "
        "the edit back, and change the example or the default instead. Where the scene model itself has a "
        "new or a renamed key, give the file the value that computes what was computed before, and record "
        f"here the hash {found}"
    )


# --- what the tests above would say ----------------------------------------------------------------


def test_a_key_left_to_its_default_is_found():
    data = values("7003C-bare")
    written = tomllib.loads(text_of("7003C-bare"))
    assert defaulted(data, written) == []
    del written["fidelity"]["tolerance"], written["sound"]["microphone"][1]["x_mm"]
    del written["imperfections"]["inner_race_harmonic"], written["fidelity"]["accuracy"]
    assert defaulted(data, written) == [
        "fidelity.accuracy",
        "fidelity.accuracy.level_dB",
        "fidelity.accuracy.relative",
        "fidelity.tolerance",
        "imperfections.inner_race_harmonic",
        "sound.microphone[2].x_mm",
    ]


def test_the_hash_sees_values_alone(tmp_path):
    text = text_of("7003C-bare")

    def of(changed):
        path = tmp_path / "changed.toml"
        path.write_text(changed, encoding="utf-8")
        return digest(read_scene(path).model_dump(mode="json", exclude_none=True))

    assert of(text + "\n# a remark\n") == of(text.replace("preload_N = 500.0", "preload_N = 500")) == of(text)
    others = [("preload_N = 500.0", "preload_N = 500.0000000000001"), ("seed = 1", "seed = 2")]
    others += [('method = "esdirk4"', 'method = "rk4"'), ("gravity = true", "gravity = false")]
    for old, new in others:
        assert old in text and of(text.replace(old, new)) != of(text), new
