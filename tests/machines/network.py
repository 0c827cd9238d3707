"""A network of machines on this one: network namespaces whose cables end in one bridge.

The bridge is in the namespace of this process, which must be no other's. Everything goes with the
process and those that it has started.
"""

import ctypes
import os
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager

_NET = "10.77.0"
_NETWORK_NAMESPACE = 0x40000000  # CLONE_NEWNET
_libc = ctypes.CDLL(None, use_errno=True)


def _ip(*words: str) -> None:
    subprocess.run(["ip", *words], check=True)


def make_bridge() -> None:
    """Make the bridge, and the address of this process on it."""
    _ip("link", "set", "lo", "up")
    _ip("link", "add", "bridge", "type", "bridge")
    _ip("address", "add", f"{_NET}.1/24", "dev", "bridge")
    _ip("link", "set", "bridge", "up")


class Port:
    """A network namespace with one address, and its cable to the bridge."""

    def __init__(self, name: str, number: int) -> None:
        self.address = f"{_NET}.{number}"
        self._name = name
        here = os.open("/proc/self/ns/net", os.O_RDONLY)
        try:
            _check(_libc.unshare(_NETWORK_NAMESPACE))
            self._there = os.open("/proc/thread-self/ns/net", os.O_RDONLY)
        finally:
            _check(_libc.setns(here, _NETWORK_NAMESPACE))
            os.close(here)
        peer = f"/proc/{os.getpid()}/fd/{self._there}"
        _ip("link", "add", name, "type", "veth", "peer", "name", "eth0", "netns", peer)
        self.join()
        with self.inside():
            _ip("link", "set", "lo", "up")
            _ip("address", "add", f"{self.address}/24", "dev", "eth0")
        self.plug_in()
        _ip("link", "set", name, "up")

    @contextmanager
    def inside(self) -> Iterator[None]:
        """Have this thread, its sockets and the processes that it starts be in the namespace."""
        here = os.open("/proc/thread-self/ns/net", os.O_RDONLY)
        _check(_libc.setns(self._there, _NETWORK_NAMESPACE))
        try:
            yield
        finally:
            _check(_libc.setns(here, _NETWORK_NAMESPACE))
            os.close(here)

    def forbid(self, address: str) -> None:
        """Let nothing from here reach an address."""
        with self.inside():
            _ip("route", "add", "prohibit", address)

    def pull_out(self) -> None:
        """Take the interface down: whoever sends is told so at once."""
        with self.inside():
            _ip("link", "set", "eth0", "down")

    def plug_in(self) -> None:
        """Take the interface up."""
        with self.inside():
            _ip("link", "set", "eth0", "up")

    def leave(self) -> None:
        """Take the cable off the bridge: what is sent is swallowed, and nobody is told."""
        _ip("link", "set", self._name, "nomaster")

    def join(self) -> None:
        """Put the cable back."""
        _ip("link", "set", self._name, "master", "bridge")


def _check(result: int) -> None:
    if result:
        raise OSError(ctypes.get_errno(), os.strerror(ctypes.get_errno()))
