"""The thermal FMU alone: energy, steady state, and the exact solution of its linear equations."""

import fmpy
import numpy as np
import pytest
from scipy.linalg import expm

HEATS = {"heat.inner_ring": 6.0, "heat.outer_ring": 5.0, "heat.oil": 9.0}
LUMPS = ("inner_ring", "outer_ring", "balls", "oil", "housing")
TEMPERATURES = [f"{lump}_temperature" for lump in LUMPS]
AMBIENT = 295.15


@pytest.fixture(params=["python", "native"])
def fmus(request, partners):
    """Both builds: what follows shares no code with either."""
    if request.param not in partners:
        pytest.skip("no C compiler")
    return partners[request.param]


def simulate(fmus, end, step, **start):
    return fmpy.simulate_fmu(
        str(fmus / "SpindleThermal.fmu"),
        stop_time=end,
        step_size=step,
        output_interval=step,
        start_values={**HEATS, **start},
        output=[*TEMPERATURES, "energy.supplied", "energy.stored", "energy.given_off"],
    )


def network(fmus):
    """Capacities, conductance matrix and heats, from the start values in the FMU's description."""
    description = fmpy.read_model_description(str(fmus / "SpindleThermal.fmu"))
    start = {v.name: float(v.start) for v in description.modelVariables if v.start is not None}
    capacities = np.array([start[f"capacity.{lump}"] for lump in LUMPS])
    matrix = np.zeros((5, 5))
    for name, value in start.items():
        if not name.startswith("conductance."):
            continue
        one, other = next(
            (a, b) for a in LUMPS for b in (*LUMPS, "ambient") if name == f"conductance.{a}_{b}"
        )
        i = LUMPS.index(one)
        matrix[i, i] += value
        if other != "ambient":
            j = LUMPS.index(other)
            matrix[j, j] += value
            matrix[i, j] -= value
            matrix[j, i] -= value
    heats = np.array([HEATS.get(f"heat.{lump}", 0.0) for lump in LUMPS])
    return capacities, matrix, heats


@pytest.mark.parametrize("step", [1e-4, 1e-3, 0.05])
def test_energy_balance(fmus, step):
    last = simulate(fmus, 1.0, step, initial_temperature=310.0)[-1]
    assert last["energy.supplied"] == pytest.approx(sum(HEATS.values()), rel=1e-12)
    # to rounding: the temperatures, some 300 K, carry 2e-16 of their stored energy over 10,000 steps
    lost = last["energy.supplied"] - last["energy.stored"] - last["energy.given_off"]
    assert abs(lost) < 1e-9 * sum(HEATS.values())


def test_stored_energy_is_what_the_temperatures_say(fmus):
    capacities, _, _ = network(fmus)
    last = simulate(fmus, 2.0, 1e-2)[-1]
    rises = np.array([last[name] for name in TEMPERATURES]) - AMBIENT
    assert last["energy.stored"] == pytest.approx(capacities @ rises, rel=1e-9)


def test_steady_state_is_the_solution_of_the_conductances(fmus):
    _, matrix, heats = network(fmus)
    # Capacities do not matter to where it ends; with these the slowest lump settles in about a second, and
    # 40 s leave nothing of the transient.
    small = {f"capacity.{lump}": 0.3 for lump in LUMPS}
    last = simulate(fmus, 40.0, 0.25, **small)[-1]
    rises = np.array([last[name] for name in TEMPERATURES]) - AMBIENT
    assert rises == pytest.approx(np.linalg.solve(matrix, heats), rel=1e-9)


def test_transient_follows_the_exact_solution(fmus):
    capacities, matrix, heats = network(fmus)
    run = simulate(fmus, 1.0, 5e-4)
    steady = np.linalg.solve(matrix, heats)
    for row in run[[200, 1000, 2000]]:
        exact = steady - expm(-matrix / capacities[:, None] * row["time"]) @ steady
        rises = np.array([row[name] for name in TEMPERATURES]) - AMBIENT
        # implicit Euler, first order: the housing, behind the outer ring, rises as t^2 at first and is
        # early by about a step; 0.5 % at 0.1 s, the others less
        assert rises == pytest.approx(exact, rel=1e-2)


def test_nothing_changes_at_ambient_without_heat(fmus):
    none = dict.fromkeys(HEATS, 0.0)
    last = simulate(fmus, 1.0, 1e-2, **none)[-1]
    assert [last[name] for name in TEMPERATURES] == pytest.approx([AMBIENT] * 5, rel=1e-14)


def test_a_heat_that_is_not_finite_is_refused(fmus):
    from coupling import Fmu, SimulationError

    with Fmu(fmus / "SpindleThermal.fmu", "thermal") as thermal:
        thermal.enter_initialization()
        thermal.exit_initialization()
        with pytest.raises(SimulationError, match="discard"):
            thermal.set({"heat.oil": float("nan")})  # the native build refuses the value, pythonfmu the step
            thermal.step(0.0, 1e-3)
        assert thermal.get(["oil_temperature"]) == [AMBIENT]


def test_description_is_valid_with_units(fmus):
    path = str(fmus / "SpindleThermal.fmu")
    assert fmpy.validation.validate_fmu(path) == []
    units = {v.name: v.unit for v in fmpy.read_model_description(path).modelVariables}
    assert units["heat.oil"] == "W" and units["oil_temperature"] == "K"
    assert all(units.values())
