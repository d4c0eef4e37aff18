"""A careless host: random calls and values, damaged files and states; the driver is ``fuzz/fuzz.c``.

It runs in a process of its own, so that a crash is a failure of the test and not of the tests.
"""

import shutil
import subprocess

import pytest

from fmu_bearing.compiled.platforms import host as own_platform
from fmu_bearing.engine.sources import engine_digest
from fmu_bearing.fmi.native.link import kernels_of
from fmu_bearing.fmi.native.model_file import model_bytes

from . import toy
from .careless import build, hostile_kernels, play

SANITIZED = ("-O1", "-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")
#: Least counts that show a run to have reached every depth, for each round.
DEPTH = {
    "ok": 60,
    "discard": 2,
    "error": 30,
    "logged": 30,
    "steps": 10,
    "discarded_steps": 0.02,
    "refused_models": 4,
    "refused_states": 1,
}
FORGED = {"forged_models": 0.5, "forged_states": 1}


def check_depth(counts, rounds, forge=True):
    for name, least in (DEPTH | FORGED if forge else DEPTH).items():
        assert counts[name] >= least * rounds, (name, counts)


@pytest.mark.heavy
def test_no_call_is_too_careless(compiler, resources, tmp_path):
    program = build(tmp_path, [compiler], hostile_kernels(tmp_path, [compiler]), toy.KERNELS)
    counts = play(program, resources, tmp_path / "bad", seed=1, rounds=60)
    check_depth(counts, 60)
    several = toy.write_model(tmp_path / "several", journal=4, journal_span=0.25)
    check_depth(play(program, several, tmp_path / "bad", seed=2, rounds=60), 60)
    led = toy.write_model(tmp_path / "led", led=range(1, 3))
    check_depth(play(program, led, tmp_path / "bad", seed=3, rounds=60), 60)
    # what happens follows from the seed alone: a failure can be had again
    assert play(program, resources, tmp_path / "bad", seed=1, rounds=60) == counts


@pytest.fixture(scope="session")
def sanitizers(compiler, tmp_path_factory):
    """Options of the sanitisers, where the compiler has them."""
    source = tmp_path_factory.mktemp("sanitizers") / "nothing.c"
    source.write_text("int main(void) { return 0; }\n")
    command = [compiler, *SANITIZED, str(source), "-o", str(source.with_suffix(""))]
    if subprocess.run(command, capture_output=True, timeout=600).returncode != 0:
        pytest.skip("the C compiler has no address and undefined-behaviour sanitisers (Debian: gcc)")
    return SANITIZED


@pytest.mark.heavy
def test_no_call_is_too_careless_under_sanitizers(compiler, sanitizers, resources, tmp_path):
    """Seeds of their own for each model: 1000 rounds are 150,000 calls and 10,000 damaged files."""
    kernels = hostile_kernels(tmp_path, [compiler], *sanitizers)
    program = build(tmp_path, [compiler], kernels, toy.KERNELS, *sanitizers)
    several = toy.write_model(tmp_path / "several", journal=4, journal_span=0.25)
    led = toy.write_model(tmp_path / "led", led=range(1, 3))
    for seed, model in enumerate((resources, several, led), 2):
        check_depth(play(program, model, tmp_path / "bad", seed, rounds=1000, seconds=600), 1000)


@pytest.mark.heavy
def test_real_kernels_bear_a_careless_host(compiler, sanitizers, scene, tmp_path):
    """Damage that keeps its checksum right is left out: kernels trust what the shim has checked."""
    from fmu_bearing.fmi.description import interface_guid
    from fmu_bearing.prepare.model import prepare

    platform = own_platform()
    if platform is None:
        pytest.skip("there are no compiled kernels for this machine")
    model = prepare(scene("7003C-spindle"))
    files = [tmp_path / f"kernels{k}.o" for k in range(len(kernels_of(platform)))]
    for file, data in zip(files, kernels_of(platform), strict=True):
        file.write_bytes(data)
    digest, guid = engine_digest().hex(), interface_guid(model, "native")
    good = tmp_path / "good"
    good.mkdir()
    (good / "model.bin").write_bytes(model_bytes(model, guid, digest))
    program = build(tmp_path, [compiler], files, digest, *sanitizers)
    step, count = 1e-5, len(model.variables)
    options = {"guid": guid, "count": count, "step": step, "forge": False, "seconds": 900}
    counts = play(program, good, tmp_path / "bad", seed=1, rounds=50, **options)
    check_depth(counts, 50, forge=False)


@pytest.mark.heavy
def test_driver_notices_a_library_that_takes_damage(compiler, resources, tmp_path):
    """The driver itself: with checksums believed blindly it has to fail."""
    shim = tmp_path / "shim"
    shutil.copytree(toy.SHIM, shim)
    digest = shim / "digest.c"
    text = digest.read_text()
    believing = text.replace("return memcmp(found, expected, DIGEST_SIZE) == 0;", "return 1;")
    assert believing != text
    digest.write_text(believing)
    program = build(
        tmp_path, [compiler], hostile_kernels(tmp_path, [compiler]), toy.KERNELS, "-Wno-unused", shim=shim
    )
    with pytest.raises(AssertionError, match="took a damaged"):
        play(program, resources, tmp_path / "bad", seed=1, rounds=20)
