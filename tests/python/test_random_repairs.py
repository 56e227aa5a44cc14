"""Random repairs of random valves come to rest (tests/validation/random_repairs.py)."""

import random_repairs

SEEDS = (2000, 2009)  # bilinear membrane and springs


def test_random_repairs_come_to_rest_without_crossings():
    rows = [row for seed in SEEDS for row in random_repairs.settles_of(seed, 425)]
    assert sum(not row.refused for row in rows) == 8
    assert not [row for row in rows if row.failed()]
    assert "8 settles of 2 valves: 0 did not come to rest, 0 left crossings" in random_repairs.report(rows)


def test_a_settle_that_does_not_come_to_rest_is_named_and_its_valve_kept(tmp_path, monkeypatch, capsys):
    asked = ["random_repairs.py", "--seeds", "2000", "--iterations", "2", "--keep", str(tmp_path)]
    monkeypatch.setattr("sys.argv", asked)
    assert random_repairs.main() == 1
    printed = capsys.readouterr().out
    assert "seed 2000, bilinear: close(): not at rest after 2 iterations" in printed
    assert (tmp_path / "2000_0_close.h5").exists()


def test_a_seed_draws_the_same_repairs_again():
    first, second = ([(r.operation, r.arguments) for r in random_repairs.settles_of(2001, 300)] for _ in range(2))
    assert first == second and len(first) == 4


def test_ranges_of_seeds_leave_their_end_out():
    assert list(random_repairs.seeds_of("4:6")) == [4, 5]
    assert list(random_repairs.seeds_of("7")) == [7]
