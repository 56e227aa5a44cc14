"""Haptic devices from Python: a recorded hand on a virtual clock."""

import threading

import mvs
import numpy as np
import pytest
from conftest import ROOT
from mvs.haptics import Cause, Event, HandMode, Phase

GRASP = ROOT / "haptic_drivers" / "replay" / "trajectories" / "grasp_a2.txt"
VALVE_OVER_DEVICE = (1, 1, 0, 0)  # the valve's z is the device's y, its y the device's -z


@pytest.fixture
def device():
    """The recorded grasp of A2, started."""
    with mvs.Device("replay", options={"file": GRASP}, clock="virtual") as opened:
        opened.start()
        yield opened


def test_drivers_are_found_listed_and_checked():
    names = {driver.name for driver in mvs.haptics.drivers()}
    assert {"template", "replay", "hand"} <= names
    (found,) = mvs.haptics.list("replay", {"file": GRASP})
    assert (found.name, found.model) == (str(GRASP), "Touch")
    verdicts = {row.check: row for row in mvs.haptics.doctor("replay", {"file": GRASP})}
    assert verdicts["recording"].verdict == "good"
    everybody = {row.check: row.verdict for row in mvs.haptics.doctor()}
    assert everybody["template: driver"] == "good"
    assert "note" in everybody.values() and "fault" not in everybody.values()
    bad = mvs.haptics.doctor("replay", {"file": "nowhere.txt"})
    assert "nowhere.txt" in [row for row in bad if row.verdict == "fault"][0].sentence


def test_a_device_reports_its_properties(device):
    info = device.info
    assert (info.driver, info.model, info.clock) == ("replay", "Touch", "virtual")
    assert (info.freedoms_in, info.buttons, info.peak_force) == (6, 2, 3.3)
    np.testing.assert_allclose(info.workspace_max, [0.08, 0.06, 0.08])
    assert mvs.unit_of(mvs.haptics.Info, "peak_force") == "N"


def test_settings_can_be_read_back(device):
    device.set_limits(force=1.0, ramp_s=0.5)
    assert (device.limits.force, device.limits.ramp_s, device.limits.gate) == (1.0, 0.5, 0.2)
    device.set_view(origin=(1e-3, 0, 0), rotation=(2, 0, 0, 0), scale=0.5, force_scale=2)
    np.testing.assert_array_equal(device.view.rotation, [1, 0, 0, 0])
    assert (device.view.origin[0], device.view.scale, device.view.force_scale) == (1e-3, 0.5, 2)
    device.set_hand("ball", radius=3e-3)
    assert (device.hand.mode, device.hand.radius) == (HandMode.BALL, 3e-3)
    bar = {"kind": "capsule", "position": (0, 0, 0), "end": (0, 0, 0.02), "radius": 1e-3}
    device.set_hand("convex", bodies=[bar, {"kind": "ball", "radius": 2e-3}])
    assert (device.hand.mode, device.hand.body_count) == (HandMode.CONVEX, 2)
    with pytest.raises(mvs.ArgumentError, match="bodies"):
        device.set_hand("convex")
    with pytest.raises(mvs.ArgumentError, match="colour"):
        device.set_hand("convex", bodies=[{"kind": "ball", "colour": 1}])
    assert device.hand.body_count == 2
    with pytest.raises(mvs.ArgumentError, match="drag"):
        device.set_hand("squeeze")
    with pytest.raises(mvs.ArgumentError, match="ramp_s"):
        device.set_limits(ramp_s=100)
    assert device.limits.ramp_s == 0.5


def test_a_device_with_motors_for_torque_has_limits_of_torque(device):
    assert device.info.peak_torque == device.limits.torque == device.limits.torque_slew == 0
    np.testing.assert_array_equal(device.state.torque, [0, 0, 0])
    with mvs.Device("hand", options={"device": "premium6"}, clock="virtual") as other:
        assert (other.info.freedoms_out, other.info.peak_torque) == (6, 0.188)
        assert other.limits.angular_stiffness == other.info.max_angular_stiffness > 0
        other.set_limits(torque=0.05, angular_speed=5)
        assert (other.limits.torque, other.limits.torque_slew) == (0.05, 5)
        assert (other.limits.angular_speed, other.limits.force) == (5, other.info.peak_force)
        with pytest.raises(mvs.ArgumentError, match="torque"):
            other.set_limits(torque=-1)
    assert mvs.unit_of(mvs.haptics.Report, "torque") == "N m"


