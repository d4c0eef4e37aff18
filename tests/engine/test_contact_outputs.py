"""Outputs of the contacts: what the contacts carry, in every fidelity, with sizes, waves and damping."""

import numpy as np
import pytest

from fmu_bearing.engine.layout import F, P, S
from fmu_bearing.instance import Instance
from fmu_bearing.prepare.model import prepare
from fmu_bearing.run.balls import Reader

FIDELITIES = ("full", "rings", "response")


def _run(scene, fidelity, scale, **flaws):
    flawed = scene.model_copy(update={"imperfections": scene.imperfections.model_copy(update=flaws)})
    run = Instance(prepare(flawed, fidelity=fidelity), tell=lambda _: None)
    run.set("imperfection.scale", scale)
    run.initialise()
    return run


@pytest.mark.parametrize("fidelity", FIDELITIES)
def test_sizes_without_scale_change_nothing(silent, fidelity):
    names = [f"contact.{race}.{what}" for race in ("inner", "outer") for what in ("load_max", "pressure_max")]
    plain, sized = (_run(silent, fidelity, 0.0, ball_diameter_spread_nm=spread) for spread in (0.0, 5000.0))
    for run in (plain, sized):
        run.step(1e-3)
    assert [sized.get(name) for name in names] == [plain.get(name) for name in names]


@pytest.mark.parametrize(
    ("fidelity", "scale", "spread"),
    [
        *((fidelity, *flaws) for fidelity in ("full", "rings") for flaws in ((1, 0), (5, 0), (1, 1000))),
        ("response", 1, 0),  # at scale 5 its lines, linear in the surfaces, are 120 N off
    ],
)
def test_loads_move_the_ring(silent, fidelity, scale, spread):
    """Along the axis the balls' loads are the preload less what the inner ring's acceleration takes."""
    run = _run(silent, fidelity, float(scale), ball_diameter_spread_nm=float(spread))
    reader, rest, loads = Reader(run), [], []
    for _ in range(200):
        run.step(5e-5)
        load = (reader.loads(run)[0] * np.sin(reader.angles(run)[0])).sum()
        taken = run.p[P.INNER_MASS] * run.s[S.F + F.BODY]
        loads.append(load)
        rest.append(run.get("preload") - load - taken)
    # loads vary by 75 to 410 N; friction across the tracks takes 1.3 N. Without surfaces in them loads would
    # leave all of the ring's acceleration over: as much as they vary by.
    assert np.std(loads) > 70.0
    assert np.std(rest) < (0.04 if fidelity == "response" else 0.02) * np.std(loads)
    assert abs(np.mean(rest)) < (4.0 if fidelity == "response" else 2.0)


@pytest.mark.parametrize("flaws", [{}, {"ball_form_nm": 500.0}, {"ball_diameter_spread_nm": 1000.0}])
def test_fidelities_agree(silent, flaws):
    """Largest load, mean and largest over 10 ms: `rings` has the balls of `full` without their inertia."""
    found = []
    for fidelity in ("full", "rings"):
        run = _run(silent, fidelity, 1.0, **flaws)
        values = []
        for _ in range(200):
            run.step(5e-5)
            values.append([run.get(f"contact.{race}.load_max") for race in ("inner", "outer")])
        found.append([np.mean(values, axis=0), np.max(values, axis=0)])
    assert found[1][0] == pytest.approx(found[0][0], rel=0.01)
    assert found[1][1] == pytest.approx(found[0][1], rel=0.03)
