"""`Bearing`: a bearing to step by hand, for scripts and notebooks."""

from collections.abc import Iterator, Mapping
from typing import Any, Self

from fmu_bearing.instance import Instance
from fmu_bearing.interface.names import chosen_names, known
from fmu_bearing.prepare.model import Model
from fmu_bearing.results.levels import shown
from fmu_bearing.results.result import Run
from fmu_bearing.results.table import html_table
from fmu_bearing.results.variable_names import by_name
from fmu_bearing.run.simulate import model_of, simulate
from fmu_bearing.scene import Scene, SceneSource


class Bearing(Mapping[str, float]):
    """A bearing that is initialised and stepped by hand; its variables are read like a dictionary's.

    Parameters
    ----------
    source : Scene, Model or path
        Scene file (TOML) or scene in memory; fidelity ``auto`` is resolved. `SceneError` where it is refused.
    **fidelity
        Other values for keys of ``[fidelity]``, such as ``tolerance=1e-4``; ``fidelity="rings"`` is short for
        its ``model``.

    Examples
    --------
    >>> from fmu_bearing import Bearing
    >>> bearing = Bearing("examples/scenes/7003C-bare.toml", fidelity="rings")
    >>> bearing.init(shaft_speed=2000.0, preload=300.0)  # rad/s, N
    >>> bearing.step(1e-3)
    >>> round(bearing["contact.inner.load_mean"])  # N
    70
    """

    def __init__(self, source: SceneSource | Model, **fidelity: Any) -> None:
        keys = {"model" if key == "fidelity" else key: value for key, value in fidelity.items()}
        self._instance = Instance(model_of(source, **keys))

    @property
    def scene(self) -> Scene:
        """The scene of this bearing."""
        return self._instance.model.scene

    @property
    def time(self) -> float:
        """Time reached (s)."""
        return self._instance.time

    def set(self, values: Mapping[str, float] | None = None, /, **named: float) -> Self:
        """Set inputs (or parameters, before `init`) in SI units; names with dots go into a mapping.

        ``ValueError`` for an unknown name, or a value outside its range.
        """
        for name, value in {**by_name(values), **named}.items():
            known(name, self._instance.names("input", "parameter"), "input or parameter")
            self._instance.set(name, value)
        return self

    def init(self, values: Mapping[str, float] | None = None, /, **named: float) -> None:
        """Put the bearing into its steady state, with inputs as for `set`; a second call starts again.

        Inputs and parameters that were set before stay set. ``ValueError`` as `set`; the subclass
        `EngineError` where there is no equilibrium.
        """
        if self._instance.initialised:
            kept = self._given()
            self._instance.reset()
            self.set(kept)
        self.set(values, **named)
        self._instance.initialise()

    def step(self, h: float, values: Mapping[str, float] | None = None, /, **named: float) -> None:
        """Advance by ``h`` (s) under inputs as for `set`; the speed ramps to its value over the step.

        ``ValueError`` as `set`; its subclass `EngineError` for a refused step: the state is as it was.
        """
        self.set(values, **named)
        self._instance.step(h)

    def read(self, *patterns: str) -> dict[str, float]:
        """Return variables by name, SI units; ``*`` matches any text; default: all outputs."""
        names = chosen_names(patterns or None, self, self._instance.names("output"))
        return {name: self[name] for name in names}

    def simulate(self, stop_time: float, **options: Any) -> Run:
        """Run a fresh copy from this bearing's inputs and parameters; options as for `simulate`."""
        start = self._given() | dict(options.pop("start_values", None) or {})
        return simulate(self._instance.model, stop_time, start_values=start, **options)

    def _given(self) -> dict[str, float]:
        return {name: self._instance.get(name) for name in self._instance.names("input", "parameter")}

    def __getitem__(self, name: str) -> float:
        return self._instance.get(known(name, list(self), "variable"))

    def __iter__(self) -> Iterator[str]:
        return iter(self._instance.by_name)

    def __len__(self) -> int:
        return len(self._instance.by_name)

    def __repr__(self) -> str:
        return f"Bearing({self.scene.name}, fidelity {self.scene.fidelity.model}, t = {self.time:g} s)"

    def _repr_html_(self) -> str:
        units = self._instance.by_name
        rows = [
            [name, shown(value, units[name].unit), units[name].unit] for name, value in self.read().items()
        ]
        return html_table(repr(self), ["output", "value", "unit"], rows)
