"""Room for files that workers send, kept for them before they are on their way."""

from collections import Counter, OrderedDict
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from threading import Lock
from typing import Annotated, Final

from jointplay.service.dependencies import of_the_application
from jointplay.service.problems import RequestRefused, kinds
from jointplay.storage.catalogue.records import Block
from jointplay.storage.errors import CorruptStore
from jointplay.storage.settings import Settings

_COPIES: Final = 2
"""A file arrives beside its place, and is then stored there."""
_REMEMBERED: Final = 4096
"""Attempts of which it is known how much they sent."""
_Attempt = tuple[str, int]


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
        self._kept: set[Kept] = set()
        self._arriving: Counter[_Attempt] = Counter()
        self._sent: OrderedDict[_Attempt, int] = OrderedDict()

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
            sent = self._sent.pop(attempt, 0)
            if sent + size > most:
                sent = stored() + self._arriving[attempt]
            self._sent[attempt] = sent
            if sent + size > most:
                raise CorruptStore(
                    f"the attempt has {sent} bytes here, and with {size} more than the {most} that"
                    " its job may need"
                )
            self._sent[attempt] = sent + size
            self._arriving[attempt] += size
            if len(self._sent) > _REMEMBERED:
                self._sent.popitem(last=False)
        try:
            yield
        finally:
            with self._turn:
                self._arriving[attempt] -= size
                self._arriving += Counter()  # forgets those without any


UploadsDependency = Annotated[Uploads, of_the_application("uploads")]
