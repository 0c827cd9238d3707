"""Room for files that workers send, kept for them before they are on their way."""

import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from threading import Lock
from typing import Annotated, Final

from jointplay.records.bounded_dict import BoundedDict
from jointplay.service.dependencies import of_the_application
from jointplay.service.problems import RequestRefused, kinds
from jointplay.storage.catalogue.records import Block
from jointplay.storage.errors import CorruptStore
from jointplay.storage.settings import Settings

_COPIES: Final = 2
"""A file arrives beside its place, and is then stored there."""
_REMEMBERED: Final = 4096
"""Attempts of which it is known how much they sent."""
_SMALL: Final = 2**20
"""Bytes that a file has at least which is put elsewhere; of smaller ones not many are offered."""
_Attempt = tuple[str, int]
_Offers = dict[str, tuple[float, int]]
"""Until when each file was offered a place, and its bytes, by its digest."""


class Kept:
    """Room that is kept for one file; what was written of it is no longer free anyway."""

    def __init__(self, size: int) -> None:
        self.size = size

    def wrote(self, size: int) -> None:
        """Note that so many bytes take room on the disk."""
        self.size = max(self.size - size, 0)


class Uploads:
    """Files on their way to this API."""

    def __init__(self) -> None:
        self._turn = Lock()
        """Held for moments, by the loop of the API, too."""
        self._counting = Lock()
        """Held by threads while they look at what is stored."""
        self._kept: set[Kept] = set()
        self._arriving: Counter[_Attempt] = Counter()
        self._sent: BoundedDict[_Attempt, int] = BoundedDict(_REMEMBERED)
        self._offered: BoundedDict[_Attempt, _Offers] = BoundedDict(_REMEMBERED)

    @contextmanager
    def room(self, settings: Settings, size: int) -> Iterator[Kept]:
        """Keep room for a file while it arrives and is stored.

        Raises
        ------
        RequestRefused
            There is none.
        """
        kept = Kept(_COPIES * size)
        with self._turn:
            if settings.room() - sum(one.size for one in self._kept) < kept.size:
                sentence = "The disk of the service is full but for a reserve, and other uploads."
                raise RequestRefused(kinds.DISK_FULL, sentence, headers={"Retry-After": "30"})
            self._kept.add(kept)
        try:
            yield kept
        finally:
            with self._turn:
                self._kept.discard(kept)

    @contextmanager
    def of_attempt(
        self, held: Block, size: int, most: int, stored: Callable[[], int]
    ) -> Iterator[None]:
        """Count a file among those of its attempt while it arrives.

        Parameters
        ----------
        held
            Block, as the attempt holds it.
        size
            Bytes of the file.
        most
            Bytes that the attempt may have.
        stored
            Looks how many are stored; called where so many were sent that these may be too many.

        Raises
        ------
        CorruptStore
            There would be more.
        """
        attempt = held.id, held.attempt
        with self._turn:
            may_be_too_many = self._sent.get(attempt, 0) + size > most
        if may_be_too_many:
            with self._counting:
                self._count(attempt, stored)
        with self._turn:
            sent = self._sent.get(attempt, 0)
            if sent + size > most:
                raise CorruptStore(
                    f"the attempt has {sent} bytes here, and with {size} more than the {most} that"
                    " its job may need"
                )
            self._sent[attempt] = sent + size
            self._arriving[attempt] += size
        try:
            yield
        finally:
            with self._turn:
                self._arriving[attempt] -= size
                self._arriving += Counter()  # forgets those without any

    def _count(self, attempt: _Attempt, stored: Callable[[], int]) -> None:
        """Note what is stored of an attempt, with what arrives meanwhile."""
        with self._turn:
            before, arriving = self._sent.get(attempt, 0), self._arriving[attempt]
        found = stored()
        with self._turn:
            begun = max(self._sent.get(attempt, 0) - before, 0)
            self._sent[attempt] = found + arriving + begun

    def offer(self, held: Block, digest: str, size: int, most: int, seconds: float) -> None:
        """Count a file that its attempt may put elsewhere within some seconds.

        Before it puts any it may ask for many. The parameters are as for `of_attempt`.

        Raises
        ------
        CorruptStore
            These would be more bytes than it may have.
        """
        now, attempt = time.monotonic(), (held.id, held.attempt)
        with self._turn:
            known = self._offered.get(attempt, {})
            offers = {one: about for one, about in known.items() if about[0] > now}
            offers[digest] = now + seconds, max(size, _SMALL)
            self._offered[attempt] = offers
            asked = sum(of_one for _, of_one in offers.values())
        if asked > most:
            raise CorruptStore(
                f"the attempt asks where to put {asked} bytes, more than the {most} that its job"
                " may need"
            )


UploadsDependency = Annotated[Uploads, of_the_application("uploads")]
