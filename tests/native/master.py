"""A master that calls the library's functions as C does, and keeps the status of every call."""

import ctypes
import itertools
from ctypes import POINTER, byref, c_char_p, c_double, c_int, c_size_t, c_uint, c_void_p
from pathlib import Path

from .toy import GUID, REFERENCES

OK, WARNING, DISCARD, ERROR = range(4)

LOGGER = ctypes.CFUNCTYPE(None, c_void_p, c_char_p, c_int, c_char_p, c_char_p)


class Callbacks(ctypes.Structure):
    _fields_ = [
        ("logger", LOGGER),
        ("allocate", c_void_p),
        ("free", c_void_p),
        ("finished", c_void_p),
        ("environment", c_void_p),
    ]


_REFERENCES, _COUNT = POINTER(c_uint), c_size_t
SIGNATURES = {
    "SetDebugLogging": (c_int, _COUNT, POINTER(c_char_p)),
    "SetupExperiment": (c_int, c_double, c_double, c_int, c_double),
    "EnterInitializationMode": (),
    "ExitInitializationMode": (),
    "Terminate": (),
    "Reset": (),
    "GetReal": (_REFERENCES, _COUNT, POINTER(c_double)),
    "GetInteger": (_REFERENCES, _COUNT, POINTER(c_int)),
    "GetBoolean": (_REFERENCES, _COUNT, POINTER(c_int)),
    "GetString": (_REFERENCES, _COUNT, POINTER(c_char_p)),
    "SetReal": (_REFERENCES, _COUNT, POINTER(c_double)),
    "SetInteger": (_REFERENCES, _COUNT, POINTER(c_int)),
    "SetBoolean": (_REFERENCES, _COUNT, POINTER(c_int)),
    "SetString": (_REFERENCES, _COUNT, POINTER(c_char_p)),
    "GetFMUstate": (POINTER(c_void_p),),
    "SetFMUstate": (c_void_p,),
    "FreeFMUstate": (POINTER(c_void_p),),
    "SerializedFMUstateSize": (c_void_p, POINTER(c_size_t)),
    "SerializeFMUstate": (c_void_p, c_char_p, c_size_t),
    "DeSerializeFMUstate": (c_char_p, c_size_t, POINTER(c_void_p)),
    "GetDirectionalDerivative": (
        _REFERENCES,
        _COUNT,
        _REFERENCES,
        _COUNT,
        POINTER(c_double),
        POINTER(c_double),
    ),
    "SetRealInputDerivatives": (_REFERENCES, _COUNT, POINTER(c_int), POINTER(c_double)),
    "GetRealOutputDerivatives": (_REFERENCES, _COUNT, POINTER(c_int), POINTER(c_double)),
    "DoStep": (c_double, c_double, c_int),
    "CancelStep": (),
    "GetStatus": (c_int, POINTER(c_int)),
    "GetRealStatus": (c_int, POINTER(c_double)),
    "GetIntegerStatus": (c_int, POINTER(c_int)),
    "GetBooleanStatus": (c_int, POINTER(c_int)),
    "GetStringStatus": (c_int, POINTER(c_char_p)),
}
_TYPES = {"Real": c_double, "Integer": c_int, "Boolean": c_int, "String": c_char_p}


def load(library):
    """The functions of a library, declared."""
    loaded = ctypes.CDLL(str(library))
    loaded.fmi2Instantiate.restype = c_void_p
    loaded.fmi2Instantiate.argtypes = (
        c_char_p,
        c_int,
        c_char_p,
        c_char_p,
        POINTER(Callbacks),
        c_int,
        c_int,
    )
    loaded.fmi2FreeInstance.restype = None
    loaded.fmi2FreeInstance.argtypes = (c_void_p,)
    for name in ("fmi2GetVersion", "fmi2GetTypesPlatform"):
        getattr(loaded, name).restype = c_char_p
    for name, arguments in SIGNATURES.items():
        getattr(loaded, f"fmi2{name}").argtypes = (c_void_p, *arguments)
    return loaded


def _bytes(text):
    return text.encode() if isinstance(text, str) else text


