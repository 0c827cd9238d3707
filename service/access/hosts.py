"""Where a request was sent to, and by which page, where no key tells who asks.

A page of the web can have a browser send requests to a service on this machine, as the page's own
name may be given this machine's address (DNS rebinding). That name is then in Host, and in Origin.
A page of another program on this machine has another port in Origin than in Host.
"""

import ipaddress
import re
from collections.abc import Collection
from contextlib import suppress
from typing import Final

from fastapi import Request

from jointplay.service.loopback import is_loopback
from jointplay.service.problems import RequestRefused, clipped, kinds

_HOST: Final = re.compile(r"(?:\[([0-9a-f:.]+)\]|([^][:/?#@\s]+))(?::\d{0,5})?")
"""Name or address, and port, of a Host header and of an Origin behind its scheme (RFC 9110)."""


def require_own_host(request: Request, names: Collection[str]) -> None:
    """Refuse what was sent to a foreign name or by a foreign page; `names` are further own ones.

    An address in place of a name was looked up by nobody. Pages are the service's own, or of a
    further name at any port, which a proxy may have left out of Host.
    """
    host, origin = request.headers.get("host", ""), request.headers.get("origin")
    own = _name_in(host)
    if not (own in names or is_loopback(own) or _is_address(own)):
        raise _foreign("Host", host)
    if origin is not None:
        page = origin.partition("://")[2]  # a browser writes both with a port, or both without
        if not (page.lower() == host.lower() or _name_in(page) in names):
            raise _foreign("Origin", origin)


def _foreign(header: str, given: str) -> RequestRefused:
    sentence = f"{header} is {clipped(given)!r}, which is no name of this service."
    return RequestRefused(kinds.FOREIGN_HOST, sentence)


def _name_in(given: str) -> str:
    """Return the name or address of a whole host, in small letters; empty if it is none."""
    found = _HOST.fullmatch(given.lower())
    return "" if found is None else found[1] or found[2]


def _is_address(name: str) -> bool:
    with suppress(ValueError):
        return bool(ipaddress.ip_address(name))
    return False
