"""The driver of the Haply Inverse3 against a service built on `websockets`, a third party's server.

Our own WebSocket client and the service of haply.cpp could share a mistake in the protocol; this one
refuses what RFC 6455 forbids. The frames are those of docs.haply.co and of the crate haply 1.3.1.
"""

import json
import threading
import time

import pytest
from plugin import CALIBRATED, E_LOST, FOLDER, FORCE_ON, OK, VELOCITY, Plugin

server = pytest.importorskip("websockets.sync.server")

pytestmark = pytest.mark.skipif(
    not (FOLDER / "haply.so").exists(),
    reason=f"no haply.so in {FOLDER}: cmake --build --preset release --target mvs_driver_haply",
)


def device(**state):
    """A full entry, as in the first frame (WebSocket Protocol, step 1)."""
    return {
        "device_id": "049D",
        "config": {
            "type": "inverse3",
            "port": "COM12",
            "device_info": {"major_version": 7, "minor_version": 4, "id": "049D",
                            "device_type": 4, "uuid": "5A9F"},
            "extended_device_id": "ED78730C8173560784AB4167961D048D",
            "extended_firmware_version": "8C20FDC8010AA1E15AA133CDA2534874",
            "gravity_compensation": {"enabled": True, "scaling_factor": 1.0},
            "handedness": "right",
            "torque_scaling": {"enabled": True},
            "preset": "defaults",
            "basis": {"permutation": "XYZ"},
            "filters": {"force_gate": {"gain": 0.3}, "damping": {"scalar": 0.0}},
        },
        "state": {
            "angular_position": {"a0": -9.75, "a1": 72.5, "a2": -22.783606},
            "body_orientation": {"x": 0.026611328, "y": 0.7089844, "z": -0.00018310547,
                                 "w": 0.7047119},
            "cursor_position": {"x": 0.12794551, "y": 0.038903017, "z": -0.05089721},
            "cursor_velocity": {"x": -0.00018158932, "y": -2.3230032e-05, "z": -0.00025131978},
            "control_domain": "undefined",
            "control_mode": "idle",
            "transform": {},
            **state,
        },
        "status": {"calibrated": True, "in_use": False, "power_supply": True, "ready": True,
                   "started": True},
    }


GRIP = {
    "device_id": "1102",
    "config": {"port": "COM12", "type": "wireless_verse_grip", "streaming_mode": "Radio",
               "basis": {"permutation": "XYZ"}},
    "state": {
        "battery_voltage": 3.695,
        "battery_level": 0.1583334,
        "buttons": {"a": False, "b": True, "c": False},
        "hall": 16,
        "orientation": {"x": -0.0016784668, "y": -0.037994385, "z": -0.74890137,
                        "w": 0.65896606},
    },
    "status": {"connected": True, "awake": True, "ready": True},
}


