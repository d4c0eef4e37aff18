"""All checks of behaviour, in the order in which they are run."""

import inspect
from collections.abc import Callable, Iterator

from fmu_bearing.validation import abilities, life, refusals
from fmu_bearing.validation.remarks import Remark
from fmu_bearing.validation.subject import Subject

Check = Callable[[Subject], Iterator[Remark]]

CHECKS: tuple[Check, ...] = (
    life.instantiates, life.versions, life.other_guid, life.start_values, life.finite, life.independent,
    life.reset, refusals.values_not_finite, refusals.values_out_of_range, refusals.start_value_out_of_range,
    refusals.steps_of_no_length, refusals.wrong_time, abilities.variable_steps, abilities.input_derivatives,
    abilities.output_derivatives, abilities.directional_derivatives, abilities.states,
    abilities.serialised_states, abilities.reference_results,
)  # fmt: skip

#: An FMU that ends the process in one of these does so in nearly all that follow.
NEEDED = (life.instantiates, life.finite)


def name_of(check: Check) -> str:
    """Return the name of a check in words."""
    return check.__name__.replace("_", " ")


def meaning_of(check: Check) -> str:
    """Return the requirement of a check: the first line of its docstring."""
    return (inspect.getdoc(check) or "").splitlines()[0]
