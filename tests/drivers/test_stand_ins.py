"""Third parties' clients drive our stand-ins for vendors' libraries.

pyOpenHaptics and forcedimension-core were written for the vendors' own libraries: what they find in
a stand-in (names, types, numbers, units) is not our own reading of the interface. Each runs in a
process of its own, since it loads its library when it is imported.
"""

import os
import pathlib
import subprocess
import sys
import textwrap
from importlib import util

import pytest

STAND_INS = pathlib.Path(
    os.environ.get("MVS_STAND_INS_DIR")
    or pathlib.Path(__file__).parents[2] / "build/release/tests/drivers"
)


def run(program, **environment):
    """Returns the program's standard output; the program must end without an error."""
    done = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(program)],
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout.splitlines()


def need(module, library):
    if util.find_spec(module) is None:
        pytest.skip(f"no {module}: pip install -r tests/requirements.txt")
    if not library.exists():
        pytest.skip(f"no {library}: build the target test_drivers, or set MVS_STAND_INS_DIR")


@pytest.fixture
def openhaptics():
    folder = STAND_INS / "openhaptics"
    need("pyOpenHaptics", folder / "libHD.so")
    return {"LD_LIBRARY_PATH": str(folder)}


@pytest.fixture
def sdk(tmp_path):
    library = STAND_INS / "dhd/libdrd.so.3"
    need("forcedimension_core", library)
    folder = tmp_path / "lib/release" / f"lin-{os.uname().machine}-gcc"
    folder.mkdir(parents=True)
    (folder / "libdrd.so.3").symlink_to(library)
    return {"FDSDK": str(tmp_path)}


HAPTICS = """
    import time
    from pyOpenHaptics import hd
    from pyOpenHaptics.hd_callback import hd_callback
    from pyOpenHaptics.hd_device import HapticDevice

    seen = []

    @hd_callback
    def tick():
        seen.append(([row[:] for row in hd.get_transform()], hd.get_buttons()))
        hd.set_force([0.5, 0.25, -0.125])

    device = HapticDevice(callback=tick, scheduler_type="async")
    while len(seen) < 600:
        time.sleep(0.01)
    device.close()
    for i in (250, 500):
        matrix, buttons = seen[i]
        print(i, *(round(x, 9) for row in matrix for x in row), buttons)
"""

# Its own callback ignores errors of a device: this one handles them with its types and numbers.
HAPTICS_UNPLUGGED = """
    import ctypes, time
    from pyOpenHaptics import hd
    from pyOpenHaptics.hd_callback import hdAsyncSheduler
    from pyOpenHaptics.hd_define import *

    ticks, ends = [], []

    @ctypes.CFUNCTYPE(HDCallbackCode, ctypes.POINTER(ctypes.c_void_p))
    def tick(_):
        handle = hd.get_current_device()
        hd.begin_frame(handle)
        error = hd._get_error()
        hd.end_frame(handle)
        if error.errorCode == HD_SUCCESS:
            ticks.append(handle)
            return HD_CALLBACK_CONTINUE
        ends.append((error.errorCode == HD_COMM_ERROR, error.hHD == handle))
        return HD_CALLBACK_DONE

    handle = hd.init_device()
    hd.start_scheduler()
    hdAsyncSheduler(tick)
    while not ends:
        time.sleep(0.01)
    time.sleep(0.05)
    hd.stop_scheduler()
    hd.close_device(handle)
    print(len(ticks) <= 700, ends)
"""


def test_py_open_haptics_reads_the_circle_of_the_stand_in(openhaptics):
    lines = run(HAPTICS, HD_STAND_IN="period_ns=100000,buttons=2", **openhaptics)
    assert "Intialized device! libmvs/Stand-in Touch" in lines
    rows = {line.split()[0]: [float(x) for x in line.split()[1:]] for line in lines[-2:]}
    # columns: the stylus' axes, then its place in mm; the first ticks may come before the callback
    assert rows["250"][16] == 2
    x, y, z = rows["250"][12:15]
    assert x**2 + y**2 == pytest.approx(30**2)
    assert z == 10
    assert rows["250"][:2] == pytest.approx([x / 30, y / 30])
    assert rows["500"][12:15] == pytest.approx([-y, x, 10], abs=1e-6)


