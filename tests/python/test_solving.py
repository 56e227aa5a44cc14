"""Settling and stepping: reproducible, usable with threads, and cancellable."""

import signal
import threading
import time

import mvs
import numpy as np
import pytest


def settle_fresh(vertices=425, **options):
    with mvs.Simulator() as sim:
        sim.generate(shape="founding", vertices=vertices)
        sim.set_load(mvs.SYSTOLE_PA)
        stats = sim.settle(**options)
        return stats, sim.snapshot()


def test_settling_closes_the_shipped_valve():
    stats, closed = settle_fresh()
    assert stats.converged and stats.residual <= 1e-4
    assert closed.measures.intersections == 0
    assert closed.measures.regurgitant_orifice_area == 0


def test_rest_is_stable_and_the_mode_is_that_of_a_fold():
    stats, closed = settle_fresh()
    assert stats.stable and stats.stiffness_margin > 0 and stats.growth_rate < 0
    assert closed.stability.stable
    assert closed.stability.growth_rate == pytest.approx(stats.growth_rate, rel=0.02)
    lengths = np.linalg.norm(closed.node_mode, axis=1)
    assert lengths.max() == pytest.approx(1)
    assert np.all(lengths[closed.annulus_nodes] == 0)


def test_a_settle_without_margins_has_the_same_shape_and_is_proved_stable():
    stats, closed = settle_fresh()
    quick, again = settle_fresh(margins=False)
    assert again.hash == closed.hash
    assert quick.stable and (quick.stiffness_margin, quick.growth_rate) == (0, 0)
    assert again.stability.stiffness_margin == pytest.approx(stats.stiffness_margin, rel=0.02)
    with mvs.Simulator() as sim:
        sim.generate(shape="founding")
        sim.set_load(mvs.SYSTOLE_PA)
        assert list(sim.settle_slices(3600, margins=False))[-1] == 1
        assert sim.stats.stable and sim.stats.stiffness_margin == 0


def test_workers_give_the_same_bits(monkeypatch):
    monkeypatch.setenv("MVS_WORKERS_LEAST_US", "0")  # a small valve shares its loops, too
    expected = settle_fresh(max_iterations=5)[1].hash
    with mvs.Simulator(workers=3) as sim:
        sim.generate(shape="founding")
        sim.set_load(mvs.SYSTOLE_PA)
        sim.settle(max_iterations=5)
        assert sim.snapshot().hash == expected
    with pytest.raises(mvs.ArgumentError, match="at most 256"):
        mvs.Simulator(workers=257)


@pytest.mark.filterwarnings("ignore::mvs.ValveWarning")
def test_a_simulator_like_a_snapshot_gives_the_same_bits():
    with mvs.Simulator() as sim:
        sim.generate(shape="founding", vertices=1250)
        base = sim.snapshot()

    def closed(sim, variant):
        sim.set_valve(variant)
        sim.set_load(mvs.SYSTOLE_PA)
        sim.settle(max_iterations=2)
        return sim.snapshot().hash

    hashes = set()
    for k in range(3):
        variant = mvs.valve_of(base)
        variant.chord_rest_length *= 1 - 0.01 * k
        with mvs.Simulator() as alone, mvs.Simulator(like=base) as like:
            assert like.snapshot().hash == base.hash
            hashes.add(closed(alone, variant))
            assert closed(like, variant) in hashes
    assert len(hashes) == 3
    with pytest.raises(TypeError):
        mvs.Simulator(like=sim)


def test_settling_twice_gives_the_same_bits():
    first, second = settle_fresh(max_iterations=20)[1], settle_fresh(max_iterations=20)[1]
    assert first.hash == second.hash
    assert first.node_position.tobytes() == second.node_position.tobytes()


def test_other_python_threads_run_while_it_settles():
    ticks = 0
    done = threading.Event()

    def work():
        settle_fresh(vertices=1700)  # 425 close in less time than the ticks below take
        done.set()

    thread = threading.Thread(target=work)
    thread.start()
    while not done.is_set():
        time.sleep(0.001)
        ticks += 1
    thread.join()
    # a held interpreter would let this loop run only between calls
    assert ticks > 20


