"""One campaign: a cluster, a user, faults by a schedule, and the checks at the end."""

import os
import random
import signal
import statistics
import time
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from jointplay.chaos.checks import wrongs
from jointplay.chaos.jobs import jobs_of
from jointplay.chaos.recovery import PATIENCE, Recovery
from jointplay.chaos.schedule import Strike, schedule
from jointplay.chaos.undisturbed import undisturbed
from jointplay.chaos.user import User
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.reconciliation.leftovers import left_after
from tests.machines.cluster import WORKERS, Cluster, running_cluster
from tests.machines.faults import FAULTS
from tests.machines.puts import ways
from tests.machines.recovery import back, lost, started, taken_over

_AHEAD = 3  # open jobs for each block that is computed at a time
_LONGEST = 360.0  # s; a sixth of it is the longest that a fault lasts
_STUCK = 300.0  # s without any change of any job
Tell = Callable[[str], None]


@dataclass
class Struck:
    """One fault that struck."""

    fault: str
    on: str  # a machine, or "servers"
    at: float  # s since the campaign began
    lasted: float  # s
    held: int  # blocks that the machine, or all, held when it struck
    lost: int  # attempts that lost their block meanwhile
    taken_over: float | None  # s from its begin until blocks of a lost machine went on
    started: float | None  # s from its end until all processes of a killed machine were there
    back: float | None  # s from its end until those who were struck came further
    load: float  # processes that ran or would have, as the mean of the last minute


@dataclass
class Report:
    """A campaign from its seed to what was wrong in the end."""

    seed: int
    struck: list[Struck] = field(default_factory=list)
    jobs: dict[str, int] = field(default_factory=dict)
    answers: dict[str, int] = field(default_factory=dict)
    lost: int = 0  # attempts that lost their block
    puts: dict[str, int] = field(default_factory=dict)
    seconds: float = 0.0
    wrong: list[str] = field(default_factory=list)


def campaign(
    folder: Path, *, seed: int, jobs: int, faults: Sequence[str], kind: str, tell: Tell
) -> Report:
    """Let faults strike until all jobs have ended, and each of the faults has struck.

    Parameters
    ----------
    folder
        Is there, and empty.
    seed
        Of jobs and schedule.
    jobs
        How many are submitted at least.
    kind
        Of all jobs; empty: of every kind.
    """
    mix = [job for job in jobs_of(seed) if kind in ("", job["kind"])][:jobs]
    tell(f"computing {len(mix)} jobs undisturbed")
    expected = {number: undisturbed(job, folder / f"{number}") for number, job in enumerate(mix)}
    report = Report(seed)
    with running_cluster(folder) as cluster:
        at_once = _AHEAD * WORKERS * len(cluster.machines)
        user = User(cluster, mix, at_once, seed, cluster.key)
        catalogue = Catalogue(cluster.settings.catalogue_url)
        catalogue.migrate()
        begun = time.monotonic()
        user.start()
        _strike(cluster, catalogue, user, report, jobs, faults, tell)
        user.leave()
        report.seconds = time.monotonic() - begun
        _clear_up(cluster, catalogue)
        for machine in cluster.machines:
            machine.stop()
        tell("checking")
        report.answers = user.history.answers
        report.jobs = dict(Counter(str(one.state) for one in user.history.submissions))
        report.lost = lost(catalogue)
        report.puts = ways(
            [one.folder / "api.log" for one in cluster.own], [cluster.joined.folder / "worker.log"]
        )
        report.wrong += wrongs(cluster, user.history, expected)
        catalogue.close()
    return report


def _clear_up(cluster: Cluster, catalogue: Catalogue) -> None:
    """Have the relays look for what jobs left, as they do a lease after their start."""
    if [*left_after(cluster.settings, catalogue, grace=0.0)]:
        for relay in [one for machine in cluster.own for one in machine.running("relay")]:
            relay.send(signal.SIGTERM)
        began = time.monotonic()
        while time.monotonic() - began < PATIENCE and [
            *left_after(cluster.settings, catalogue, grace=0.0)
        ]:
            time.sleep(1.0)  # each look lists the bucket


def _strike(
    cluster: Cluster,
    catalogue: Catalogue,
    user: User,
    report: Report,
    jobs: int,
    faults: Sequence[str],
    tell: Tell,
) -> None:
    drawn = random.Random(report.seed)
    begun = moved = time.monotonic()
    before: object = None
    strikes = schedule(report.seed, _LONGEST, {name: FAULTS[name] for name in faults})
    while not user.satisfied:
        if len(user.history.submissions) >= jobs and len(report.struck) >= len(faults):
            user.submit_no_more()
        standing = [(one.job, one.state, one.fraction) for one in user.history.submissions]
        if standing != before:
            before, moved = standing, time.monotonic()
        if time.monotonic() - moved > _STUCK:
            report.wrong += [f"job {one.job} is {one.state} for ever" for one in user.history.open]
            return
        if not any(one.state == "running" for one in user.history.open):  # nothing to disturb yet
            time.sleep(0.2)  # the processors are for the workers
            continue
        strike = next(strikes)
        time.sleep(strike.pause)  # as drawn: that faults come after another is what is tried
        one = _one(cluster, catalogue, strike, drawn, time.monotonic() - begun)
        report.struck.append(one)
        tell(
            f"{one.at:6.0f} s  {one.fault} of {one.on} for {one.lasted:.1f} s, {one.held} held,"
            f" {one.lost} lost, taken over {_said(one.taken_over)},"
            f" started {_said(one.started)}, back {_said(one.back)}"
        )


def _said(seconds: float | None) -> str:
    return "-" if seconds is None else f"within {seconds:.1f} s"


def _one(
    cluster: Cluster, catalogue: Catalogue, strike: Strike, drawn: random.Random, at: float
) -> Struck:
    everybody = Recovery(catalogue, WORKERS * len(cluster.machines))
    held = {machine: taken_over(cluster, machine) for machine in cluster.machines}
    boots, before = [machine.boot for machine in cluster.machines], lost(catalogue)
    began = time.monotonic()
    with FAULTS[strike.fault].strike(cluster, drawn) as machine:
        time.sleep(strike.lasts)  # as drawn: leases run out in the longer ones
    over = time.monotonic()
    if machine is None:
        again = everybody.wait(over)
        on, count, taken, start = "servers", len(everybody.held), None, None
    else:
        on, (count, went_on) = machine.name, held[machine]
        starts = None if machine.boot in boots else started(cluster, machine, over)
        again = back(cluster, machine, over)
        taken = went_on.result() if count else None
        start = starts.result() if starts else None
    left = lost(catalogue) - before
    load = os.getloadavg()[0]
    return Struck(strike.fault, on, at, over - began, count, left, taken, start, again, load)


def median_and_most(struck: Sequence[Struck], of: Callable[[Struck], float | None]) -> str:
    """Return the median and the longest of the times that are known."""
    known = [seconds for one in struck if (seconds := of(one)) is not None]
    return f"{statistics.median(known):.1f}, {max(known):.1f}" if known else "-"
