"""What is compiled: entries with C's calling convention, in units that are compiled side by side.

An entry takes pointers to doubles, then a pointer to the lengths of its arrays (int64), then doubles, and
returns a status (int32). Units ``init`` and ``step`` make up an FMU; there are two more with the same entries
for single bearings alone, for who needs no more (`SINGLE`). ``study`` and ``sound`` serve Python: oracles and
recordings the one, boundary elements the other. ``rest``, which oracles call, lies in ``init``: there its
kernels are compiled anyway.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from fmu_bearing.compiled import single

__all__ = ["ENTRIES", "ONCE", "SINGLE", "UNITS", "Entry", "functions", "object_name", "symbol"]


@dataclass(frozen=True)
class Entry:
    """An entry of the compiled library.

    Attributes
    ----------
    unit : str
    arrays : str
        Its arrays by one letter each, in order.
    scalars : int
        Number of doubles behind the lengths.
    lengths : tuple of int
        Place of each array's length among the lengths passed; the entries of an FMU share the lengths of
        p, u, s, z, w.
    """

    unit: str
    arrays: str
    scalars: int = 0
    lengths: tuple[int, ...] = ()

    def places(self) -> tuple[int, ...]:
        """Place of each array's length."""
        return self.lengths or tuple(range(len(self.arrays)))


ENTRIES = {
    "init": Entry("init", "puszw", 1),
    "rest": Entry("init", "psw", 1, (0, 2, 4)),
    "step": Entry("step", "puszw", 1),
    "outputs": Entry("step", "psz", 0, (0, 2, 3)),
    "copy": Entry("step", "pss", 0, (0, 2, 2)),
    "derivative": Entry("step", "puszw", 1),
    "right_hand_side": Entry("study", "pcywf", 3),
    "repeat": Entry("study", "pcywf", 3),
    "jacobian": Entry("study", "pcywb", 3),
    "runge_kutta": Entry("study", "pcywk", 4),
    "first_order": Entry("study", "pcxwfyd", 3),
    "first_order_jacobian": Entry("study", "pcxwbyd", 3),
    "forces_at_displacement": Entry("study", "pucdgqw"),
    "solve_at_state": Entry("study", "psw", 1),
    "play": Entry("study", "pswmzr", 7),
    "closed_part": Entry("sound", "xoenfgcwr", 1),
    "remainder": Entry("sound", "xoengbdtwr", 1),
}
#: Entries that a simulation calls once: LLVM optimises them at its lowest level, without vectors of loops.
#: They run as long as with the highest (2.2 ms for a bearing, 11.4 ms for a pair).
ONCE = ("init",)
#: Units, the longest to compile first.
UNITS = ("step", "init", "study", "sound")
#: Units that serve every scene, and the ones beside them for single bearings alone: half the work to compile.
SINGLE = {"step": "single_step", "init": "single_init"}


def symbol(entry: str, instruction_set: str = "") -> str:
    """Name of an entry in object files and in the shim."""
    return f"fb_{entry}_{instruction_set}" if instruction_set else f"fb_{entry}"


def object_name(unit: str, platform: str, instruction_set: str) -> str:
    """Name of a unit's object file for an instruction set of a platform, in the cache and in a wheel."""
    return f"{unit}-{platform}-{instruction_set}.o"


def functions(unit: str) -> dict[str, Callable[..., Any]]:
    """Return the entries of a unit as functions that Numba can compile for pointers.

    For a unit of `SINGLE` kernels are loaded in another way, so a process makes units of one kind.
    """
    whole = {one: unit for unit, one in SINGLE.items()}
    if unit in whole:
        single.install()
    return {"init": _init, "step": _step, "study": _study, "sound": _sound}[whole.get(unit, unit)]()


def _init() -> dict[str, Callable[..., Any]]:
    from numba import carray

    from fmu_bearing.engine import abi
    from fmu_bearing.engine.spindle.rest import balance, begin_rest

    def rest(p, s, w, n, speed):
        of_bearing, state, work = carray(p, (n[0],)), carray(s, (n[2],)), carray(w, (n[4],))
        begin_rest(of_bearing, state, work, speed)
        return balance(of_bearing, state, work, speed, 0.0)

    return {"init": _of_bearing(abi.init), "rest": rest}


def _step() -> dict[str, Callable[..., Any]]:
    from numba import carray

    from fmu_bearing.engine import abi

    outputs_kernel = abi.outputs

    def outputs(p, s, z, n):
        return outputs_kernel(carray(p, (n[0],)), carray(s, (n[2],)), carray(z, (n[3],)))

    copy_kernel = abi.copy

    def copy(p, s, kept, n):
        return copy_kernel(carray(p, (n[0],)), carray(s, (n[2],)), carray(kept, (n[2],)))

    made = {"step": abi.step, "derivative": abi.derivative}
    return {"outputs": outputs, "copy": copy} | {name: _of_bearing(kernel) for name, kernel in made.items()}


def _of_bearing(kernel: Callable[..., Any]) -> Callable[..., Any]:
    """Return the entry of a kernel of all arrays of a bearing and one number."""
    from numba import carray

    def entry(p, u, s, z, w, n, number):
        return kernel(
            carray(p, (n[0],)), carray(u, (n[1],)), carray(s, (n[2],)), carray(z, (n[3],)),
            carray(w, (n[4],)), number,
        )  # fmt: skip

    return entry


