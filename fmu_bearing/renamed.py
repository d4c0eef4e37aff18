"""Names that changed before the first release, and values that were removed: refused with the new ones."""

import functools
from collections.abc import Callable
from typing import Any, TypeVar

Function = TypeVar("Function", bound=Callable[..., Any])

#: Public names of the package.
PUBLIC = {
    "ShaftStatics": "Statics",
    "operating_points": "operating_point",
    "set_stiffness": "stiffness",
    "shaft_statics": "statics",
}
#: Keys of a scene.
KEYS = {"fidelity.level": "fidelity.model", "sound.rung": "sound.radiation_model"}
#: Values of a scene's keys that were removed, each with the one to use instead.
VALUES = {"fidelity.method": {"fast": "esdirk4"}}
#: Options of the command line.
OPTIONS = {
    "--level": "--fidelity",
    "--rung": "--radiation-model",
    "--picture": "--plot",
    "--chart": "--plot",
    "--csv": "--output",
}
#: Variables of a bearing.
VARIABLES = {
    "level": "fidelity",
    **{
        f"friction_torque.{name}": f"friction_torque_share.{name}"
        for name in ("contacts", "rolling", "cage", "drag")
    },
}
#: Short names of a sweep's axes.
AXES = {"level": "fidelity"}
#: Arguments of public functions.
ARGUMENTS = {"level": "fidelity", "rung": "radiation_model"}


def arguments(function: Function) -> Function:
    """Decorate a public function: an old argument is refused with a ``TypeError`` that names the new one."""

    @functools.wraps(function)
    def checked(*given: Any, **named: Any) -> Any:
        for old in ARGUMENTS.keys() & named.keys():
            raise TypeError(f"{function.__name__}() has no argument '{old}': it is now '{ARGUMENTS[old]}'")
        return function(*given, **named)

    return checked  # type: ignore[return-value]
