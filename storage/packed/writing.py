"""The bytes of an uncompressed zip (PKWARE APPNOTE 6.3), made piece by piece.

Written here because zipfile needs a file to seek in, which an object store is not, and takes ten
times as long for the hundreds of small entries. Equal entries give equal bytes: there are no
times and no names of systems in them.
"""

import struct
from collections.abc import Iterable, Iterator
from typing import Final
from zlib import crc32

COMMENT: Final = b"jointplay results"
"""At the end of a packed file: its entries begin right behind their local headers' names."""

LOCAL: Final = struct.Struct("<4s5H3I2H")
CENTRAL: Final = struct.Struct("<4s6H3I5H2I")
END: Final = struct.Struct("<4s4H2IH")
END_64: Final = struct.Struct("<4sQ2H2I4Q")
LOCATOR: Final = struct.Struct("<4sIQI")
_VERSION: Final = 45  # the first with zip64
_UTF_8: Final = 0x800
_DATE: Final = 0x21  # 1980-01-01, the first there is
_SHORT: Final = 2**16 - 1
LONG: Final = 2**32 - 1


def pack(entries: Iterable[tuple[str, bytes]]) -> Iterator[bytes]:
    """Give the bytes of a zip of entries, in their order; memory is bounded by the largest.

    Parameters
    ----------
    entries
        Key and content of each, less than 4 GiB; a key comes once.
    """
    central: list[bytes] = []
    offset = 0
    for key, content in entries:
        name, crc, size = key.encode(), crc32(content), len(content)
        about = (_UTF_8, 0, 0, _DATE, crc, size, size, len(name))
        yield LOCAL.pack(b"PK\3\4", _VERSION, *about, 0) + name
        yield content
        far = struct.pack("<2HQ", 1, 8, offset) if offset >= LONG else b""
        central.append(
            CENTRAL.pack(
                b"PK\1\2", _VERSION, _VERSION, *about, len(far), 0, 0, 0, 0, min(offset, LONG)
            )
            + name
            + far
        )
        offset += LOCAL.size + len(name) + size
    directory = b"".join(central)
    yield directory
    count, length = len(central), len(directory)
    if count >= _SHORT or length >= LONG or offset >= LONG:
        counts = count, count, length, offset
        yield END_64.pack(b"PK\6\6", END_64.size - 12, _VERSION, _VERSION, 0, 0, *counts)
        yield LOCATOR.pack(b"PK\6\7", 0, offset + length, 1)
    few = min(count, _SHORT)
    yield END.pack(b"PK\5\6", 0, 0, few, few, min(length, LONG), min(offset, LONG), len(COMMENT))
    yield COMMENT
