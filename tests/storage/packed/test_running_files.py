"""The folder of a store that is being filled."""

import shutil
import threading
from contextlib import suppress
from pathlib import Path

from jointplay.storage.packed import Running


def test_it_can_be_made_while_the_empty_folder_above_it_is_removed(tmp_path: Path) -> None:
    above, enough = tmp_path / "running/XX", threading.Event()

    def remove() -> None:
        while not enough.is_set():
            with suppress(OSError):
                above.rmdir()

    thread = threading.Thread(target=remove)
    thread.start()
    try:
        for job in range(100):
            files = Running(above / str(job) / "a1")
            files.write_documents([("zarr.json", b"{}")])
            assert files.read("zarr.json") == b"{}"
            shutil.rmtree(above / str(job))
    finally:
        enough.set()
        thread.join()
