"""Facts of one scene that several checks ask for, one after the other: found once."""

import threading
from collections.abc import Callable
from functools import wraps
from typing import Any, TypeVar

Scene = TypeVar("Scene")
Found = TypeVar("Found")


def once_per_scene(function: Callable[[Scene], Found]) -> Callable[[Scene], Found]:
    """Have a function look once at a scene that a thread asks it about again and again.

    What it found of the latest scene is kept, and shared: it must not be changed.
    """
    latest: Any = threading.local()

    @wraps(function)
    def kept(scene: Scene) -> Found:
        if getattr(latest, "scene", None) is not scene:
            latest.found = function(scene)
            latest.scene = scene  # last: an error leaves nothing behind
        found: Found = latest.found
        return found

    return kept
