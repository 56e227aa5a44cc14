"""Plans and journals: the same bits on the same valve, parts by name on another one."""

import gc
import json
import math
import signal
import subprocess
import sys

import mvs
import pytest


def operate(sim):
    sim.apply("chord_length", chord="P2/3", factor=0.75)
    sim.set_load(mvs.SYSTOLE_PA)
    sim.settle(max_iterations=4)
    with sim.group("repair of P2"):
        sim.apply("chord_add", name="new one", head="PM1", site=("P2", 0.4, 0.8))
        sim.apply("annulus_scale", factor=0.95)


@pytest.fixture(scope="module")
def operated():
    with mvs.Simulator() as sim:
        sim.generate(shape="founding")
        operate(sim)
        return sim.snapshot()


def shapes_of(plan, folder):
    """A plan in every form that replay_plan accepts."""
    path = folder / "plan.json"
    path.write_text(plan, encoding="utf-8")
    return [plan, plan.encode(), json.loads(plan), path, str(path)]


def test_a_plan_lists_the_operations(operated):
    plan = json.loads(operated.plan(author="Élodie", notes="first try"))
    assert (plan["format"], plan["author"], plan["notes"]) == ("mvs-plan", "Élodie", "first try")
    assert [step["do"] for step in plan["steps"]] == [
        "chord_length", "load", "settle", "chord_add", "annulus_scale"
    ]
    assert plan["result"]["hash"] == operated.hash
    assert "before" not in plan["steps"][0]


def test_measures_are_written_on_request(operated, tmp_path):
    with_measures = operated.plan(measures=True)
    first = json.loads(with_measures)["steps"][0]
    assert first["before"]["annulus_ap_m"] > 0
    assert first["after"]["max_chord_strain"] >= 0
    path = tmp_path / "plan.json"
    operated.save_plan(path, measures=True)
    assert path.read_text(encoding="utf-8") == with_measures


def test_a_long_plan_is_complete(opened):
    # longer than the first buffer of the binding, 64 KiB
    notes = "ä" * 50_000
    assert json.loads(opened.plan(notes=notes))["notes"] == notes


def test_the_same_valve_ends_at_the_same_bits(operated, tmp_path):
    for plan in shapes_of(operated.plan(), tmp_path):
        with mvs.Simulator() as sim:
            sim.generate(shape="founding")
            fresh = sim.snapshot().hash
            checked = sim.check_plan(plan)
            assert (checked.operations, checked.same_valve) == (3, True)
            assert sim.snapshot().hash == fresh
            assert sim.replay_plan(plan) == mvs.Replay(3, True, True)
            assert sim.snapshot().hash == operated.hash
            sim.undo()  # the group as one
            assert len([e for e in sim.snapshot().history if e.done]) == 1


def test_another_mesh_is_operated_on_by_name(operated):
    with mvs.Simulator() as sim:
        sim.generate(shape="founding", vertices=800)
        assert sim.replay_plan(operated.plan()) == mvs.Replay(3, False, False)
        done = sim.snapshot()
    assert done.find(mvs.PartKind.CHORD, "new one").id
    assert [e.kind for e in done.history] == ["chord_length", "chord_add", "annulus_scale"]


STEP_3 = {"do": "chord_remove", "chord": "P2/3"}


@pytest.mark.parametrize(
    "plan, kind, words",
    [
        ("", mvs.FormatError, "not JSON"),
        ("[1]", mvs.FormatError, "not a plan"),
        ({"version": 2, "steps": []}, mvs.VersionError, "has version 2, this libmvs reads version 1"),
        ({"steps": [1]}, mvs.FormatError, "step 1"),
        ({"steps": [{"do": "fly"}]}, mvs.VersionError, '"fly"'),
        ({"steps": [STEP_3, STEP_3]}, mvs.IdError, "step 2 of the plan: chord_remove: "),
        (
            {"steps": [STEP_3, {"do": "annulus_scale", "factor": 0}]},
            mvs.Error,
            "step 2 of the plan: annulus_scale: ",
        ),
        ({"steps": [{"do": "annulus_scale", "factor": math.nan}]}, mvs.ArgumentError, "not JSON"),
        ({"steps": {1, 2}}, mvs.ArgumentError, "not JSON"),
        (7, mvs.ArgumentError, "not int"),
        ("no/such/plan.json", mvs.IoError, "no/such/plan.json: cannot read the plan: "),
        ('{"\ud800": 1}', mvs.FormatError, "not JSON"),
    ],
)
def test_plans_that_cannot_be_replayed_are_refused_and_change_nothing(sim, plan, kind, words):
    before = sim.snapshot().hash
    if isinstance(plan, dict):
        plan = {"format": "mvs-plan", "version": 1, **plan}
    for call in (sim.check_plan, sim.replay_plan):
        with pytest.raises(kind) as caught:
            call(plan)
        assert words in str(caught.value)
    assert sim.snapshot().hash == before


