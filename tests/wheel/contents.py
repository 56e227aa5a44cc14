"""Checks the contents of a wheel: contents.py WHEEL.

The files are those of the package, the library, the drivers and the command; no other library is
needed but those of every Linux, none is GPL, and only the names of our interfaces are exported. Prints
one line for each fault; the exit code is 1 if there is one. Needs readelf and nm (binutils).
"""

import os
import re
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

LARGEST = 5_000_000
"""Bytes. It has 3.8 million: 2.5 the library with HDF5, the rest the module, the command and the drivers.
OpenSSL's libcrypto alone would add 2 million, all that Debian's HDF5 needs 16."""

SYSTEM = re.compile(r"(libc|libm|libdl|libpthread|librt|libgcc_s|libstdc\+\+|ld-linux[-\w]*)\.so\.\d+")
"""Libraries that a manylinux system has; NumPy needs libstdc++ and libgcc_s as well."""

EXPORTED = {
    "library": re.compile(r"mvs_\w+"),
    "driver": re.compile(r"mvs_driver_\w+"),
    "module": re.compile(r"PyInit__core|_Z.*"),
}
"""The names that others can see; in the module the compiler adds
templates and types of C++ (_Z), none of which C libraries such as HDF5 have."""

GPL = [b"GNU General Public License", b"CHOLMOD error", b"CHOLMOD warning", b"SuiteSparse", b"libgsl", b"FFTW"]
"""Texts in the programs of GPL libraries that could have been linked statically."""

LICENCES = {"LICENSE", "hdf5.txt", "hdf5-lbnl.txt", "libeigen3-dev.txt", "nlohmann-json3-dev.txt",
            "libcli11-dev.txt", "zlib1g-dev.txt", "pybind11.txt"}


def kind_of(name: str) -> str:
    """The kind of a program or library in the wheel; empty if there should be none of that name."""
    if re.fullmatch(r"mvs/libmvs\.so\.\d+\.\d+", name):
        return "library"
    if re.fullmatch(r"mvs/_core\.[-\w]+\.so", name):
        return "module"
    if re.fullmatch(r"mvs/mvs/drivers/[a-z0-9_]+\.so", name):
        return "driver"
    return "command" if name == "mvs/bin/mvs" else ""


def output(*command: str) -> str:
    """The output of a program."""
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def needed(path: Path) -> set[str]:
    """The libraries that a program or library names."""
    return set(re.findall(r"\(NEEDED\)[^\[]*\[([^\]]+)\]", output("readelf", "-dW", str(path))))


def exported(path: Path) -> set[str]:
    """The names that others can use."""
    lines = output("nm", "-D", "--defined-only", str(path)).splitlines()
    return {line.split()[-1].split("@")[0] for line in lines}


def faults_of_program(name: str, path: Path, ours: set[str]) -> list[str]:
    """Faults of a program or library: a foreign one, foreign needs, foreign names, GPL code."""
    kind = kind_of(name)
    if not kind:
        return [f"{name} is bundled: the wheel needs it, or libmvs links a library of the system"]
    found = [f"{name} needs {library}, which an empty system does not have"
             for library in sorted(needed(path)) if library not in ours and not SYSTEM.fullmatch(library)]
    if kind in EXPORTED:
        names = exported(path)
        wrong = sorted(each for each in names if not EXPORTED[kind].fullmatch(each))
        if wrong or not names:
            found.append(f"{name} exports {', '.join(wrong[:5]) or 'nothing'}")
    elif not os.access(path, os.X_OK):
        found.append(f"{name} may not be executed")
    content = path.read_bytes()
    return found + [f"{name} contains {text.decode()}: GPL code?" for text in GPL if text in content]


def faults_of_names(names: list[str]) -> list[str]:
    """Files that the wheel lacks."""
    drivers = {path.parent.name for path in ROOT.glob("haptic_drivers/*/CMakeLists.txt")}
    wanted = {f"mvs/mvs/drivers/{driver}.so" for driver in drivers}
    wanted |= {"mvs/bin/mvs", "mvs_command.py", "mvs/py.typed"}
    wanted |= {f"mvs/{path.relative_to(ROOT / 'bindings/python/mvs')}"
               for path in (ROOT / "bindings/python/mvs").rglob("*.py*") if path.suffix in {".py", ".pyi"}}
    found = [f"{name} is missing" for name in sorted(wanted - set(names))]
    for kind in ("library", "module"):
        if not any(kind_of(name) == kind for name in names):
            found.append(f"the {kind} is missing")
    licences = {Path(name).name for name in names if ".dist-info/licenses/" in name}
    return found + [f"the licence {name} is missing" for name in sorted(LICENCES - licences)]


def faults(wheel: Path) -> list[str]:
    """One sentence for each fault."""
    size = wheel.stat().st_size
    print(f"{wheel.name}: {size / 1e6:.2f} MB")
    found = [] if size <= LARGEST else [f"it has {size} bytes, more than {LARGEST}: is a library bundled?"]
    if "-manylinux" not in wheel.name:
        found.append("its name does not say on which Linux it runs: auditwheel repair")
    with tempfile.TemporaryDirectory() as folder, zipfile.ZipFile(wheel) as archive:
        names = [each.filename for each in archive.infolist() if not each.is_dir()]
        found += faults_of_names(names)
        programs = {}
        for each in archive.infolist():
            path = Path(archive.extract(each, folder))
            if path.is_file() and path.read_bytes()[:4] == b"\x7fELF":
                path.chmod(each.external_attr >> 16)  # zipfile leaves it out
                programs[each.filename] = path
        ours = {Path(name).name for name in programs}
        foreign = sorted(name for name in programs if not kind_of(name))
        print(f"{len(names)} files, {len(programs)} programs and libraries, {len(foreign)} of others bundled")
        for name, path in sorted(programs.items()):
            print(f"  {path.stat().st_size / 1e6:5.2f} MB {name} needs {' '.join(sorted(needed(path)))}")
            found += faults_of_program(name, path, ours)
    return found


if __name__ == "__main__":
    problems = faults(Path(sys.argv[1]))
    print("\n".join(problems) or "the wheel contains what it should")
    sys.exit(1 if problems else 0)
