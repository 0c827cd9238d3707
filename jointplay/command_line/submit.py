"""``jointplay submit``: give a job to a service."""

from dataclasses import asdict
from typing import Annotated

import typer

from jointplay.command_line import connection, job_document, study_options
from jointplay.command_line.json_output import AS_JSON, print_json


def submit(
    source: job_document.JOB,
    settings: job_document.SET = None,
    duration: job_document.DURATION = None,
    tolerance: job_document.TOLERANCE = None,
    accuracy: job_document.ACCURACY = None,
    method: job_document.METHOD = None,
    step: job_document.STEP = None,
    output_step: job_document.OUTPUT_STEP = None,
    channels: job_document.CHANNELS = None,
    formulation: job_document.FORMULATION = None,
    label: job_document.LABEL = None,
    bifurcation: study_options.BIFURCATION = None,
    sweep: study_options.SWEEP = None,
    poincare: study_options.POINCARE = False,
    ensemble: study_options.ENSEMBLE = None,
    accuracy_study: study_options.ACCURACY_STUDY = False,
    periods: study_options.PERIODS = None,
    statistics: study_options.STATISTICS = None,
    settle: study_options.SETTLE = None,
    record: study_options.RECORD = None,
    section: study_options.SECTION = None,
    observables: study_options.OBSERVABLES = None,
    indicators: study_options.INDICATORS = None,
    continuation: study_options.CONTINUATION = None,
    chains: study_options.CHAINS = None,
    anew: Annotated[
        bool, typer.Option("--anew", help="Compute it even if an identical job is there.")
    ] = False,
    estimate: Annotated[
        bool, typer.Option("--estimate", help="Only say what it will cost; queue nothing.")
    ] = False,
    wait: Annotated[bool, typer.Option("--wait", help="Wait until the job is finished.")] = False,
    as_json: AS_JSON = False,
    url: connection.URL = connection.DEFAULT_URL,
) -> None:
    """Queue a job at a service and print its id; an identical one is not computed again.

    With --wait the exit code tells how the job ended: 0 succeeded, 3 failed, 4 cancelled.

    Examples: `jointplay submit seven-bar-press --set clearance=3e-4 --duration 2 --wait`,
    `jointplay submit seven-bar-press --bifurcation clearance=1e-4:1e-3:200 --wait`
    """
    from jointplay.command_line.estimate import print_estimate
    from jointplay.command_line.waiting import wait_for

    job = job_document.job_document(
        source,
        settings=settings or (),
        options=job_document.options(
            duration=duration,
            tolerance=tolerance,
            accuracy=accuracy,
            method=method,
            step=step,
            output_step=output_step,
            channels=channels,
            formulation=formulation,
            label=label,
            bifurcation=bifurcation,
            sweep=sweep,
            poincare=poincare,
            ensemble=ensemble,
            accuracy_study=accuracy_study,
            periods=periods,
            statistics=statistics,
            settle=settle,
            record=record,
            section=section,
            observables=observables,
            indicators=indicators,
            continuation=continuation,
            chains=chains,
        ),
    )
    if anew:
        job["cache"] = False
    with connection.connect(url) as client:
        if estimate:
            cost = client.estimate(job)
            print_json(asdict(cost)) if as_json else print_estimate(cost)
            return
        queued = client.submit(job)
        if not as_json:
            typer.echo(queued.id)
        if wait:
            wait_for(queued)
        if as_json:
            print_json(queued.to_document())
        if wait:
            queued.check()
