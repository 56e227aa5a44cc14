"""Draws session.png: four moments of the headless session of examples/phantom.c.

Run: python3 examples/pictures/session.py [build/release/examples/phantom]
"""

import struct
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
RECORDING = ROOT / "haptic_drivers/replay/trajectories/session.txt"
# A2 pulled; P2 pushed; a strut chord felt, from the anterior side; the dilated annulus leaks
MOMENTS = (3.0, 8.5, 12.5, 16.0)
KEYS = ("0:a 5.5:3 11:5 " + "11.1:h " * 12 + "11.1:k " * 3 + "13.1:l " * 12 + "13.1:j " * 4
        + "13.2:6 15.1:d 15.2:c")
EVERY = 0.5  # s


def frames(program: str, folder: str) -> None:
    subprocess.run([program, "--driver", "replay", "--script", RECORDING, "--headless",
                    "--dt", "0.002", "--keys", KEYS, "--seconds", "16.1", "--frames", folder,
                    "--every", str(EVERY), "--out", f"{folder}/phantom"], check=True)


def rows(path: Path) -> tuple[int, list[bytes]]:
    """Width and rows of a PPM picture."""
    _, size, _, data = path.read_bytes().split(b"\n", 3)
    width, height = map(int, size.split())
    return width, [data[3 * width * y : 3 * width * (y + 1)] for y in range(height)]


def png(width: int, lines: list[bytes]) -> bytes:
    def chunk(kind: bytes, data: bytes) -> bytes:
        crc = struct.pack(">I", zlib.crc32(kind + data))
        return struct.pack(">I", len(data)) + kind + data + crc

    header = struct.pack(">IIBBBBB", width, len(lines), 8, 2, 0, 0, 0)
    # PNG filter 2: each row minus the row above, a third of the size
    before, coded = bytes(3 * width), []
    for line in lines:
        coded.append(b"\2" + bytes((a - b) & 255 for a, b in zip(line, before)))
        before = line
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header)
            + chunk(b"IDAT", zlib.compress(b"".join(coded), 9)) + chunk(b"IEND", b""))


def main() -> None:
    program = sys.argv[1] if len(sys.argv) > 1 else str(ROOT / "build/release/examples/phantom")
    with tempfile.TemporaryDirectory() as folder:
        frames(program, folder)
        shown = [rows(Path(folder) / f"frame_{round(t / EVERY):04d}.ppm") for t in MOMENTS]
    width = shown[0][0]
    (_, a), (_, b), (_, c), (_, d) = shown
    lines = [x + y for x, y in zip(a, b)] + [x + y for x, y in zip(c, d)]
    Path(__file__).with_name("session.png").write_bytes(png(2 * width, lines))


if __name__ == "__main__":
    main()
