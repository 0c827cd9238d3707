"""``jointplay run``: simulate here and now, without any service."""

import shutil
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from jointplay.command_line import job_document, output_folder, study_options
from jointplay.command_line.exits import Exit, Stopped

if TYPE_CHECKING:
    from solver.admission import Admission, Study
    from worker.execute import Outcome


def run(
    source: job_document.JOB,
    output: Annotated[
        Path, typer.Option("-o", "--output", metavar="OUT", help="Folder to make; must not exist.")
    ],
    settings: job_document.SET = None,
    duration: job_document.DURATION = None,
    tolerance: job_document.TOLERANCE = None,
    accuracy: job_document.ACCURACY = None,
    output_step: job_document.OUTPUT_STEP = None,
    channels: job_document.CHANNELS = None,
    formulation: job_document.FORMULATION = None,
    label: job_document.LABEL = None,
    bifurcation: study_options.BIFURCATION = None,
    sweep: study_options.SWEEP = None,
    poincare: study_options.POINCARE = False,
    ensemble: study_options.ENSEMBLE = None,
    periods: study_options.PERIODS = None,
    settle: study_options.SETTLE = None,
    record: study_options.RECORD = None,
    section: study_options.SECTION = None,
    observables: study_options.OBSERVABLES = None,
    indicators: study_options.INDICATORS = None,
    continuation: study_options.CONTINUATION = None,
    chains: study_options.CHAINS = None,
    processes: Annotated[
        int | None, typer.Option(min=1, max=1024, help="Of a study; default one for each core.")
    ] = None,
) -> None:
    """Simulate here and now, without any service; a study on all cores.

    OUT gets job.json (every default filled in: running it repeats the result), results.zarr,
    peaks.csv, of a study points.csv, and figures.  Ctrl-C ends the run and keeps what was computed.

    Examples: `jointplay run seven-bar-press --set clearance=5e-4 --duration 2 -o OUT`,
    `jointplay run seven-bar-press --bifurcation clearance=1e-4:1e-3:200 --record 50 -o DIAGRAM`
    """
    from solver.admission import Study, admit

    document = job_document.job_document(
        source,
        settings=settings or (),
        options=job_document.options(
            duration=duration,
            tolerance=tolerance,
            accuracy=accuracy,
            output_step=output_step,
            channels=channels,
            formulation=formulation,
            label=label,
            bifurcation=bifurcation,
            sweep=sweep,
            poincare=poincare,
            ensemble=ensemble,
            periods=periods,
            settle=settle,
            record=record,
            section=section,
            observables=observables,
            indicators=indicators,
            continuation=continuation,
            chains=chains,
        ),
    )
    admission = admit(document)
    if processes is not None and not isinstance(admission, Study):
        raise Stopped(Exit.BAD_INPUT, "--processes is of studies; this is one simulation.")
    _make(output)
    store = output / output_folder.STORE
    if isinstance(admission, Study):
        _study(admission, output, processes)
        return
    outcome = _simulate(admission, store, output.name)
    shutil.copyfile(store / "job.json", output / output_folder.JOB_FILE)
    _summarise(store, output)
    _tell(outcome)


def _make(output: Path) -> None:
    try:
        output.mkdir(parents=True)
    except FileExistsError:
        line = f"{output} exists already; results are never overwritten, name another folder."
        raise Stopped(Exit.BAD_INPUT, line) from None


def _study(study: "Study", output: Path, processes: int | None) -> None:
    """Compute a study and show what became of it, also if it was interrupted."""
    from jointplay.command_line.progress import progress
    from jointplay.command_line.run_study import compute
    from jointplay.command_line.study_summary import summarise

    store = output / output_folder.STORE
    with progress(output.name) as report:
        complete = compute(study, store, processes, report)
    shutil.copyfile(store / "job.json", output / output_folder.JOB_FILE)
    summarise(output)
    if not complete:
        raise Stopped(Exit.CANCELLED, "the study was cancelled; what was computed is kept")


def _simulate(admission: "Admission", store: Path, title: str) -> "Outcome":
    """Run the job; Ctrl-C asks it to end, and it ends between two slices of a quarter second."""
    import signal

    from jointplay.command_line.progress import progress

    asked_to_end = False

    def end(signal_number: int, frame: object) -> None:
        nonlocal asked_to_end
        asked_to_end = True

    with progress(title) as report:
        report(0.0, "preparing the kernel")
        from worker.execute import Progress, execute

        def go_on(done: Progress) -> str:
            report(done.fraction, f"t = {done.time:.4g} s")
            return "cancel" if asked_to_end else "continue"

        before = signal.signal(signal.SIGINT, end)
        try:
            return execute(admission, store, report=go_on)
        finally:
            signal.signal(signal.SIGINT, before)


def _summarise(store: Path, output: Path) -> None:
    """Write figures and peaks, and print the peaks."""
    from jointplay.command_line.drawing import draw_all
    from jointplay.command_line.peaks import headline, of_store, print_peaks, write_peaks
    from storage.results import ResultReader

    reader: ResultReader = ResultReader(store)
    rows = list(of_store(reader))
    write_peaks(output / output_folder.PEAKS_FILE, rows)
    draw_all(reader, output / output_folder.FIGURES, "png")
    first = headline(reader)
    print_peaks(row for row in rows if row.channel in first)
    typer.echo(f"all {len(rows)} channels are in {output / output_folder.PEAKS_FILE}")


def _tell(outcome: "Outcome") -> None:
    if outcome.error is not None:
        error = outcome.error
        raise Stopped(Exit.FAILED, f"the run failed ({error.error_class}): {error.detail}")
    if outcome.state == "cancelled":
        raise Stopped(Exit.CANCELLED, "the run was cancelled; what was computed is kept")
