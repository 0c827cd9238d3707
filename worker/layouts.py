"""Layouts of the stores of jobs: what results a job has, before anything of it is computed."""

from jointplay.records.channel import Channel
from jointplay.records.point_numbers import OUTPUTS
from jointplay.solver.joints.curves import joint_curves
from jointplay.solver.kinds import KINDS, Admission, Study
from jointplay.solver.nonlinear.settling import SETTLINGS
from jointplay.solver.nonlinear.verdict import VERDICTS
from jointplay.solver.runs.dense_output.columns import (
    methods,
    needs_no_steps,
    period_of_steps,
    step_columns,
)
from jointplay.solver.version import SOLVER_VERSION
from jointplay.storage.results.layout import ResultLayout
from jointplay.storage.studies.layout import StudyLayout


def layout_of_run(admission: Admission) -> ResultLayout:
    """Return what a run's store holds."""
    curves = joint_curves(admission.scene.joints)
    return ResultLayout(
        channels=admission.channels,
        samples=admission.samples,
        sections=admission.sections,
        joints=admission.joints,
        attributes={
            "job": admission.job,
            "scene": admission.scene_document(),
            **({"curves": curves} if curves else {}),
            "digest": admission.digest,
            "solver_version": SOLVER_VERSION,
            "period": admission.period,
            "section_note": admission.section_note,
            "notes": list(admission.notes),
            **({"exact": "motion"} if needs_no_steps(admission) else {"methods": methods()}),
        },
        steps=step_columns(admission),
        steps_period=period_of_steps(admission),
        intervals=not needs_no_steps(admission),
    )


def layout_of_study(study: Study) -> StudyLayout:
    """Return what a study's store holds."""
    declared, own = study.point_scene(0).parameters, KINDS[study.kind].outputs(study)
    return StudyLayout(
        parameters=tuple(
            Channel(name, unit, declared[name].help if name in declared else "of the start")
            for name, unit in zip(study.parameters, study.parameter_units, strict=True)
        ),
        values=study.values,
        observables=study.observables,
        record=study.record if study.observables else 0,
        channels=study.channels,
        blocks=study.blocks,
        shape=study.shape,
        attributes={
            "job": study.job,
            "scene": study.scene_document(),
            "digest": study.digest,
            "solver_version": SOLVER_VERSION,
            "verdicts": sorted(VERDICTS, key=VERDICTS.__getitem__),
            "settlings": sorted(SETTLINGS, key=SETTLINGS.__getitem__),
            **({"meanings": dict(own)} if own else {}),
            **study.attributes(),
        },
        outputs={name: Channel(name, *output) for name, output in {**OUTPUTS, **own}.items()},
    )
