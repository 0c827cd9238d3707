"""Numbers of names, under which units of writing take turns."""

from hashlib import blake2b


def number_of(kind: str, name: str) -> int:
    """Return a number of 64 bits with a sign for a name."""
    digest = blake2b(f"{kind} {name}".encode("utf-8", "surrogatepass"), digest_size=8)
    return int.from_bytes(digest.digest(), signed=True)
