"""The animation among the figures of ``jointplay plot``, which is a film."""

from typing import TYPE_CHECKING, Any, Final

from jointplay.command_line.exits import Stopped
from jointplay.command_line.figure_paths import FigurePaths
from jointplay.progress import progress
from jointplay.records.figure_form import FILM_FORMS

if TYPE_CHECKING:
    from jointplay.client import Job

ANIMATION: Final = "animation"


def is_film(names: list[str] | None, form: str | None, pace: dict[str, Any]) -> bool:
    """Tell whether a film is asked for; what is meant for films alone is refused elsewhere."""
    if names == [ANIMATION] and form in (None, *FILM_FORMS):
        return True
    asked = [*pace, *([f"format {form}"] if form in FILM_FORMS else [])]
    if asked:
        option = asked[0].replace("_", "-")
        raise Stopped(f"--{option} is of a film alone: jointplay plot OUT {ANIMATION}.")
    return False


def draw_film(job: "Job", paths: FigurePaths, form: str, **shown: Any) -> list[dict[str, str]]:
    """Write the film of a job. Returns its name and path."""
    path = paths.path(ANIMATION, form)
    with progress(ANIMATION) as report:
        job.film(path, report=lambda share: report(share, ""), **shown)
    return [{"name": ANIMATION, "path": str(path)}]
