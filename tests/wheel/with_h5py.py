"""mvs and h5py in one process, each with an HDF5 of its own: with_h5py.py FIRST SECOND.

FIRST and SECOND are the order of imports. Each saves and loads files before and after the other one,
and h5py reads what mvs has saved. The exit code is 1 if something fails.
"""

import importlib
import sys

import numpy as np

for name in sys.argv[1:3]:
    importlib.import_module(name)

import h5py
import mvs


def closed_valve() -> mvs.Snapshot:
    with mvs.Simulator() as sim:
        sim.generate()
        sim.set_load(mvs.SYSTOLE_PA)
        sim.settle()
        return sim.snapshot()


def h5py_works(path: str) -> None:
    values = np.arange(1000.0)
    with h5py.File(path, "w") as file:
        file.create_dataset("values", data=values, compression="gzip")
    with h5py.File(path) as file:
        assert (file["values"][:] == values).all()


def mvs_works(closed: mvs.Snapshot, path: str) -> None:
    closed.save(path)
    with mvs.Simulator() as sim:
        sim.load(path)
        assert sim.snapshot().hash == closed.hash


if __name__ == "__main__":
    valve = closed_valve()
    for turn in range(3):
        h5py_works(f"h5py{turn}.h5")
        mvs_works(valve, f"mvs{turn}.h5")
    with h5py.File("mvs0.h5") as both:
        mvs_works(valve, "open.h5")  # while h5py has a file open
        groups = list(both)
        assert groups, "h5py finds nothing in a file of mvs"
    print(f"mvs beside h5py with HDF5 {h5py.version.hdf5_version}, {sys.argv[1]} imported first: both work")
