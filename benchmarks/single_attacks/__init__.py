"""Each attack that once harmed a service, by itself: what it does to a service of today.

    python -m benchmarks single_attacks [--beside WHEEL] [--only NAME,NAME] [--kinds folder,bucket]

Every attack has a service of its own: with SQLite and a folder, then with PostgreSQL and a bucket;
and so has an earlier version with `--beside`. What is not the administrator's is done over HTTP
alone. It needs root: file systems are mounted, and files made immutable.
"""

from benchmarks.single_attacks.command import main

__all__ = ["main"]
