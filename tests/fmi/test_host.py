"""Hosts that end: in C without Python, in C with a Python library for the Python build, and in Python."""

import importlib.util
import os
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

import fmpy
import pytest

from tests.fence import fence

# How hosts end: some thirty processes.
pytestmark = pytest.mark.heavy

HOST = r"""
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include "fmi2Functions.h"

static void logger(fmi2ComponentEnvironment e, fmi2String n, fmi2Status s, fmi2String c, fmi2String m, ...) {
    printf("%d %s\n", s, m);
}

static int live(int argc, char **argv) {
    fmi2CallbackFunctions callbacks = {logger, calloc, free, NULL, NULL};
    void *library = dlopen(argv[1], RTLD_NOW);
    fmi2Component c;
    if (!library) { puts(dlerror()); return 2; }
    c = ((fmi2InstantiateTYPE *) dlsym(library, "fmi2Instantiate"))(
        "bearing", fmi2CoSimulation, argv[3], argv[2], &callbacks, 0, 1);
    if (!c) return 3;
    ((fmi2SetupExperimentTYPE *) dlsym(library, "fmi2SetupExperiment"))(c, 0, 0.0, 0.0, 0, 0.0);
    ((fmi2EnterInitializationModeTYPE *) dlsym(library, "fmi2EnterInitializationMode"))(c);
    ((fmi2ExitInitializationModeTYPE *) dlsym(library, "fmi2ExitInitializationMode"))(c);
    if (((fmi2DoStepTYPE *) dlsym(library, "fmi2DoStep"))(c, 0.0, 1e-5, 1)) return 4;
    if (argc > 4) ((fmi2FreeInstanceTYPE *) dlsym(library, "fmi2FreeInstance"))(c);
    if (argc > 5) dlclose(library);
    return 0;
}

int main(int argc, char **argv) {
    int status = live(argc, argv);
    return status || argc < 9 ? status : live(4, argv + 5); /* another FMU, left as it is */
}
"""

PYTHON_LIBRARY = Path(sysconfig.get_config_var("LIBDIR") or "", sysconfig.get_config_var("LDLIBRARY") or "")


@pytest.fixture(scope="module")
def program(tmp_path_factory):
    compiler = shutil.which("cc")
    if not sys.platform.startswith("linux") or compiler is None:
        pytest.skip("needs linux and a C compiler")
    folder = tmp_path_factory.mktemp("host")
    source, program = folder / "host.c", folder / "host"
    source.write_text(HOST)
    headers = Path(importlib.util.find_spec("fmpy").origin).parent / "c-code"
    subprocess.run(
        [compiler, f"-I{headers}", str(source), "-o", str(program), "-ldl"], check=True, timeout=600
    )
    return program


def arguments(folder):
    description = fmpy.read_model_description(str(folder))
    library = folder / "binaries" / "linux64" / f"{description.coSimulation.modelIdentifier}.so"
    return str(library), (folder / "resources").as_uri(), description.guid


def leave(program, folder, *how, **environment):
    command = [str(program), *arguments(folder), *how]
    return subprocess.run(
        command, capture_output=True, text=True, env={**os.environ, **environment}, timeout=600
    )


def leave_with_python(program, folder, tmp_path, root, *how):
    if PYTHON_LIBRARY.suffix != ".so":
        pytest.skip("needs Python as a shared library")
    return leave(
        program,
        folder,
        *how,
        LD_PRELOAD=fence(tmp_path, PYTHON_LIBRARY)["LD_PRELOAD"],
        PYTHONHOME=sys.base_prefix,
        PYTHONPATH=os.pathsep.join([str(root), *filter(None, sys.path)]),
    )


LEAVE = pytest.mark.parametrize("how", [(), ("free",), ("free", "close")], ids=["leave", "free", "close"])


@LEAVE
def test_host_without_python(program, unpacked, expected, how):
    ran = leave(program, unpacked, *how)
    assert ran.returncode == expected["host without Python"], ran.stdout + ran.stderr
    assert ("undefined symbol: _Py" in ran.stdout) == (ran.returncode == 2)


@LEAVE
def test_host_with_python_leaves_in_peace(program, unpack, how, tmp_path, pytestconfig):
    ran = leave_with_python(program, unpack("python"), tmp_path, pytestconfig.rootpath, *how)
    assert ran.returncode == 0, ran.stdout + ran.stderr


def test_host_of_two_leaves_in_peace(program, unpack, tmp_path, pytestconfig):
    folder = unpack("python")
    second = shutil.copytree(folder, tmp_path / "second")
    how = ("free", "close", *arguments(second))
    ran = leave_with_python(program, folder, tmp_path, pytestconfig.rootpath, *how)
    assert ran.returncode == 0, ran.stdout + ran.stderr


@pytest.mark.parametrize("unload", [True, False])
def test_python_host_leaves_in_peace(unpack, unload, tmp_path, pytestconfig):
    # pythonfmu 0.7.0 releases its state twice at exit, the second time after the memory was given back
    script = """if True:
        import fmpy, sys
        description = fmpy.read_model_description(sys.argv[1])
        slave = fmpy.instantiate_fmu(sys.argv[1], description)
        if len(sys.argv) > 2:
            slave.freeInstance()
    """
    command = [sys.executable, "-c", script, str(unpack("python")), *["unload"] * unload]
    environment = fence(tmp_path) | {"PYTHONPATH": str(pytestconfig.rootpath)}
    ran = subprocess.run(command, capture_output=True, text=True, env=environment, timeout=600)
    assert ran.returncode == 0, ran.stdout + ran.stderr
