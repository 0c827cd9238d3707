"""Authentication of requests: whether each is let in, and whose it is."""

import logging
import time
from typing import Final

from fastapi import Request
from fastapi.concurrency import run_in_threadpool

from jointplay.records.bounded_dict import BoundedDict
from jointplay.service.access import Caller
from jointplay.service.access.hosts import require_own_host
from jointplay.service.access.link_secret import LinkSecret
from jointplay.service.access.rates import Rates
from jointplay.service.access.signed import SIGNED, Link
from jointplay.service.problems import RequestRefused, kinds
from jointplay.service.vital import VitalThreads
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import KeyNotFound, Unavailable
from jointplay.storage.catalogue.keys import Key, id_in
from jointplay.storage.settings import Settings

_REMEMBERED: Final = 10.0
"""Seconds after which a key is looked up again: a revoked one opens for so long."""
_UNKNOWN: Final = 2.0
"""Seconds for which a key that is not there stays unknown; a new one has an id of its own."""
_MOST: Final = 1024
_USE_PERIOD: Final = 60.0  # s; how exactly the last use of a key is known
_BEARER: Final = "bearer "
_OF_WORKERS: Final = "/v1/worker/"
"""Begins the paths at which workers claim and hold blocks, as often as computing needs it."""
_log = logging.getLogger(__name__)


class Authentication:
    """Looks at the key of every request, if the service asks for one."""

    def __init__(self, catalogue: Catalogue, settings: Settings, vital: VitalThreads) -> None:
        self._catalogue, self._vital = catalogue, vital
        self.link_secret = LinkSecret(settings.object_store)
        self._asks = settings.keys == "required"
        self._hosts = settings.host_names
        self._rates = Rates(settings.rate, settings.redis_url)
        self._known: BoundedDict[str, tuple[Key, float]] = BoundedDict(_MOST)
        self._unknown: BoundedDict[str, float] = BoundedDict(_MOST)

    async def caller(self, request: Request) -> Caller:
        """Return who asks, or refuse.

        With 401 without a key that opens, 403 to a foreign page, 429 to whoever asks too often.
        """
        if not self._asks:
            require_own_host(request, self._hosts)
            return Caller()
        link = request.scope.get(SIGNED)
        if link is not None:
            return await self._of_link(link)
        given = request.headers.get("authorization", "")
        text = given[len(_BEARER) :].strip() if given.lower().startswith(_BEARER) else ""
        name = id_in(text)
        key = None if name is None else await self._key(name)
        if key is None or not key.is_of(text) or not key.lives(self._catalogue.clock()):
            raise RequestRefused(
                kinds.KEY_MISSING,
                "This service asks for a key that is valid: Authorization: Bearer jp_...",
                headers={"WWW-Authenticate": 'Bearer realm="jointplay"'},
            )
        caller = Caller(key.owner, key.scopes, key.id)
        if not (request.url.path.startswith(_OF_WORKERS) and caller.may("worker")):
            await self._rates.count(key.owner)
        return caller

    async def still_open_to(self, caller: Caller) -> bool:
        """Tell whether the key of a request that is still answered is valid.

        While the catalogue is away it is what it was: there is nothing then that it could open.
        """
        if not caller.key:
            return True
        try:
            key = await self._key(caller.key)
            return key is not None and key.lives(self._catalogue.clock())
        except Unavailable:
            return True

    async def _of_link(self, link: Link) -> Caller:
        key = await self._key(link.key)
        now = self._catalogue.clock()
        lives = key is not None and key.lives(now)
        secret = (self.link_secret.known or await self._secret_of_links()) if lives else None
        if key is None or secret is None or not link.is_signed_with(secret, key, now):
            sentence = "This link has expired, or its key was revoked, or it was changed."
            challenge = {"WWW-Authenticate": 'Bearer realm="jointplay"'}
            raise RequestRefused(kinds.KEY_MISSING, sentence, headers=challenge)
        await self._rates.count(key.owner)
        return Caller(key.owner, key.scopes & {"results:read", "admin"}, key.id)

    async def _secret_of_links(self) -> bytes | None:
        return await run_in_threadpool(self.link_secret.read)

    async def _key(self, name: str) -> Key | None:
        now = time.monotonic()
        if now < self._unknown.get(name, 0.0):
            return None
        known = self._known.get(name)
        if known is not None and now < known[1]:
            return known[0]
        try:
            key = await self._vital.run(self._looked_up, name)
        except KeyNotFound:
            self._known.pop(name, None)
            self._unknown[name] = now + _UNKNOWN
            return None
        self._known[name] = key, now + _REMEMBERED
        return key

    def _looked_up(self, name: str) -> Key:
        key = self._catalogue.key(name)
        if key.last_used is None or key.last_used < self._catalogue.clock() - _USE_PERIOD:
            try:
                self._catalogue.note_use_of_key(name)
            except Unavailable as fault:
                _log.debug("the use of key %s is not noted: %s", name, fault)
        return key
