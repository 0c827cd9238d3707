"""One campaign: a service, a user, faults by a schedule, and the checks at the end."""

import os
import random
import shutil
import time
from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path

from jointplay.chaos.checks import wrongs
from jointplay.chaos.faults import FAULTS
from jointplay.chaos.history import History
from jointplay.chaos.installation import Installation
from jointplay.chaos.jobs import Document, jobs_of
from jointplay.chaos.recovery import Recovery
from jointplay.chaos.report import Report, Struck
from jointplay.chaos.schedule import Strike, schedule
from jointplay.chaos.undisturbed import undisturbed
from jointplay.chaos.user import User
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import CatalogueError

_STUCK = 180.0  # s without any change of any job, after which it is given up
_AHEAD = 3  # open jobs for each block that is computed at a time

Tell = Callable[[str], None]


def campaign(
    folder: Path,
    *,
    seed: int,
    duration: float,
    faults: Sequence[str],
    workers: int,
    servers: Sequence[str],
    tell: Tell,
) -> Report:
    """Let faults strike a service of its own for a while, and check what it made of them.

    Parameters
    ----------
    folder
        Absolute; is there, and empty but for a file system of its own, if any, at `data`.
    seed
        Of jobs and schedule.
    duration
        In which faults strike, s; starting, finishing all jobs and checking come on top.
    faults
        Names of them.
    workers
        How many blocks are computed at a time.
    servers
        Addresses of an empty database and of an empty object store; "": files of its own.
    tell
        Called with a line for everything that happens.
    """
    mix = jobs_of(seed)
    report = Report(seed, duration)
    device = any(name.startswith("device-") for name in faults)
    installation = Installation(folder, workers, *servers, device=device)
    for name in faults:
        if (hindrance := FAULTS[name].hindrance(installation)) is not None:
            report.left_out[name] = hindrance
    try:
        installation.start()
        user = _strike(installation, mix, report, [*faults], workers, tell)
        installation.stop()
    finally:
        installation.kill()
    submitted = {one.template for one in user.history.submissions}
    tell(f"computing {len(submitted)} jobs undisturbed")
    expected = {
        number: undisturbed(mix[number], folder / f"undisturbed-{number}") for number in submitted
    }
    tell("checking")
    report.answers = user.history.answers
    _count(installation, user.history, report)
    report.wrong += wrongs(installation, user.history, expected)
    if report.wrong and os.path.ismount(installation.data):  # that disk goes with this process
        kept = folder / "data-as-it-was"
        shutil.copytree(installation.data, kept, ignore=shutil.ignore_patterns("*.sock"))
    return report


def _strike(
    installation: Installation,
    mix: Sequence[Document],
    report: Report,
    faults: Sequence[str],
    workers: int,
    tell: Tell,
) -> User:
    """Let faults strike while a user works, then wait until all jobs ended."""
    possible = {name: FAULTS[name] for name in faults if name not in report.left_out}
    user = User(installation, mix, _AHEAD * workers, report.seed)
    drawn = random.Random(report.seed)  # noqa: S311 - repeatable on purpose
    catalogue = Catalogue(installation.settings.catalogue_url)
    begun = time.monotonic()
    user.start()
    for strike in schedule(report.seed, report.duration, possible):
        time.sleep(strike.pause)
        if time.monotonic() - begun + strike.lasts > report.duration:
            break
        recovery = Recovery(catalogue, workers)
        struck = _one(installation, recovery, strike, drawn, time.monotonic() - begun)
        report.struck.append(struck)
        tell(f"{struck.at:6.0f} s  {strike.fault} for {struck.lasted:.1f} s, {_said(struck)}")
    tell("waiting for the end of all jobs")
    user.submit_no_more()
    report.wrong += _wait(user)
    user.leave()
    catalogue.close()
    return user


def _one(
    installation: Installation, recovery: Recovery, strike: Strike, drawn: random.Random, at: float
) -> Struck:
    began = time.monotonic()
    with FAULTS[strike.fault].strike(installation, drawn):
        time.sleep(strike.lasts)
        over = time.monotonic()
    return Struck(strike.fault, at, over - began, len(recovery.held), recovery.wait(over))


def _said(struck: Struck) -> str:
    if not struck.held:
        return "while no block was held"
    late = "never went on" if struck.recovery is None else f"went on within {struck.recovery:.1f} s"
    return f"{struck.held} held {late}"


def _wait(user: User) -> list[str]:
    """Wait until all jobs ended. Returns what is wrong if they do not."""
    before: object = None
    moved = time.monotonic()
    while not user.satisfied:
        standing = [(one.job, one.state, one.fraction) for one in user.history.open]
        if standing != before:
            before, moved = standing, time.monotonic()
        if time.monotonic() - moved > _STUCK:
            return [f"job {one.job} is {one.state} for ever" for one in user.history.open]
        time.sleep(0.2)
    return []


def _count(installation: Installation, history: History, report: Report) -> None:
    """Count how jobs ended, and attempts that lost their block."""
    report.jobs = dict(Counter(one.state or "never accepted" for one in history.submissions))
    catalogue = Catalogue(installation.settings.catalogue_url)
    try:
        for submission in history.submissions:
            if submission.job is not None:
                tries = catalogue.attempts(submission.job)
                report.lost += sum(one.outcome == "lost" for one in tries)
    except CatalogueError:
        pass  # the checks say it
    finally:
        catalogue.close()
