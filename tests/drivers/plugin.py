"""A driver, loaded from Python: the declarations of include/mvs/driver.h in ctypes."""

import ctypes as c
import os
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDER = Path(os.environ.get("MVS_DRIVERS_DIR", ROOT / "build/release/libmvs/mvs/drivers"))

OK, E_LOST = 0, -7
CALIBRATED, VELOCITY, FORCE_ON = 1, 2, 4


class Info(c.Structure):
    _fields_ = [
        *[(name, c.c_uint32) for name in (
            "struct_size", "freedoms_in", "freedoms_out", "buttons", "has_gripper", "has_deadman")],
        ("workspace_min", c.c_double * 3),
        ("workspace_max", c.c_double * 3),
        *[(name, c.c_double) for name in (
            "peak_force", "continuous_force", "peak_torque", "max_stiffness", "max_damping",
            "max_speed", "rate")],
        ("frame", c.c_double * 12),
        ("model", c.c_char * 64),
        ("serial", c.c_char * 64),
        ("firmware", c.c_char * 64),
    ]


class State(c.Structure):
    _fields_ = [
        ("struct_size", c.c_uint32),
        ("flags", c.c_uint32),
        ("time_ns", c.c_uint64),
        ("sequence", c.c_uint64),
        ("position", c.c_double * 3),
        ("orientation", c.c_double * 4),
        ("velocity", c.c_double * 3),
        ("gripper", c.c_double),
        ("buttons", c.c_uint32),
        ("cause", c.c_uint32),
    ]


class Force(c.Structure):
    _fields_ = [
        ("struct_size", c.c_uint32),
        ("on", c.c_uint32),
        ("force", c.c_double * 3),
        ("torque", c.c_double * 3),
        ("gripper", c.c_double),
    ]


OPTION = c.CFUNCTYPE(c.c_void_p, c.c_void_p, c.c_char_p)
LOG = c.CFUNCTYPE(None, c.c_void_p, c.c_char_p)
FOUND = c.CFUNCTYPE(None, c.c_void_p, c.c_char_p, c.c_char_p)


class Host(c.Structure):
    _fields_ = [
        *[(name, c.c_uint32) for name in ("struct_size", "oldest", "newest", "reserved")],
        ("host", c.c_void_p),
        ("option", OPTION),
        ("log", LOG),
    ]


def _function(*arguments, result=c.c_int32):
    return c.CFUNCTYPE(result, *arguments)


class Api(c.Structure):
    _fields_ = [
        ("struct_size", c.c_uint32),
        ("version", c.c_uint32),
        ("name", c.c_char_p),
        ("about", c.c_char_p),
        ("options", c.POINTER(c.c_char_p)),
        ("list", _function(c.POINTER(Host), FOUND, c.c_void_p)),
        ("doctor", c.c_void_p),
        ("open", _function(c.POINTER(Host), c.c_char_p, c.POINTER(c.c_void_p))),
        ("info", _function(c.c_void_p, c.POINTER(Info))),
        ("calibrate", _function(c.c_void_p)),
        ("start", _function(c.c_void_p)),
        ("read", _function(c.c_void_p, c.c_uint64, c.POINTER(State))),
        ("write", _function(c.c_void_p, c.POINTER(Force))),
        ("run", c.c_void_p),
        ("stop", _function(c.c_void_p)),
        ("panic", _function(c.c_void_p, result=None)),
        ("close", _function(c.c_void_p, result=None)),
        ("error", _function(c.c_void_p, result=c.c_char_p)),
    ]


class Plugin:
    """An open driver with the options of an application."""

    def __init__(self, name, **options):
        library = c.CDLL(str(FOLDER / f"{name}.so"), mode=os.RTLD_NOW | os.RTLD_LOCAL)
        kept = {key.encode(): c.create_string_buffer(str(value).encode())
                for key, value in options.items()}
        find = OPTION(lambda _, key: c.addressof(kept[key]) if key in kept else None)
        self.host = Host(c.sizeof(Host), 1, 1, 0, None, find, LOG(lambda *_: None))
        self.kept = kept, find
        self.api = Api(struct_size=c.sizeof(Api))
        assert library.mvs_driver_negotiate(c.byref(self.host), c.byref(self.api)) == OK
        assert self.api.struct_size == c.sizeof(Api)
        self.device = c.c_void_p()

    def __enter__(self):
        result = self.api.open(c.byref(self.host), None, c.byref(self.device))
        assert result == OK, self.error()
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        if self.device:
            self.api.close(self.device)
        self.device = c.c_void_p()

    def error(self):
        return self.api.error(self.device).decode()

    def info(self):
        told = Info(struct_size=c.sizeof(Info))
        assert self.api.info(self.device, c.byref(told)) == OK
        return told

    def read(self, now_ns=0):
        """Returns the code and the state."""
        state = State(struct_size=c.sizeof(State))
        return self.api.read(self.device, now_ns, c.byref(state)), state

    def write(self, x, y, z):
        force = Force(struct_size=c.sizeof(Force), on=1, force=(x, y, z))
        return self.api.write(self.device, c.byref(force))

    def list(self):
        names = []
        self.api.list(c.byref(self.host), FOUND(lambda _, name, __: names.append(name.decode())),
                      None)
        return names
