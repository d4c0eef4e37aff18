"""Run an .ssp of FMUs with three simulation programs: ``python run.py out/spindle.ssp``.

FMPy, ecos and libcosim are given the same algorithm: all FMUs advance by the same fixed step with the
inputs of the step's beginning, then outputs are passed on (the Jacobi scheme). What differs is how they
count time. FMPy and ecos add steps up, libcosim counts nanoseconds. With a step that is a whole number
of nanoseconds and a power of two in seconds all three counts are exact, and the results are equal to the
last bit. The longest of those, 2^-9 s, is the default here.
"""

import ctypes
from collections.abc import Callable
from importlib import metadata
from pathlib import Path
from types import ModuleType
from typing import Annotated
from unittest import mock

import numpy as np
import typer
from fmpy.ssp import simulation
from fmpy.ssp.ssd import read_ssd
from fmpy.util import write_csv
from numpy.typing import NDArray

EXACT_STEP = 2.0**-9  # s, 1.953125 ms

Table = NDArray[np.void]


def signals(path: Path) -> list[tuple[str, str]]:
    """Component and variable of every connected output of a flat system.

    Inputs are left out: FMPy shows the inputs of the next step, libcosim of the last.
    """
    return [
        (element.name, connector.name)
        for element in read_ssd(str(path)).system.elements
        for connector in element.connectors
        if connector.kind == "output"
    ]


def _table(names: list[tuple[str, str]], rows: list[tuple[float, ...]]) -> Table:
    fields = ["time", *(f"{component}.{variable}" for component, variable in names)]
    return np.array(rows, np.dtype([(name, np.float64) for name in fields]))


def run_fmpy(path: Path, steps: int, step: float) -> Table:
    """Run with FMPy.

    FMPy 0.3.32 sets every input to 0 for the first step, among them temperatures: 0 K, which the bearing
    refuses. Here inputs begin with the values of the connected outputs, and the rest is FMPy's own.
    """
    instantiate = simulation.instantiate_fmu

    def begin(component, *arguments):
        instantiate(component, *arguments)
        for connector in component.connectors:
            connector.value = simulation.get_value(component, connector.name)
        # once for each component: with the last one every output has its value
        for output, given in simulation.get_connections(component.parent):
            given.value = output.value

    # Half a step less, for FMPy goes on while its sum of steps is below the stop time.
    with mock.patch.object(simulation, "instantiate_fmu", begin):
        found = simulation.simulate_ssp(str(path), stop_time=(steps - 0.5) * step, step_size=step)
    names = signals(path)
    # FMPy writes the time of the step's beginning beside the values of its end.
    rows = [(row["time"] + step, *(row[f"{c}.{v}"] for c, v in names)) for row in found]
    return _table(names, rows)


def load_ecos() -> ModuleType:
    """Import ecospy, whose library needs TBB's, which pip puts where no loader looks."""
    for file in metadata.files("tbb") or ():
        if file.name == "libtbb.so.12":
            ctypes.CDLL(str(file.locate()), ctypes.RTLD_GLOBAL)
    import ecospy

    return ecospy


def run_ecos(path: Path, steps: int, step: float, parameter_set: str | None = None) -> Table:
    """Run with ecos through ecospy; a set of parameters applies only when it is named."""
    ecospy = load_ecos()
    ecospy.EcosLib.set_log_level("warn")
    names = signals(path)
    rows = []
    with ecospy.EcosSimulation(ssp_path=str(path), step_size=step) as run:
        if not run.init(parameter_set=parameter_set):
            raise RuntimeError(f"ecos cannot initialise {path}: {ecospy.EcosLib.get_last_error()}")
        for _ in range(steps):
            run.step()
            rows.append((run.get_time(), *(run.get_real(f"{c}::{v}") for c, v in names)))
        run.terminate()
    return _table(names, rows)


def run_libcosim(path: Path, steps: int, step: float) -> Table:
    """Run with libcosim through libcosimpy; the step is rounded to nanoseconds."""
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
    from libcosimpy.CosimObserver import CosimObserver

    log_output_level(CosimLogLevel.WARNING)
    run = CosimExecution.from_ssp_file(str(path), round(step * 1e9))
    observer = CosimObserver.create_last_value()
    run.add_observer(observer)
    names = signals(path)
    slaves = {component: run.slave_index_from_instance_name(component) for component, _ in names}
    references = {
        (component, variable.name.decode()): variable.reference
        for component, slave in slaves.items()
        for variable in run.slave_variables(slave)
    }
    rows = []
    for _ in range(steps):
        if not run.step():
            raise RuntimeError(f"libcosim stops {path} at {run.status().current_time * 1e-9:g} s")
        values = (observer.last_real_values(slaves[c], [references[c, v]])[0] for c, v in names)
        rows.append((run.status().current_time / 1e9, *values))
    return _table(names, rows)


ENGINES: dict[str, Callable[[Path, int, float], Table]] = {
    "fmpy": run_fmpy,
    "ecos": run_ecos,
    "libcosim": run_libcosim,
}


def largest_difference(one: Table, other: Table) -> float:
    """Largest difference of any signal, relative to that signal's largest value."""
    assert one.dtype.names is not None
    return max(
        float(np.abs(one[name] - other[name]).max() / max(np.abs(one[name]).max(), 1e-300))
        for name in one.dtype.names
    )


def main(
    path: Annotated[Path, typer.Argument(help="Archive, such as write.py makes.")] = Path("out/spindle.ssp"),
    output_dir: Annotated[Path, typer.Option(help="Folder for the tables.")] = Path("out"),
    steps: Annotated[int, typer.Option(min=1, help="How many communication steps.")] = 50,
    step: Annotated[float, typer.Option(min=1e-5, max=1e-2, help="Communication step in s.")] = EXACT_STEP,
) -> None:
    """Run one archive with FMPy, ecos and libcosim, and say how far the results differ."""
    if not path.is_file():
        typer.echo(f"error: no file {path}; write.py makes it", err=True)
        raise typer.Exit(2)
    first = None
    for name, engine in ENGINES.items():
        table = engine(path, steps, step)
        file = output_dir / f"{path.stem}_{name}.csv"
        output_dir.mkdir(parents=True, exist_ok=True)
        write_csv(file, table)
        first = table if first is None else first
        typer.echo(f"{name:9} {file}: largest difference to FMPy {largest_difference(first, table):.2g}")


if __name__ == "__main__":
    typer.run(main)
