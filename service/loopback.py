"""Addresses that no other machine can reach."""

import ipaddress
from contextlib import suppress


def is_loopback(host: str) -> bool:
    """Whether a name or an address is that of this machine to itself."""
    if host == "localhost" or host.endswith(".localhost"):
        return True
    with suppress(ValueError):
        return ipaddress.ip_address(host.strip("[]")).is_loopback
    return False
