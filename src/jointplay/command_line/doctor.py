"""``jointplay doctor``: whether everything that a service, or a run, keeps is as it should be."""

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import asdict
from datetime import UTC, datetime
from functools import partial
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from jointplay.command_line.exits import Exit, Stopped
from jointplay.command_line.options import AS_JSON
from jointplay.command_line.output import aligned, print_result

if TYPE_CHECKING:
    from jointplay.storage.reconciliation import Extent, Finding

FOLDER = Annotated[
    Path,
    typer.Argument(
        metavar="FOLDER",
        envvar="JOINTPLAY_DATA",
        help="Data folder of a service, or folder of `jointplay run`.",
    ),
]
DRY_RUN = Annotated[bool, typer.Option("--dry-run", help="Only look, mend nothing.")]
EVERY_BYTE = Annotated[
    bool, typer.Option("--bytes", "--all", help="Read every byte of all results.")
]
SEED = Annotated[
    int | None, typer.Option(min=0, help="Of the sample of results; default: of the day.")
]
DEVICE = Annotated[
    bool, typer.Option("--device", help="Only try whether a graphics processor serves.")
]


def doctor(
    folder: FOLDER = Path(".jointplay"),
    dry_run: DRY_RUN = False,
    every_byte: EVERY_BYTE = False,
    seed: SEED = None,
    device: DEVICE = False,
    as_json: AS_JSON = False,
) -> None:
    """Compare catalogue, results and broker with one another, and mend what can be mended.

    All results are looked for; of a sample of 100 of them, or of all with --bytes, every byte is
    compared with its checksum.  Jobs whose results are damaged are marked, so that submitting them
    again computes them anew; leftovers are removed, whole results without a job get one.  The
    service may run meanwhile: what a worker holds is left alone.  Exit code 0: nothing was found;
    1: something was, and is in the table.

    With --device a mechanism is run on the first graphics processor and here: whether it has the
    same bits, and how fast it is.  Exit code 0: it serves.

    Example: `jointplay doctor .jointplay --dry-run`
    """
    if device:
        _try_device(as_json=as_json)
        return
    from jointplay.progress import progress
    from jointplay.storage.reconciliation.extent import Counted, Extent

    found, counted = [], Counted()
    seed = _day() if seed is None else seed
    extent = partial(Extent, None if every_byte else seed, counted=counted)
    with progress("doctor") as report, _examination(folder, extent(report=report)) as findings:
        for finding in findings:
            if finding.mend is not None and not dry_run:
                finding.mend()
            found.append(finding)
    mendable = sum(finding.mend is not None for finding in found)
    document = {
        "findings": [finding.document() for finding in found],
        "mended": 0 if dry_run else mendable,
        "results": counted.there,
        "read": counted.read,
        "seed": seed if counted.read < counted.there else None,
    }
    if counted.read < counted.there and not as_json:
        sample = f"every byte was read of {counted.read} of {counted.there} results (--seed {seed})"
        typer.echo(f"{sample}; --bytes reads all", err=True)
    print_result(document, _lines(found, dry_run=dry_run), as_json=as_json)
    if found:
        done = "can be mended" if dry_run else "mended"
        raise Stopped(f"findings: {len(found)}, {done}: {mendable}", Exit.CHECK_FAILED)


def _try_device(*, as_json: bool) -> None:
    """Say whether a device serves."""
    from jointplay.solver.kernels.device.driver import Device, DeviceError
    from jointplay.solver.runs.device_trial import try_device
    from jointplay.worker.own_device import TRIED, trial_scenes

    try:
        trial = try_device(Device(), [*trial_scenes()])
    except DeviceError as error:
        raise Stopped(f"{error}.", Exit.CHECK_FAILED) from error
    bits = "the bits of this processor" if trial.same_bits else "OTHER BITS than this processor"
    lines = [
        f"{trial.name}: {bits}",
        f"{TRIED}: {trial.revolutions:.3g} revolutions, {trial.steps:.3g} steps a second",
        f"single precision is {trial.ratio} times as fast as double",
    ]
    print_result(asdict(trial) | {"serves": trial.serves}, lines, as_json=as_json)
    if not trial.serves:
        raise Stopped(f"{trial.name} does not serve.", Exit.CHECK_FAILED)


@contextmanager
def _examination(folder: Path, extent: "Extent") -> "Iterator[Iterable[Finding]]":
    """Give what is found in a folder, while it is looked for."""
    from jointplay.worker.local.folder import JOB_FILE, STORE

    if any((folder / name).exists() for name in (JOB_FILE, STORE)):
        from jointplay.command_line.result_table import wrong_tables
        from jointplay.worker.local.examination import examined

        yield chain(examined(folder), wrong_tables(folder))
        return
    from jointplay.service.processes.supervisor import settings_of
    from jointplay.storage.catalogue.catalogue import Catalogue
    from jointplay.storage.reconciliation import findings
    from jointplay.storage.sqlite_address import sqlite_file

    settings = settings_of(folder)
    # the queue reads the settings when it is loaded: by now they are known to be sound
    from jointplay.worker.stray_messages import stray_messages

    database = sqlite_file(settings.catalogue_url)
    if database is not None and not database.exists():
        line = f"{folder} holds neither a service's data nor the results of a run."
        raise Stopped(line)
    catalogue = Catalogue(settings.catalogue_url)
    try:
        yield findings(settings, catalogue, (stray_messages,), extent)
    finally:
        catalogue.close()


def _day() -> int:
    """Return the number of this day, so that each day other results are read."""
    return datetime.now(UTC).toordinal()


def _lines(found: "list[Finding]", *, dry_run: bool) -> Iterator[str]:
    if not found:
        yield "nothing is wrong"
        return
    done = "would be" if dry_run else "mended"
    rows = [("where", "what", "is wrong", done)]
    rows += [(one.where, one.subject, one.found, one.mended or "-") for one in found]
    yield from aligned(rows)
    yield from dict.fromkeys(f"left to you: {one.advice}" for one in found if one.advice)
