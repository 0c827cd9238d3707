"""The kind ``calibration``: parameters of a scene that give numbers that were measured."""

from collections.abc import Iterable, Mapping
from typing import Any, ClassVar

import numpy as np

from jointplay.records.failure import InvalidInput
from jointplay.solver.calibration.plan import CalibrationStudy, best_of, result_bytes
from jointplay.solver.calibration.problem import Calibration
from jointplay.solver.calibration.space import space_of, space_problems
from jointplay.solver.calibration.targets import goals_of
from jointplay.solver.kinds import documents
from jointplay.solver.kinds.calibration_checks import (
    check_case,
    check_corners,
    check_size,
    target_and_case_problems,
)
from jointplay.solver.kinds.calibration_job import CalibrationJob
from jointplay.solver.kinds.job import PresetScene
from jointplay.solver.kinds.kind import Kind
from jointplay.solver.kinds.mechanism import declared, resolve
from jointplay.solver.kinds.methods import check_study
from jointplay.solver.kinds.points import one_point
from jointplay.solver.kinds.studies import Spans, make_study, place_points
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.statistics import Output


class CalibrationKind(Kind[CalibrationJob]):
    """One point, the best of many candidates, each of which is a run in every case."""

    document = CalibrationJob
    results: ClassVar = ("points", "calibration", "figures", "zarr")

    def admit(self, job: CalibrationJob) -> CalibrationStudy:
        """Check and fill in; see `Kind.admit`."""
        check_study(job, tangents=False)
        written, scene, _ = declared(job)
        problems = [*space_problems(job.parameters, scene), *target_and_case_problems(job)]
        if problems:
            raise InvalidInput(problems)
        _, resolved, echo = resolve(job)
        space = space_of(job.parameters)
        check_corners(job)
        cases = tuple(check_case(job, index, space) for index in range(len(job.cases)))
        check_size(job, cases)
        filled = documents.filled(job, resolved, echo)
        calibration = Calibration(
            filled,
            documents.digest(filled),
            job.search,
            job.spread,
            job.scene.parameters if isinstance(job.scene, PresetScene) else {},
            written,
            scene,
            space,
            cases,
            goals_of([target for case in cases for target in case.targets]),
        )
        longest = max(cases, key=lambda case: case.duration)
        spans = Spans(longest.study.period[:1], np.zeros(1), np.array([longest.duration]))
        study = make_study(filled, place_points(job, one_point()), spans)
        own = {"stored_bytes": study.stored_bytes + result_bytes(calibration)}
        return CalibrationStudy(**(vars(study) | own), calibration=calibration)

    def plan(self, job: CalibrationJob, filled: dict[str, Any]) -> CalibrationStudy:
        """Return what `admit` returned; the checked cases are what candidates are made from."""
        return self.admit(job)

    def varied(self, job: CalibrationJob, study: Study) -> Iterable[str]:
        """Return the parameters that are to be found."""
        return job.parameters

    def outputs(self, study: Study) -> Mapping[str, Output]:
        """Return the cost, and the parameters that were found."""
        assert isinstance(study, CalibrationStudy)  # noqa: S101  (of this kind)
        declared = study.calibration.scene.parameters
        return {
            "cost": ("1", "root mean square of the misses, in tolerances"),
            **{
                best_of(name): (declared[name].unit, f"{name} that fits best")
                for name in study.calibration.space.names
            },
        }