class Master:
    """One instance; names stand for value references, every call returns its status."""

    numbers = itertools.count()

    def __init__(
        self, functions, location, guid=GUID, kind=1, logging=True, references=REFERENCES, memory=(None, None)
    ):
        self.functions = functions
        self.references = references
        self.log = []  # (status, category, message)
        self._logger = LOGGER(
            lambda _environment, _name, status, category, message: self.log.append(
                (status, (category or b"").decode(), message.decode())
            )
        )
        self.callbacks = Callbacks(self._logger, *memory, None, None)
        where = Path(location).as_uri() if isinstance(location, Path) else location
        self.instance = functions.fmi2Instantiate(
            f"toy{next(self.numbers)}".encode(),
            kind,
            _bytes(guid),
            _bytes(where),
            byref(self.callbacks),
            0,
            int(logging),
        )

    @property
    def messages(self):
        return "\n".join(message for _, _, message in self.log)

    def call(self, name, *arguments):
        return getattr(self.functions, f"fmi2{name}")(self.instance, *arguments)

    def free(self):
        self.functions.fmi2FreeInstance(self.instance)
        self.instance = None

    def _references(self, names):
        numbers = [self.references.get(name, name) for name in names]
        return (c_uint * max(1, len(numbers)))(*numbers)

    # --- values -----------------------------------------------------------------------------------
    def set_many(self, kind="Real", **values):
        array = (_TYPES[kind] * len(values))(*values.values())
        return self.call(f"Set{kind}", self._references(values), len(values), array)

    def set(self, name, value, kind="Real"):
        return self.set_many(kind, **{name: value}) if isinstance(name, str) else self._set(name, value, kind)

    def _set(self, reference, value, kind):
        return self.call(f"Set{kind}", (c_uint * 1)(reference), 1, (_TYPES[kind] * 1)(value))

    def read(self, *names, kind="Real"):
        """Status and values."""
        array = (_TYPES[kind] * max(1, len(names)))()
        status = self.call(f"Get{kind}", self._references(names), len(names), array)
        return status, list(array)[: len(names)]

    def get(self, name, kind="Real"):
        status, values = self.read(name, kind=kind)
        assert status == OK, self.messages
        return values[0]

    def everything(self):
        """Every Real and Integer."""
        names = (
            "angle",
            "load_held",
            "margin",
            "speed_reached",
            "sizes",
            "speed",
            "load",
            "tolerance",
            "gain",
        )
        whole = self.read("steps", "mark", kind="Integer")[1]
        return self.read(*names)[1] + whole

    def rate(self, name, value, order=1):
        return self.call(
            "SetRealInputDerivatives",
            self._references([name]),
            1,
            (c_int * 1)(order),
            (c_double * 1)(value),
        )

    def slope(self, name, order=1):
        """Status and rate of an output."""
        value = (c_double * 1)(-1.0)
        status = self.call("GetRealOutputDerivatives", self._references([name]), 1, (c_int * 1)(order), value)
        return status, value[0]

    # --- phases -----------------------------------------------------------------------------------
    def setup(self, time=0.0, tolerance=None):
        has = tolerance is not None
        return self.call("SetupExperiment", int(has), tolerance if has else 0.0, time, 0, 0.0)

    def enter(self):
        return self.call("EnterInitializationMode")

    def exit(self):
        return self.call("ExitInitializationMode")

    def start(self, time=0.0, tolerance=None, **inputs):
        assert self.setup(time, tolerance) == OK
        assert self.enter() == OK
        assert all(self.set(name, value) == OK for name, value in inputs.items())
        assert self.exit() == OK, self.messages
        return self

    def step(self, time, size=0.1):
        return self.call("DoStep", time, size, 1)

    def run(self, count, time=0.0, size=0.1):
        taken = []
        for i in range(count):
            assert self.step(time + i * size, size) == OK, self.messages
            taken.append(self.everything())
        return taken

    def last_time(self):
        """Status and last successful time."""
        value = c_double(-1.0)
        return self.call("GetRealStatus", 2, byref(value)), value.value

    # --- state ------------------------------------------------------------------------------------
    def keep(self):
        state = c_void_p()
        assert self.call("GetFMUstate", byref(state)) == OK
        return state

    def put_back(self, state):
        return self.call("SetFMUstate", state)

    def release(self, state):
        return self.call("FreeFMUstate", byref(state))

    def to_bytes(self, state):
        size = c_size_t()
        assert self.call("SerializedFMUstateSize", state, byref(size)) == OK
        data = ctypes.create_string_buffer(size.value)
        assert self.call("SerializeFMUstate", state, data, size.value) == OK
        return data.raw

    def from_bytes(self, data):
        """Status and state."""
        state = c_void_p()
        return self.call("DeSerializeFMUstate", data, len(data), byref(state)), state