def test_simulators_in_threads_agree_with_one_alone():
    alone = settle_fresh(max_iterations=15)[1].hash
    found = []
    threads = [
        threading.Thread(target=lambda: found.append(settle_fresh(max_iterations=15)[1].hash))
        for _ in range(3)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [alone] * 3


def test_threads_that_share_a_simulator_take_turns(sim):
    sim.set_load(mvs.SYSTOLE_PA)
    threads = [threading.Thread(target=lambda: sim.settle(max_iterations=5)) for _ in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert np.isfinite(sim.snapshot().node_position).all()


def test_progress_reports_share_and_residual(sim):
    seen = []
    sim.set_load(mvs.SYSTOLE_PA)
    sim.settle(progress=lambda share, residual: seen.append((share, residual)))
    assert seen
    assert all(0 <= share <= 1 and residual >= 0 for share, residual in seen)


def test_progress_that_returns_true_cancels_and_changes_nothing(sim):
    sim.set_load(mvs.SYSTOLE_PA)
    before = sim.snapshot().hash
    with pytest.raises(mvs.CancelledError):
        sim.settle(progress=lambda share, residual: True)
    assert sim.snapshot().hash == before


def test_an_exception_in_progress_stops_and_is_raised(sim):
    sim.set_load(mvs.SYSTOLE_PA)
    before = sim.snapshot().hash

    def fail(share, residual):
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        sim.settle(progress=fail)
    assert sim.snapshot().hash == before


def test_a_callback_may_take_snapshots_but_not_settle(sim):
    sim.set_load(mvs.SYSTOLE_PA)
    before = sim.snapshot().hash
    seen = []
    sim.settle(max_iterations=3, progress=lambda *_: seen.append(sim.snapshot().hash))
    assert set(seen) == {before}
    for call in (lambda *_: sim.step(), lambda *_: sim.close(), lambda *_: sim.stats):
        with pytest.raises(mvs.StateError, match="callback"):
            sim.settle(progress=call)


def test_ctrl_c_stops_a_settle(sim):
    sim.set_load(mvs.SYSTOLE_PA)

    def interrupt(share, residual):
        signal.raise_signal(signal.SIGINT)

    # tests in the background of a shell ignore the signal
    kept = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        with pytest.raises(KeyboardInterrupt):
            sim.settle(progress=interrupt)
    finally:
        signal.signal(signal.SIGINT, kept)


def test_steps_move_the_valve_and_count(sim):
    sim.set_load(mvs.SYSTOLE_PA)
    before = sim.snapshot().node_position
    sim.step(3, solver="explicit")
    moved = np.abs(sim.snapshot().node_position - before).max()
    assert 0 < moved < 1e-3
    sim.step(solver="implicit", dt=1e-4)
    assert np.isfinite(sim.snapshot().node_velocity).all()


def test_restore_puts_every_bit_back(sim):
    start = sim.snapshot()
    sim.set_load(mvs.SYSTOLE_PA)
    sim.step(2, solver="explicit")
    assert sim.snapshot().hash != start.hash
    sim.restore(start)
    assert sim.snapshot().hash == start.hash


def test_stats_and_load_can_be_read_back(sim):
    sim.set_load(1e4, 0.5)
    assert sim.load_case == mvs.Load(1e4, 0.5)
    stats = sim.settle(max_iterations=2)
    assert sim.stats == stats
    assert stats.iterations <= 2
    assert stats.profile.terms_s > 0 and stats.profile.factor_s > 0 and stats.profile.solve_s > 0


def test_an_explicit_step_too_large_for_a_stiff_valve_diverges(real_valves):
    folder = real_valves / "texas_trivalve_1.1_healthy"
    if not folder.is_dir():
        pytest.skip(f"no {folder}")
    with mvs.Simulator() as sim:
        sim.load(folder / "Healthy_QuasiStatic.inp")
        sim.coarsen(vertices=800)
        sim.set_load(3060.0)
        # nodes leave the range of the broad phase before a force is not finite
        with pytest.raises(mvs.DivergedError, match="time step is too large"):
            sim.settle(solver="explicit", dt=8e-6, max_iterations=2000)


def test_slices_have_the_bits_of_one_call_and_leaving_them_cancels(sim):
    sim.set_load(mvs.SYSTOLE_PA)
    before = sim.snapshot()
    for _ in sim.settle_slices(0):
        assert sim.snapshot().hash == before.hash
        break
    with pytest.raises(mvs.StateError, match="begin_settle"):
        sim.advance_settle(1)
    shares = list(sim.settle_slices(0))
    # iterations on coarse meshes are slices, but are not counted
    assert len(shares) >= sim.stats.iterations + 1
    assert shares == sorted(shares)
    assert shares[-1] == 1 > shares[-2]
    sliced = sim.snapshot()
    sim.restore(before)
    assert sim.settle().converged
    assert sim.snapshot().hash == sliced.hash
    sim.restore(before)
    (share,) = sim.settle_slices(3600, solver="implicit", max_iterations=2)
    assert share == 1
    assert sim.stats.iterations == 2


@pytest.mark.parametrize("moved", [1e-9, 1e-6, 0.05e-3])
def test_a_boundary_that_hardly_moves_does_not_close_the_valve_anew(moved):
    """From open, over coarser meshes, a valve may come to rest in another fold."""
    with mvs.Simulator() as sim:
        sim.generate(vertices=700)
        sim.set_load(mvs.SYSTOLE_PA)
        assert sim.settle(residual=1e-8).converged
        before = sim.snapshot()
        head = next(part.name for part in before.parts if part.kind == mvs.PartKind.HEAD)
        sim.apply("head_move", head=head, by=(0, 0, -moved))
        stats = sim.settle(residual=1e-8)
        after = sim.snapshot()
    assert stats.converged
    # Newton's method near rest converges quadratically; from open it takes 20 iterations and more
    assert stats.iterations <= 6
    # a soft fold follows its head amplified; another fold is 100 um and more away
    assert np.abs(after.node_position - before.node_position).max() < max(1e-6, 20 * moved) < 2e-3
