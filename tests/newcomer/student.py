"""A doctoral student in Python: material, tables, uncertainty, a sweep, a picture."""

import pickle
from concurrent.futures import ThreadPoolExecutor

import mvs

with mvs.Simulator() as sim:
    sim.generate()
    opened = sim.snapshot()
    sim.set_leaflet("A", law="may_newman_yin")
    sim.set_load(120 * mvs.MMHG)
    assert sim.settle().converged
    closed = sim.snapshot()
print(closed)
closed.save("closed.h5")
assert pickle.loads(pickle.dumps(closed)).hash == closed.hash
worst = closed.chords().sorted("tension", reverse=True)[0]
print(f"{worst['name']} to {worst['head']} carries {worst['tension']:.2f} N")
print(f"99 % of the tissue strains less than {closed.measures.leaflet_strain_p99:.1%}")
members = opened.ensemble(120 * mvs.MMHG, members=3)
print(f"shapes differ by {members.summary.node_rms * 1e6:.1f} um RMS")
with ThreadPoolExecutor(2) as pool:
    rings = mvs.sweep(opened, [("ring", {"size": [30e-3, 34e-3]})], pool)
print(rings)
