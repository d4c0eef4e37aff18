"""The command as a person calls it, and a small scene for it."""

import json

import pytest
from typer.testing import CliRunner

from fmu_bearing import cli
from fmu_bearing.scene.read import with_fidelity
from tests.design.test_fits import SHAFT, bearing


@pytest.fixture(scope="session")
def run():
    """Call the command; the result has exit_code, stdout, stderr and, with --json, ``data``."""

    def call(*arguments):
        result = CliRunner().invoke(cli.app, [str(argument) for argument in arguments])
        assert "Traceback" not in result.output
        if result.exception is not None and not isinstance(result.exception, SystemExit):
            raise result.exception
        result.data = json.loads(result.stdout) if "--json" in arguments and result.stdout else None
        return result

    return call


@pytest.fixture(scope="session")
def silent_file(scene, tmp_path_factory):
    """The 7003C in its spindle, without sound."""
    path = tmp_path_factory.mktemp("scene") / "silent.toml"
    path.write_text(scene("7003C-spindle").model_copy(update={"sound": None}).to_toml(), "utf-8")
    return path


@pytest.fixture(scope="session")
def rings_file(scene, tmp_path_factory):
    """The bare 7003C at fidelity rings, with compact sound."""
    path = tmp_path_factory.mktemp("scene") / "rings.toml"
    path.write_text(with_fidelity(scene("7003C-bare"), model="rings").to_toml(), "utf-8")
    return path


@pytest.fixture(scope="session")
def fitted_file(tmp_path_factory):
    """A steel bearing with fits, without sound."""
    path = tmp_path_factory.mktemp("scene") / "fitted.toml"
    path.write_text(bearing(shaft=SHAFT).model_copy(update={"sound": None}).to_toml(), "utf-8")
    return path
