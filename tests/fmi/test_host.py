"""A host written in C with a Python library loaded: it must leave with exit code 0."""

import importlib.util
import os
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

import pytest

HOST = r"""
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include "fmi2Functions.h"

static void logger(fmi2ComponentEnvironment e, fmi2String n, fmi2Status s, fmi2String c, fmi2String m, ...) {
    printf("%d %s\n", s, m);
}

int main(int argc, char **argv) {
    fmi2CallbackFunctions callbacks = {logger, calloc, free, NULL, NULL};
    void *library = dlopen(argv[1], RTLD_NOW);
    fmi2Component c;
    if (!library) { puts(dlerror()); return 2; }
    c = ((fmi2InstantiateTYPE *) dlsym(library, "fmi2Instantiate"))(
        "bearing", fmi2CoSimulation, "", argv[2], &callbacks, 0, 1);
    if (!c) return 3;
    ((fmi2SetupExperimentTYPE *) dlsym(library, "fmi2SetupExperiment"))(c, 0, 0.0, 0.0, 0, 0.0);
    ((fmi2EnterInitializationModeTYPE *) dlsym(library, "fmi2EnterInitializationMode"))(c);
    ((fmi2ExitInitializationModeTYPE *) dlsym(library, "fmi2ExitInitializationMode"))(c);
    if (((fmi2DoStepTYPE *) dlsym(library, "fmi2DoStep"))(c, 0.0, 1e-5, 1)) return 4;
    if (argc > 3) ((fmi2FreeInstanceTYPE *) dlsym(library, "fmi2FreeInstance"))(c);
    if (argc > 4) dlclose(library);
    return 0;
}
"""

PYTHON_LIBRARY = Path(sysconfig.get_config_var("LIBDIR") or "", sysconfig.get_config_var("LDLIBRARY") or "")


@pytest.fixture(scope="module")
def host(tmp_path_factory):
    compiler = shutil.which("cc")
    if not sys.platform.startswith("linux") or compiler is None or PYTHON_LIBRARY.suffix != ".so":
        pytest.skip("needs linux, a C compiler and Python as a shared library")
    folder = tmp_path_factory.mktemp("host")
    source, program = folder / "host.c", folder / "host"
    source.write_text(HOST)
    headers = Path(importlib.util.find_spec("fmpy").origin).parent / "c-code"
    subprocess.run([compiler, f"-I{headers}", str(source), "-o", str(program), "-ldl"], check=True)
    return program


@pytest.mark.parametrize("leave", [(), ("free",), ("free", "close")], ids=["leave", "free", "close"])
def test_c_host_leaves_in_peace(host, unpacked, leave, pytestconfig):
    library = unpacked / "binaries" / "linux64" / "Bearing7003C.so"
    environment = {
        **os.environ,
        "LD_PRELOAD": str(PYTHON_LIBRARY),
        "PYTHONHOME": sys.base_prefix,
        "PYTHONPATH": os.pathsep.join([str(pytestconfig.rootpath), *filter(None, sys.path)]),
    }
    ran = subprocess.run(
        [str(host), str(library), (unpacked / "resources").as_uri(), *leave],
        capture_output=True,
        text=True,
        env=environment,
    )
    assert ran.returncode == 0, ran.stdout + ran.stderr
