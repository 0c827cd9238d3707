"""Cores that this process may use."""

import os


def cores() -> int:
    """Count them; a process that is bound to some has no others."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
