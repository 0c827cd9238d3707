"""Whether the statistics that a sweep asks for can be had, and how many they are."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from jointplay.records.failure import InvalidInput, LimitExceeded, Problem
from jointplay.solver.admission.limits import MOST_SAMPLES_OF_STATISTICS, MOST_STATISTICS
from jointplay.solver.admission.varied import CheckedPoints
from jointplay.solver.jobs.sweep import SweepJob
from jointplay.solver.scene.channels import Channel
from jointplay.solver.statistics import OF_CONTACTS

Floats = NDArray[np.float64]


def check_statistics(job: SweepJob, checked: CheckedPoints, channels: tuple[Channel, ...]) -> int:
    """Return how many statistics each point has.

    Raises
    ------
    InvalidInput
        One is asked for twice, or of joints with clearance where there are none.
    LimitExceeded
        They are too many.
    """
    joints = {joint for mechanism in checked.mechanisms for joint in mechanism.tree.play}
    if problems := list(_problems(job, joints)):
        raise InvalidInput(problems)
    of_contacts = sum(name in OF_CONTACTS for name in job.statistics)
    of_channels = len(job.statistics) - of_contacts
    count = of_channels * len(channels) + of_contacts * len(joints)
    if count > MOST_STATISTICS:
        sentence = (
            f"{of_channels} statistics of {len(channels)} channels and {of_contacts} of"
            f" {len(joints)} joints are {count} numbers a point; the limit is {MOST_STATISTICS}."
            " Choose fewer statistics, or fewer 'channels'."
        )
        raise LimitExceeded([Problem("/statistics", sentence)])
    return count


def check_samples(job: SweepJob, period: Floats, settle: Floats, duration: Floats) -> None:
    """Refuse samples that are too few or too many; times are (points,) s.

    Raises
    ------
    InvalidInput
        A point has less than two.
    LimitExceeded
        With the number.
    """
    if not job.statistics:
        return
    samples = (duration - settle) / period * job.samples_per_period
    place = "/samples_per_period"
    if samples.min() < 2.0:
        point = int(samples.argmin())
        least = 2.0 * period[point] / job.samples_per_period
        sentence = (
            f"At point {point} only {duration[point] - settle[point]:g} s are left after settling,"
            f" less than two samples; statistics need {least:.3g} s, or more samples a period."
        )
        raise InvalidInput([Problem(place, sentence)])
    total = float(samples.sum())
    if total > MOST_SAMPLES_OF_STATISTICS:
        sentence = (
            f"{job.samples_per_period} samples a period are {total:.3g} samples of all points; the"
            f" limit is {MOST_SAMPLES_OF_STATISTICS:g}. Ask for fewer, or for fewer periods."
        )
        raise LimitExceeded([Problem(place, sentence)])


def _problems(job: SweepJob, joints: set[str]) -> Iterator[Problem]:
    for index, name in enumerate(job.statistics):
        place = f"/statistics/{index}"
        if name in job.statistics[:index]:
            yield Problem(place, f"'{name}' is listed twice; list it once.")
        if name in OF_CONTACTS and not joints:
            sentence = f"'{name}' is of joints with clearance, and this scene has none."
            yield Problem(place, sentence)
