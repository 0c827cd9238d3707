"""`python -m jointplay.service.scenes FD`: looks at scenes that it receives, until it is idle."""

from typing import Any

from jointplay.figures import NotDrawable, Options, render_mechanism
from jointplay.records.figure_form import Form
from jointplay.records.strict_json import parse
from jointplay.service.problems import ErrorDetail, RequestRefused, kinds
from jointplay.service.questions import answer_or_refuse
from jointplay.service.scenes.findings import assemblies_of, findings_of
from jointplay.solver.kinds.assembled import AssembledScene, assembled_scene

_IDLE = 60.0  # s


def look(body: bytes, form: Form | None, page: dict[str, Any]) -> object:
    """Return findings of a scene, or its drawing if a form is given."""
    scene = assembled_scene(_scene_in(body), is_whole=True)
    if form is None:
        return findings_of(scene, assemblies_of(scene))
    return _drawing(scene, form, page)


def _scene_in(body: bytes) -> Any:
    document = parse(body)
    if not isinstance(document, dict):
        sentence = "A scene is a JSON object: a preset with parameters, or a document."
        wrong = ErrorDetail(detail=sentence, pointer="")
        raise RequestRefused(kinds.INVALID_JOB, sentence, [wrong])
    return document


def _drawing(scene: AssembledScene, form: Form, page: dict[str, Any]) -> bytes:
    try:
        return render_mechanism(scene.drawn(), scene.pose(), form, Options(**page))
    except NotDrawable as error:
        raise RequestRefused(kinds.NOT_DRAWABLE, str(error)) from None


if __name__ == "__main__":
    answer_or_refuse(look, _IDLE)