def grasp_a2(device, closed, seconds):
    """Plays the recording in a closed valve; returns every report and the trace."""
    reports, rows = [], []
    device.set_view(rotation=VALVE_OVER_DEVICE)
    device.set_hand("grasp")
    with mvs.Simulator() as sim:
        sim.restore(closed)
        device.arm()
        for _ in range(round(50 * seconds)):
            device.advance(0.02)
            reports.append(device.sync(sim))
            rows.append(device.trace())
            sim.step()
    return reports, np.concatenate(rows)


def test_a_recorded_hand_grasps_pulls_and_releases(device, closed):
    reports, rows = grasp_a2(device, closed, 6.5)  # presses at 2.3 s, releases at 6.1 s
    (taken,) = [r for r in reports if Event.GRASPED in r.events]
    assert taken.node == 7  # vertex 8 of the file, which counts from 1: on A2 (make.py)
    assert sum(Event.LET_GO in r.events for r in reports) == 1
    assert reports[-1].tool is None and device.lost == 0
    # displaced by 10 mm, the leaflet pulls with 1.74 N, above the continuous force of the Touch:
    # the force of the motors lies between that and the peak force (the simulation lags behind the
    # hand, which waits there for a second)
    pull = max(np.linalg.norm(r.force) for r in reports)
    assert pull == pytest.approx(1.74, rel=0.05)
    felt = np.linalg.norm(rows["force"], axis=1)
    assert 0.88 < felt.max() <= 3.3
    state = device.state
    assert (state.phase, state.cause) == (Phase.ON, Cause.NONE)
    assert state.ticks == len(rows) == 6500


def test_the_same_session_gives_the_same_bits(closed):
    traces = []
    for _ in range(2):
        with mvs.Device("replay", options={"file": GRASP}, clock="virtual") as device:
            device.start()
            traces.append(grasp_a2(device, closed, 3)[1].tobytes())
    assert traces[0] == traces[1]


def test_a_trace_holds_every_tick(device):
    device.advance(0.5)
    rows = device.trace()
    assert rows.shape == (500,) and device.trace().shape == (0,)
    np.testing.assert_allclose(np.diff(rows["time"]), 1e-3, rtol=1e-9)
    np.testing.assert_allclose(np.linalg.norm(rows["orientation"], axis=1), 1, rtol=1e-12)
    assert rows["position"].shape == (500, 3) and not rows["force"].any()
    device.advance(9)
    # the library keeps 8192 ticks, one of which may be in writing
    assert len(device.trace()) + device.lost == 9000


def test_forces_are_cut_from_another_thread(device, sim):
    device.set_hand("look")
    device.arm()
    device.advance(0.01)
    assert device.state.phase != Phase.LATCHED
    cutter = threading.Thread(target=device.cut)
    cutter.start()
    cutter.join()
    device.advance(0.002)
    assert (device.state.phase, device.state.cause) == (Phase.LATCHED, Cause.SOFTWARE)
    assert Event.LATCHED in device.sync(sim).events
    device.arm()
    device.advance(0.002)
    assert device.state.phase != Phase.LATCHED


def test_a_real_clock_runs_without_calls():
    with mvs.Device("template") as device:
        device.start()
        waiter = threading.Event()
        for _ in range(1000):
            if device.state.ticks > 20:
                break
            waiter.wait(0.01)
        assert device.state.ticks > 20
        assert isinstance(device.info.realtime, bool)
        with pytest.raises(mvs.StateError, match="virtual|VIRTUAL"):
            device.advance(1)
        device.stop()
        assert device.state.phase == Phase.STOPPED


def test_errors_are_reported(device, tmp_path):
    with pytest.raises(mvs.IoError, match="there is no driver"):
        mvs.Device("nowhere")
    with pytest.raises(mvs.ArgumentError, match="no option"):
        mvs.Device("replay", options={"colour": "red"})
    with pytest.raises(mvs.ArgumentError, match="no such recording"):
        mvs.haptics.list("replay", {"file": tmp_path / "none.txt"})
    with pytest.raises(mvs.ArgumentError, match="clock"):
        mvs.Device("replay", options={"file": GRASP}, clock="slow")
    with mvs.Simulator() as empty, pytest.raises(mvs.StateError):
        device.sync(empty)
    device.close()
    with pytest.raises(mvs.StateError, match="closed"):
        device.start()
    with pytest.raises(mvs.StateError, match="closed"):
        print(device.state)
