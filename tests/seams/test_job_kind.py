"""A kind of job from outside: Poincare sections along a line between two sets of values."""

from collections.abc import Iterator
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
import pytest
from pydantic import Field

from jointplay.client import Refused
from jointplay.local import run
from jointplay.solver.kinds import KINDS, admit, parse
from jointplay.solver.kinds.points import Axis, Points
from jointplay.solver.kinds.section_study import SectionStudy, SectionStudyJob
from tests.seams.conftest import Platform


def _pointer(_index: int) -> str:
    return "/count"


Values = Annotated[dict[str, float], Field(min_length=1)]


class LineJob(SectionStudyJob):
    """Sections at equally spaced points of a line through several parameters."""

    kind: Literal["line"]
    start: Values
    stop: Values
    count: Annotated[int, Field(ge=2, le=1000)]


class Line(SectionStudy[LineJob]):
    """A point for each step along the line."""

    document = LineJob
    results: ClassVar = ("points", "poincare", "figures", "zarr")

    def points(self, job: LineJob) -> Points:
        written = np.arange(job.count)
        axes = [
            Axis(name, f"/start/{name}", np.linspace(start, job.stop[name], job.count), _pointer)
            for name, start in job.start.items()
        ]
        index = np.tile(written[:, None], (1, len(axes)))
        return Points(tuple(axes), index, _pointer)


@pytest.fixture
def line() -> Iterator[None]:
    KINDS["line"] = Line()
    yield
    del KINDS["line"]


SCENE = {"preset": "seven-bar-press", "parameters": {"speed": 100.0}}
ALIKE = {"scene": SCENE, "settle": 0, "record": 3, "tolerance": 1e-5}
START, STOP = {"clearance": 2e-4, "friction": 0.0}, {"clearance": 4e-4, "friction": 0.1}
LINE: dict[str, Any] = {"kind": "line", "start": START, "stop": STOP, "count": 3, **ALIKE}


@pytest.mark.usefixtures("line")
def test_a_job_of_the_kind_runs_from_its_document_to_the_client(platform: Platform) -> None:
    job = platform.computed(LINE)
    assert (job.kind, job.state) == ("line", "succeeded")
    study = job.study()
    assert [parameter.name for parameter in study.parameters] == ["clearance", "friction"]
    assert study.values == pytest.approx(np.array([[2e-4, 0.0], [3e-4, 0.05], [4e-4, 0.1]]))
    alone = platform.computed(
        ALIKE
        | {"kind": "poincare"}
        | {"scene": {**SCENE, "parameters": {"speed": 100.0, "clearance": 4e-4, "friction": 0.1}}}
    )
    for observable in study.observables:  # a point's bits depend on nothing but the point
        assert np.array_equal(
            study.sections(observable.name)[2], alone.study().sections(observable.name)[0]
        )
    assert job.points["status"].tolist() == ["done"] * 3
    assert len(job.poincare) == 9
    assert [one.id for one in platform.client.jobs(kind="line")] == [job.id]


@pytest.mark.usefixtures("line")
def test_a_bad_document_of_the_kind_is_refused_at_its_field(platform: Platform) -> None:
    with pytest.raises(Refused) as refusal:
        platform.client.submit(LINE | {"count": 1, "chains": 2})
    assert {problem.pointer for problem in refusal.value.fields} == {"/count", "/chains"}
    with pytest.raises(Refused) as refusal:
        platform.client.submit(LINE | {"start": {"slack": 1.0}, "stop": {"slack": 2.0}})
    assert refusal.value.fields[0].pointer == "/start/slack"


@pytest.mark.usefixtures("line")
def test_what_is_stored_of_the_kind_plans_what_was_admitted() -> None:
    admitted = admit(LINE)
    planned = parse(admitted.job)
    assert planned.digest == admitted.digest
    assert planned.values.tolist() == admitted.values.tolist()
    assert planned.blocks == admitted.blocks


@pytest.mark.usefixtures("line")
def test_the_kind_runs_here_and_now() -> None:
    job = run(LINE, processes=1)
    assert job.study().counts.tolist() == [3, 3, 3]
