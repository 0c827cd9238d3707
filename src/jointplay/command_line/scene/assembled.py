"""The scene that was typed, put together, for the commands that look at it before it is run."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from jointplay.command_line.job_document import is_scene_file, job_document

if TYPE_CHECKING:
    from jointplay.solver.kinds.assembled import AssembledScene


def assemble_scene(source: str, settings: Sequence[str]) -> "AssembledScene":
    """Return the scene; one that cannot be run is returned too, if its parts fit together.

    Raises
    ------
    InvalidInput
        With everything that keeps the scene from being read. Pointers lead into the document
        that was given: into the scene's own if ``source`` is the file of a scene.
    """
    from jointplay.solver.kinds.assembled import assembled_scene

    given = job_document(source, settings=settings, options={})
    return assembled_scene(given.get("scene"), is_whole=is_scene_file(source))