class Service:
    """A fake Inverse Service: one state for each message, commands checked as they come."""

    def __init__(self, version="3.5.0.0", pieces=1):
        self.version, self.pieces = version, pieces
        self.texts, self.codes, self.connections = [], [], []
        self.pause = threading.Event()
        self.server = server.serve(self.converse, "127.0.0.1", 0, process_request=self.answer)
        self.port = self.server.socket.getsockname()[1]
        self.thread = threading.Thread(target=self.server.serve_forever)

    def __enter__(self):
        self.thread.start()
        return self

    def __exit__(self, *_):
        self.server.shutdown()
        self.thread.join()

    def answer(self, connection, request):
        if request.path != "/version":
            return None
        return connection.respond(200, json.dumps({
            "build_time": "2024-08-07T16:01:53Z", "git_branch": "main",
            "git_describe": f"{self.version}-2-gce34c39e", "git_hash": "ce34c39e",
            "git_tag": self.version, "project_name": "haply-inverse-service",
            "project_version": self.version}))

    def say(self, connection, frame):
        text = json.dumps(frame)
        size = -(-len(text) // self.pieces)
        whole = self.pieces == 1
        connection.send(text if whole else [text[i:i + size] for i in range(0, len(text), size)])

    def converse(self, connection):
        self.connections.append(connection)
        self.say(connection, {"session_id": 7, "inverse3": [device()], "verse_grip": [],
                              "wireless_verse_grip": [GRIP]})
        count = 0
        try:
            for text in connection:
                assert isinstance(text, str)
                self.texts.append(json.loads(text))
                count += 1
                entry = device(cursor_position={"x": count * 2.0**-20, "y": 0, "z": 0})
                del entry["config"]
                if not self.pause.is_set():
                    self.say(connection, {"inverse3": [entry], "wireless_verse_grip": [GRIP]})
        finally:
            self.codes.append(connection.close_code)

    def forces(self, field):
        return [text["inverse3"][0]["commands"]["set_cursor_force"].get(field)
                for text in self.texts]


def eventually(check):
    for _ in range(10000):
        if check():
            return True
        time.sleep(1e-3)
    return False


def plugin(service, **options):
    # long time-outs: only tests of lateness set shorter ones
    return Plugin("haply", **{"host": "127.0.0.1", "port": service.port, "patience": 2000, **options})


@pytest.mark.parametrize("pieces", [1, 3])
def test_a_state_is_read_whole_or_in_pieces(pieces):
    with Service(pieces=pieces) as service, plugin(service) as opened:
        told = opened.info()
        assert (told.freedoms_in, told.freedoms_out, told.buttons) == (6, 3, 3)
        assert told.serial == b"ED78730C8173560784AB4167961D048D"
        assert opened.list() == ["049D"]
        result, first = opened.read()
        assert result == OK
        assert first.flags == CALIBRATED | VELOCITY
        assert first.buttons == 2
        assert list(first.velocity) == [-0.00018158932, -2.3230032e-05, -0.00025131978]
        # the service's quaternion has unit length to 0.2 %
        assert list(first.orientation) == pytest.approx(
            [0.65896606, -0.0016784668, -0.037994385, -0.74890137], abs=2e-3)
        assert sum(part * part for part in first.orientation) == pytest.approx(1, abs=1e-14)
        assert eventually(lambda: opened.read()[1].position[0] > first.position[0])


@pytest.mark.parametrize("version, field", [("3.1.2.0", "values"), ("3.5.0.0", "vector")])
def test_forces_arrive_and_the_last_one_is_zero(version, field):
    with Service(version) as service:
        with plugin(service) as opened:
            assert opened.api.start(opened.device) == OK
            assert opened.write(0.5, -1.25, 3) == OK
            wanted = {"x": 0.5, "y": -1.25, "z": 3}
            assert eventually(lambda: service.forces(field)[-1] == wanted)
            assert eventually(lambda: opened.read()[1].flags & FORCE_ON)
        assert eventually(lambda: service.codes == [1000])
        assert service.forces(field)[-1] == {"x": 0, "y": 0, "z": 0}
        assert all(force is not None for force in service.forces(field))
        assert ("session" in service.texts[0]) == (field == "vector")
        assert not any("session" in text for text in service.texts[1:])


def test_panic_is_a_frame_that_the_server_takes():
    with Service() as service, plugin(service) as opened:
        assert opened.api.start(opened.device) == OK
        assert opened.write(1, 0, 0) == OK
        assert eventually(lambda: service.forces("vector")[-1]["x"] == 1)
        service.pause.set()
        time.sleep(0.02)
        before = len(service.texts)
        opened.api.panic(opened.device)
        assert eventually(lambda: len(service.texts) > before)
        assert service.forces("vector")[before] == {"x": 0, "y": 0, "z": 0}
        service.pause.clear()
    assert eventually(lambda: service.codes == [1000])


def test_a_ping_is_answered():
    with Service() as service, plugin(service):
        assert service.connections[0].ping().wait(10)


def test_a_silent_service_is_lost_after_a_zero_force():
    with Service() as service, plugin(service, patience=80) as opened:
        assert opened.api.start(opened.device) == OK
        assert opened.write(1, 0, 0) == OK
        assert eventually(lambda: service.forces("vector")[-1]["x"] == 1)
        service.pause.set()
        assert eventually(lambda: opened.read()[0] == E_LOST)
        assert opened.error()
        assert eventually(lambda: service.forces("vector")[-1] == {"x": 0, "y": 0, "z": 0})


def test_a_service_that_ends_is_lost():
    with Service() as service, plugin(service) as opened:
        service.connections[0].close(1001)
        assert eventually(lambda: opened.read()[0] == E_LOST)
        assert "closed the connection" in opened.error()
