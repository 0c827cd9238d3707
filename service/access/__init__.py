"""Callers of the service: their keys, scopes and owners, and the pages of a browser that may ask.

A service that listens on its own machine only asks for no key, but looks at where a request was
sent to and which page sent it. Any other asks for a key, with one header:
``Authorization: Bearer jp_ID_SECRET``.
"""

from dataclasses import dataclass
from typing import Annotated, Any, Final

from fastapi import Depends, Request

from jointplay.records.log_lines import note
from jointplay.service.owners import OWNER, SHARES
from jointplay.service.problems import RequestRefused, kinds

_READING: Final = frozenset({"GET", "HEAD"})


@dataclass(frozen=True)
class Caller:
    """Whoever sent a request.

    `owner` is empty, and nothing is asked, where the service wants no keys.
    """

    owner: str = ""
    scopes: frozenset[str] = frozenset({"admin"})
    key: str = ""

    @property
    def sees_all(self) -> bool:
        """Whether the caller sees the jobs of all owners."""
        return "admin" in self.scopes

    def may(self, scope: str) -> bool:
        """Whether a key is for this."""
        return self.sees_all or scope in self.scopes

    def sees(self, owner: str) -> bool:
        """Whether the caller sees what belongs to an owner."""
        return self.sees_all or owner == self.owner


async def _caller(request: Request) -> Caller:
    found: Caller = await request.app.state.authentication.caller(request)
    if found.key:
        note(key=found.key)  # its id: nobody learns its secret from a log
    if found.owner:
        OWNER.set(found.owner)
        SHARES.enter(request.scope, found.owner)
    return found


CallerDependency = Annotated[Caller, Depends(_caller)]


def needs(reading: str, writing: str | None = None) -> Any:
    """Return the dependency on a key's scope for reading, and for anything else."""

    async def checked(request: Request, caller: CallerDependency) -> None:
        scope = reading if writing is None or request.method in _READING else writing
        if not caller.may(scope):
            raise RequestRefused(
                kinds.SCOPE_MISSING,
                f"This needs a key for {scope}; yours is for {', '.join(sorted(caller.scopes))}.",
            )

    return Depends(checked)