def test_py_open_haptics_sees_the_unplugged_device_and_its_callback_ends(openhaptics):
    lines = run(HAPTICS_UNPLUGGED, HD_STAND_IN="period_ns=100000,unplug_at=700", **openhaptics)
    assert lines == ["True [(True, True)]"]


def test_py_open_haptics_cannot_open_an_absent_device(openhaptics):
    lines = run("""
        from pyOpenHaptics import hd
        print(hd.init_device("no such device") == 0xFFFFFFFF, hex(hd._get_error().errorCode))
    """, **openhaptics)
    assert "True 0x303" in lines


FORCE_DIMENSION = """
    import ctypes
    from forcedimension_core import dhd
    from forcedimension_core.containers import Vec3, Status, Mat3x3
    from forcedimension_core.constants import *
"""


def test_forcedimension_core_opens_reads_and_saturates(sdk):
    lines = run(FORCE_DIMENSION + """
    print("count", dhd.getDeviceCount())
    index = dhd.open()
    print("system", dhd.getSystemType(), dhd.getSystemName(), dhd.getSerialNumber())
    p, v, f = Vec3(), Vec3(), Vec3()
    for _ in range(251):
        assert dhd.direct.getPosition(p) == 0
    assert dhd.direct.getLinearVelocity(v) == 0
    print("p", *(round(x, 9) for x in p), "v", *(round(x, 6) for x in v))
    assert dhd.enableForce(True) == 0
    assert dhd.setForce([1, 2, 3]) == 0
    dhd.direct.getForce(f)
    print("f", *f)
    status = Status()
    dhd.getStatus(status)
    print("on", status.force, status.power, status.forceoffcause)
    print("saturated", dhd.setForce([100, 0, 0]) == MOTOR_SATURATED)
    assert dhd.setMaxForce(5) == 0 and dhd.getMaxForce() == 5
    dhd.setForce([10, 0, 0])
    dhd.direct.getForce(f)
    print("clamped", *f)
    dhd.stop()
    dhd.getStatus(status)
    print("off", status.force, ForceOffCause(status.forceoffcause).name)
    print("closed", dhd.close(), dhd.getPosition(p))
    """, **sdk)
    assert lines == [
        "count 1",
        "system 33 stand-in omega 4000",
        "p 0.01 0.0 0.03 v 0.0 -0.188496 0.0",
        "f 1.0 2.0 3.0",
        "on 1 1 0",
        "saturated True",
        "clamped 5.0 0.0 0.0",
        "off 0 SOFTWARE",
        "closed 0 -1",
    ]


def test_forcedimension_core_reads_wrist_and_gripper_and_loses_the_device(sdk):
    lines = run(FORCE_DIMENSION + """
    dhd.open()
    print("has", dhd.hasWrist(), dhd.hasActiveWrist(), dhd.hasGripper())
    p, m, angle = Vec3(), Mat3x3(), ctypes.c_double()
    for _ in range(251):
        assert dhd.direct.getPositionAndOrientationFrame(p, m) == 0
    print("m", *(round(m[i, j], 9) for i in range(3) for j in range(3)))
    assert dhd.getGripperAngleRad(angle) == 0
    print("angle", angle.value)
    codes = [dhd.direct.getPosition(p) for _ in range(60)]
    print("lost after", 251 + codes.index(-1), dhd.errorGetLast().name)
    """, DHD_STAND_IN="type=104,unplug_at=300", **sdk)
    assert lines == [
        "has True True True",
        "m 1.0 0.0 0.0 0.0 0.0 -1.0 0.0 1.0 0.0",
        "angle 0.5",
        "lost after 300 COM",
    ]
