"""Classical Runge-Kutta method; the first stage of the next step gives a third-order companion."""

from fmu_bearing.engine.fidelities.full.methods.tableau import tableau

RK4 = tableau(
    gamma=0.0,
    order=4,
    rows=[[], [0.5], [0.0, 0.5], [0.0, 0.0, 1.0], [1 / 6, 1 / 3, 1 / 3, 1 / 6]],
    low=[1 / 6, 1 / 3, 1 / 3, 0.0, 1 / 6],
)
