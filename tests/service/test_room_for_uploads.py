"""Bytes of files that workers send: counting what is stored of an attempt holds nobody up."""

import threading
from pathlib import Path

import pytest

from jointplay.service.workers.uploads import Uploads
from jointplay.storage.catalogue.records import Block, BlockState
from jointplay.storage.errors import CorruptStore
from jointplay.storage.settings import Settings
from tests.waiting import PATIENCE

BLOCK = Block("j-0", "j", 0, 0, 1, BlockState.running, 1)


def send(uploads: Uploads, size: int, stored: int = 0) -> None:
    """Send a file of an attempt that may have 100 bytes, and has some stored."""
    with uploads.of_attempt(BLOCK, size, 100, lambda: stored):
        pass


def test_files_of_others_do_not_wait_for_it(tmp_path: Path) -> None:
    uploads, settings, others = Uploads(), Settings(data=tmp_path, reserve=0), threading.Event()

    def send_another() -> None:
        with uploads.room(settings, 1):
            others.set()

    def stored() -> int:
        threading.Thread(target=send_another, daemon=True).start()
        assert others.wait(PATIENCE)
        return 0

    send(uploads, 90)
    with uploads.of_attempt(BLOCK, 20, 100, stored):
        pass


def test_what_is_sent_meanwhile_is_counted_too() -> None:
    uploads = Uploads()

    def stored() -> int:
        send(uploads, 5)
        return 10

    send(uploads, 90)
    with uploads.of_attempt(BLOCK, 80, 100, stored):
        pass
    with pytest.raises(CorruptStore, match="has 95 bytes"):
        send(uploads, 10, stored=95)
    send(uploads, 5, stored=95)


def test_no_more_is_offered_at_once_than_an_attempt_may_have() -> None:
    uploads, size = Uploads(), 2**21
    for digests, seconds in (("xyz", 0.0), ("abc", 900.0), ("abc", 900.0)):
        for digest in digests:  # the first ones are over at once, the last ones the same again
            uploads.offer(BLOCK, digest, size, 3 * size, seconds)
    with pytest.raises(CorruptStore, match="where to put"):
        uploads.offer(BLOCK, "d", 1, 3 * size, 900.0)