def test_a_replay_can_be_cancelled(sim, operated):
    before = sim.snapshot().hash
    with pytest.raises(mvs.CancelledError):
        sim.replay_plan(operated.plan(), progress=lambda share, residual: True)
    with pytest.raises(ZeroDivisionError):
        sim.replay_plan(operated.plan(), progress=lambda share, residual: 1 / 0)
    assert sim.snapshot().hash == before


def test_invalid_texts_and_paths_of_a_plan_are_refused(operated, tmp_path):
    with pytest.raises(mvs.ArgumentError, match="notes"):
        operated.plan(notes="one\0two")
    with pytest.raises(mvs.IoError):
        operated.save_plan(tmp_path / "nowhere" / "plan.json")


def test_a_journal_outlives_its_simulator(tmp_path):
    path = tmp_path / "session.mvsj"
    first = mvs.Simulator()
    first.generate(shape="founding")
    first.open_journal(path)
    operate(first)
    wanted = first.snapshot().hash
    del first  # not closed
    gc.collect()
    with mvs.Simulator() as sim:
        sim.generate(shape="founding")
        assert sim.recover_journal(path).operations == 3
        assert sim.snapshot().hash == wanted
        sim.undo()  # the journal continues
        undone = sim.snapshot().hash
        sim.close_journal()
        sim.apply("annulus_scale", factor=1.1)  # after the end of the journal
    with mvs.Simulator() as sim:
        sim.generate(shape="founding")
        sim.recover_journal(path)
        assert sim.snapshot().hash == undone


def checksum(text):
    """The checksum of formats/FORMAT.md, in hexadecimal digits."""
    mask = (1 << 64) - 1

    def rotl(x, n):
        return (x << n | x >> (64 - n)) & mask

    def finish(x):
        x = (x ^ x >> 30) * 0xBF58476D1CE4E5B9 & mask
        x = (x ^ x >> 27) * 0x94D049BB133111EB & mask
        return x ^ x >> 31

    a, b = 0x243F6A8885A308D3, 0x13198A2E03707344
    for word in (len(text), *text):
        a = (a ^ word) * 0x9E3779B97F4A7C15 & mask
        a ^= a >> 32
        b = (b ^ rotl(word, 29)) * 0xC2B2AE3D27D4EB4F & mask
        b ^= b >> 29
    return f"{finish(a):016x}{finish(b ^ rotl(a, 17)):016x}"


@pytest.mark.parametrize("version, kind, words", [
    ({}, mvs.FormatError, "the journal has no version"),
    ({"version": 2}, mvs.VersionError, "the journal has version 2, this libmvs reads version 1"),
])
def test_a_journal_of_another_version_is_refused(sim, tmp_path, version, kind, words):
    path = tmp_path / "session.mvsj"
    start = json.loads(sim.snapshot().plan())["valve"]
    text = json.dumps({"do": "begin", "valve": start, "steps": [], **version})
    path.write_text(f"mvsj {len(text)} {checksum(text.encode())} {text}\n")
    with pytest.raises(kind, match=words):
        sim.recover_journal(path)


KILLED = """
import os, signal, sys, mvs
sim = mvs.Simulator()
sim.generate(shape="founding")
sim.open_journal(sys.argv[1])
sim.apply("chord_length", chord="P2/3", factor=0.75)
print(sim.snapshot().hash, flush=True)
os.kill(os.getpid(), signal.SIGKILL)
"""


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="this system has no SIGKILL")
def test_a_journal_outlives_a_killed_process(sim, tmp_path):
    path = tmp_path / "session.mvsj"
    run = subprocess.run([sys.executable, "-c", KILLED, str(path)], capture_output=True, text=True)
    assert run.returncode == -signal.SIGKILL, run.stderr
    sim.recover_journal(path)
    assert sim.snapshot().hash == run.stdout.strip()


def test_invalid_journals_are_refused(sim, tmp_path):
    path = tmp_path / "session.mvsj"
    with pytest.raises(mvs.StateError, match="no journal is open"):
        sim.close_journal()
    with pytest.raises(mvs.IoError):
        sim.open_journal(tmp_path / "nowhere" / "session.mvsj")
    sim.open_journal(path)
    sim.close_journal()
    with pytest.raises(mvs.StateError, match="is there already"):
        sim.open_journal(path)
    sim.apply("annulus_scale", factor=0.9)
    with pytest.raises(mvs.StateError, match="load that valve first"):
        sim.recover_journal(path)
    path.write_text("v 0 0 0\n")
    with pytest.raises(mvs.FormatError, match="not a journal"):
        sim.recover_journal(path)
