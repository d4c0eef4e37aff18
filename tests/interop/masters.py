"""What each master reads of an FMU: rows of named outputs at the start and after every step.

libcosim has no row at the start. All bits arrive but those of ``ecos``, which writes six decimals.
"""

import re
import subprocess

import fmpy
import numpy as np

from .conftest import CSV_ERROR, EXACT_STEP, STEPS, read_csv


def in_fmpy(fmu, names, steps=STEPS):
    found = fmpy.simulate_fmu(
        str(fmu), validate=True, stop_time=steps * EXACT_STEP, output_interval=EXACT_STEP, output=names
    )
    assert found["time"].tolist() == [k * EXACT_STEP for k in range(steps + 1)]
    return np.transpose([found[name] for name in names])


def in_ecospy(fmu, names, steps=STEPS):
    from run import load_ecos

    ecospy = load_ecos()
    with ecospy.EcosSimulationStructure() as structure:
        structure.add_model("bearing", str(fmu))
        with ecospy.EcosSimulation(structure=structure, step_size=EXACT_STEP) as run:
            assert run.init()
            rows = []
            for k in range(steps + 1):
                assert run.get_time() == k * EXACT_STEP
                rows.append([run.get_real(f"bearing::{name}") for name in names])
                run.step()
            run.terminate()
    return np.array(rows)


def in_libcosim(fmu, names, steps=STEPS):
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
    from libcosimpy.CosimObserver import CosimObserver
    from libcosimpy.CosimSlave import CosimLocalSlave

    log_output_level(CosimLogLevel.ERROR)
    run = CosimExecution.from_step_size(EXACT_STEP * 1e9)
    slave = run.add_local_slave(CosimLocalSlave(str(fmu), "bearing"))
    observer = CosimObserver.create_last_value()
    run.add_observer(observer)
    known = {variable.name.decode(): variable.reference for variable in run.slave_variables(slave)}
    references = [known[name] for name in names]
    rows = []
    for _ in range(steps):
        assert run.step()
        rows.append(observer.last_real_values(slave, references))
    return np.array(rows)


def in_c(host, unpacked, names, environment, steps=STEPS):
    """Rows, and what the loader of glibc said: ``environment`` asks for it."""
    description = fmpy.read_model_description(str(unpacked))
    references = {v.name: v.valueReference for v in description.modelVariables}
    library = next(unpacked.glob("binaries/*linux*/*.so"))
    get = "get:" + ",".join(str(references[name]) for name in names)
    commands = ["start:0", get, *[f"step:{EXACT_STEP!r}", get] * steps, "terminate"]
    ran = subprocess.run(
        [str(host), str(library), description.guid, (unpacked / "resources").as_uri(), *commands],
        env=environment,
        capture_output=True,
        text=True,
        timeout=600,
    )
    assert ran.returncode == 0, ran.stdout + ran.stderr[-2000:]
    lines = [line for line in ran.stdout.splitlines() if not line.startswith("log")]
    rows = [[float(word) for word in line.split()] for line in lines]
    return np.array(rows), set(re.findall(r"calling init: (.+)$", ran.stderr, flags=re.MULTILINE))


def in_ecos(ecos, fmu, names, folder, steps=STEPS):
    ran = ecos(
        "simulate", "--path", fmu, "--stepSize", EXACT_STEP, "--stopTime", steps * EXACT_STEP, cwd=folder
    )
    assert ran.returncode == 0, ran.stdout + ran.stderr
    assert "[error]" not in ran.stdout + ran.stderr
    found = read_csv(folder / f"{fmu.stem}.csv")
    assert np.allclose(found["time"], np.arange(steps + 1) * EXACT_STEP, rtol=0.0, atol=CSV_ERROR)
    return np.transpose([found[name] for name in names])
