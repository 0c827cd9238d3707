"""The bytes of an uncompressed zip (PKWARE APPNOTE 6.3), made piece by piece.

Written here because zipfile needs a file to seek in, which an object store is not, and takes ten
times as long for the hundreds of small entries. Equal entries give equal bytes: there are no
times and no names of systems in them.
"""

import struct
from collections.abc import Iterable, Iterator
from typing import Final
from zlib import crc32

COMMENT: Final = struct.Struct("<17s4s")
"""At the end of a packed file: `MARK`, and a CRC-32 that begins with the `digest` that `pack` is
given and goes over all from the directory on."""
MARK: Final = b"jointplay results"
"""Name of the form: entries are uncompressed and right behind the names of their headers."""
LOCAL: Final = struct.Struct("<4s5H3I2H")
CENTRAL: Final = struct.Struct("<4s6H3I5H2I")
END: Final = struct.Struct("<4s4H2IH")
END_64: Final = struct.Struct("<4sQ2H2I4Q")
LOCATOR: Final = struct.Struct("<4sIQI")
_VERSION: Final = 45  # the first with zip64
_UTF_8: Final = 0x800
_DATE: Final = 0x21  # 1980-01-01, the first there is
_LOCAL_BEGIN: Final = struct.pack("<4sH", b"PK\3\4", _VERSION)
_CENTRAL_BEGIN: Final = struct.pack("<4s2H", b"PK\1\2", _VERSION, _VERSION)
_ABOUT: Final = struct.Struct("<4H3IH")
_LOCATION: Final = struct.Struct("<4H2I")
_SHORT: Final = 2**16 - 1
LONG: Final = 2**32 - 1


def pack(entries: Iterable[tuple[str, bytes]], digest: bytes = b"") -> Iterator[bytes]:
    """Give the bytes of a zip of entries, in their order; memory is bounded by the largest.

    Parameters
    ----------
    entries
        Key and content of each, less than 4 GiB; a key comes once.
    digest
        Of what is stored: begins the checksum at the end, so that a file is not taken for one of
        anything else.
    """
    central: list[bytes] = []
    offset = 0
    for key, content in entries:
        name = key.encode()
        about = _about(name, crc32(content), len(content))
        yield _local(about, name)
        yield content
        far = struct.pack("<2HQ", 1, 8, offset) if offset >= LONG else b""
        location = _LOCATION.pack(len(far), 0, 0, 0, 0, min(offset, LONG))
        central.append(b"".join((_CENTRAL_BEGIN, about, location, name, far)))
        offset += LOCAL.size + len(name) + len(content)
    end = b"".join(central)
    count, length = len(central), len(end)
    if count >= _SHORT or length >= LONG or offset >= LONG:
        counts = count, count, length, offset
        end += END_64.pack(b"PK\6\6", END_64.size - 12, _VERSION, _VERSION, 0, 0, *counts)
        end += LOCATOR.pack(b"PK\6\7", 0, offset + length, 1)
    few = min(count, _SHORT)
    end += END.pack(b"PK\5\6", 0, 0, few, few, min(length, LONG), min(offset, LONG), COMMENT.size)
    yield end
    yield comment(end, digest)


def local_header(name: bytes, crc: int, size: int) -> bytes:
    """Return what stands before the content of an entry."""
    return _local(_about(name, crc, size), name)


def comment(end: bytes, digest: bytes) -> bytes:
    """Return the comment of a packed file whose directory and end records are these."""
    return COMMENT.pack(MARK, crc32(end, crc32(digest)).to_bytes(4, "little"))


def _local(about: bytes, name: bytes) -> bytes:
    return b"".join((_LOCAL_BEGIN, about, b"\0\0", name))


def _about(name: bytes, crc: int, size: int) -> bytes:
    """Return what both headers of an entry have in common."""
    return _ABOUT.pack(_UTF_8, 0, 0, _DATE, crc, size, size, len(name))
