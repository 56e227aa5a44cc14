"""Compressed voxels of NRRD and MetaImage files: their checksums, which ITK does not compare."""

from __future__ import annotations

import zlib
from pathlib import Path
from typing import Optional

from mvs import FormatError

CHUNK = 1 << 22
LONGEST_HEADER = 1 << 20


def check_packed(name: str) -> None:
    """Refuses a NRRD file (encoding gzip) or MetaImage (CompressedData) whose compressed voxels are damaged.

    Files whose voxels are in several others are left to ITK.
    """
    lower = name.lower()
    find = _nrrd_stream if lower.endswith((".nrrd", ".nhdr")) else _meta_stream if lower.endswith((".mha", ".mhd")) else None
    found = find(Path(name)) if find else None
    if found is None or not found[0].is_file():
        return
    path, offset = found
    unpack = zlib.decompressobj(47)  # a header of gzip or of zlib
    try:
        with open(path, "rb") as file:
            file.seek(offset)
            while not unpack.eof:
                chunk = file.read(CHUNK)
                if not chunk:
                    raise FormatError(f"{path}: its compressed voxels are cut short: copy or export it again", "path")
                unpack.decompress(chunk)
    except zlib.error as error:
        raise FormatError(f"{path}: its compressed voxels are damaged ({error}): copy or export it again", "path") from error


def _nrrd_stream(path: Path) -> Optional[tuple[Path, int]]:
    """File and offset of the gzip stream of a NRRD file (teem.sourceforge.net/nrrd/format.html); None: another encoding."""
    head = _head(path)
    ends = [(head.find(end), len(end)) for end in (b"\n\n", b"\r\n\r\n") if end in head]
    end, wide = min(ends) if ends else (len(head), 0)
    fields = _fields(head[:end], ":")
    if fields.get("encoding") not in ("gzip", "gz") or any(fields.get(skip, "0") != "0" for skip in ("line skip", "byte skip")):
        return None
    apart = fields.get("data file") or fields.get("datafile")
    if apart:
        return path.parent / apart, 0
    return (path, end + wide) if ends else None


def _meta_stream(path: Path) -> Optional[tuple[Path, int]]:
    """File and offset of the zlib stream of a MetaImage; None: it is not compressed."""
    head = _head(path)
    begin = head.find(b"ElementDataFile")
    end = head.find(b"\n", begin)
    if begin < 0 or end < 0:
        return None
    fields = _fields(head[:end], "=")
    if fields.get("compresseddata", "").lower() != "true":
        return None
    apart = fields["elementdatafile"]
    return (path, end + 1) if apart.upper() == "LOCAL" else (path.parent / apart, 0)


def _head(path: Path) -> bytes:
    with open(path, "rb") as file:
        return file.read(LONGEST_HEADER)


def _fields(head: bytes, sign: str) -> dict[str, str]:
    """Lines "key: value" or "key = value" by their key in lower case."""
    rows = (line.split(sign, 1) for line in head.decode("latin-1").splitlines() if sign in line and line[0] != "#")
    return {key.strip().lower(): value.strip() for key, value in rows}