def _of_motion(kernel: Callable[..., Any]) -> Callable[..., Any]:
    """Return the entry of a kernel that fills its last array from a position and velocity at one time."""
    from numba import carray

    def entry(p, c, y, w, out, n, angle, speed, rate):
        kernel(
            carray(p, (n[0],)), carray(c, (n[1],)), carray(y, (n[2],)), angle, speed, rate,
            carray(w, (n[3],)), carray(out, (n[4],)),
        )  # fmt: skip
        return 0

    return entry


def _study() -> dict[str, Callable[..., Any]]:
    from numba import carray

    from fmu_bearing.engine.fidelities.full import march as full
    from fmu_bearing.engine.layout import U, W
    from fmu_bearing.engine.mechanics import conditions as oil, equations
    from fmu_bearing.engine.newton import jacobian as newton
    from fmu_bearing.engine.reference import first_order as rates, playback, runge_kutta as explicit
    from fmu_bearing.engine.statics import quasistatic as statics

    rhs = equations.right_hand_side
    rk4, rows = explicit.runge_kutta, explicit.ROWS
    sound, at_displacement, conditions = playback.play, statics.forces_at_displacement, oil.conditions
    speed, tilts, newton_of_set = U.SPEED, W.TILT, full.solve_at_state
    first, first_jacobian = rates.first_order, rates.first_order_jacobian

    def repeat(p, c, y, w, f, n, angle, speed, times):
        for k in range(int(times)):
            rhs(
                carray(p, (n[0],)), carray(c, (n[1],)), carray(y, (n[2],)), angle + 1e-9 * k, speed, 0.0,
                carray(w, (n[3],)), carray(f, (n[4],)),
            )  # fmt: skip
        return 0

    def runge_kutta(p, c, y, w, k, n, angle, speed, h, steps):
        rk4(
            carray(p, (n[0],)), carray(c, (n[1],)), carray(y, (n[2],)), angle, speed, h, int(steps),
            carray(w, (n[3],)), carray(k, (rows, n[4] // rows)),
        )  # fmt: skip
        return 0

    def first_order(p, c, x, w, f, y, d, n, angle, speed, t):
        first(
            carray(p, (n[0],)), carray(c, (n[1],)), angle, speed, t, carray(x, (n[2],)),
            carray(w, (n[3],)), carray(f, (n[4],)), carray(y, (n[5],)), carray(d, (n[6],)),
        )  # fmt: skip
        return 0

    def first_order_jacobian(p, c, x, w, b, y, d, n, angle, speed, t):
        first_jacobian(
            carray(p, (n[0],)), carray(c, (n[1],)), angle, speed, t, carray(x, (n[2],)),
            carray(w, (n[3],)), carray(b, (n[4],)), carray(y, (n[5],)), carray(d, (n[2], n[2])),
        )  # fmt: skip
        return 0

    def forces_at_displacement(p, u, c, d, g, q, w, n):
        of_bearing, inputs, held_values = carray(p, (n[0],)), carray(u, (n[1],)), carray(c, (n[2],))
        conditions(of_bearing, inputs, inputs[speed], held_values)
        work = carray(w, (n[6],))
        upright = work[tilts : tilts + 2]
        upright[0] = upright[1] = 0.0
        return at_displacement(
            of_bearing, held_values, inputs[speed], carray(d, (n[3],)), upright, 0.0, carray(g, (n[4],)),
            carray(q, (n[5],)), work,
        )  # fmt: skip

    def solve_at_state(p, s, w, n, gh):
        return newton_of_set(carray(p, (n[0],)), carray(s, (n[1],)), carray(w, (n[2],)), gh)

    def play(p, s, w, m, z, r, n, samples, columns, weighting, start, mics, numbers, first):
        sound(
            carray(p, (n[0],)), carray(s, (n[1],)), carray(w, (n[2],)),
            carray(m, (n[3] // int(columns), int(columns))), carray(z, (n[4],)),
            carray(r, (n[5] // max(int(mics), 1), int(mics))), int(samples), weighting, start, int(mics),
            int(numbers), int(first),
        )  # fmt: skip
        return 0

    return {
        "right_hand_side": _of_motion(rhs),
        "repeat": repeat,
        "jacobian": _of_motion(newton.jacobian),
        "runge_kutta": runge_kutta,
        "first_order": first_order,
        "first_order_jacobian": first_order_jacobian,
        "forces_at_displacement": forces_at_displacement,
        "solve_at_state": solve_at_state,
        "play": play,
    }


def _sound() -> dict[str, Callable[..., Any]]:
    from numba import carray

    from fmu_bearing.engine.boundary_elements import closed_part as closed, remainder as rest

    at_all_frequencies, at_one = closed.closed_part, rest.remainder

    def closed_part(x, o, e, n, f, g, c, w, r, of, orders):
        at_all_frequencies(
            carray(x, (of[0],)), carray(o, (of[1],)), carray(e, (of[2],)), carray(n, (of[3],)),
            carray(f, (of[4],)), carray(g, (of[5],)), carray(c, (of[6],)), carray(w, (of[7],)),
            carray(r, (of[8],)), int(orders),
        )  # fmt: skip
        return 0

    def remainder(x, o, e, n, g, b, d, t, w, r, of, k):
        at_one(
            carray(x, (of[0],)), carray(o, (of[1],)), carray(e, (of[2],)), carray(n, (of[3],)),
            carray(g, (of[4],)), carray(b, (of[5],)), carray(d, (of[6],)), carray(t, (of[7],)),
            carray(w, (of[8],)), carray(r, (of[9],)), k,
        )  # fmt: skip
        return 0

    return {"closed_part": closed_part, "remainder": remainder}
