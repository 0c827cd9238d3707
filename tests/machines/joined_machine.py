"""A machine that has joined a service: workers that know its address and a key, and no more."""

from pathlib import Path

from tests.machines.machine import Machine
from tests.machines.network import Port
from tests.seaweedfs_server import KEYS


class JoinedMachine(Machine):
    """`jointplay worker --join`, whose network has no way to the servers.

    Parameters
    ----------
    folder
        Its name is the machine's; it is made.
    url
        Address of the service, encrypted.
    authority
        File with the certificate of the authority that the machine trusts.
    key
        With the scope `worker`.
    servers
        Address that it cannot reach.
    """

    def __init__(
        self,
        folder: Path,
        port: Port,
        workers: int,
        *,
        url: str,
        authority: Path,
        key: str,
        servers: str,
    ) -> None:
        super().__init__(folder, port, workers, {"SSL_CERT_FILE": str(authority)})
        port.forbid(servers)
        self._joins = url
        self._key_file = folder / "worker.key"
        self._key_file.write_text(f"{key}\n")

    def kept(self) -> dict[str, list[str]]:
        """Return the workers alone."""
        joins = ["--join", self._joins, "--key-file", str(self._key_file)]
        return {"worker": ["jointplay", "worker", *joins, "--processes", str(self._workers)]}

    def environment(self) -> dict[str, str]:
        """Return the variables without what others know of the servers."""
        known = super().environment()
        return {name: value for name, value in known.items() if name not in KEYS}
