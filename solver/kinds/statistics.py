"""Statistics that a sweep asks for: whether they can be had, and how many they are."""

from collections.abc import Collection, Iterator, Sequence
from typing import Annotated

from pydantic import Field

from jointplay.records.failure import InvalidInput, LimitExceeded, Problem
from jointplay.solver.kinds.idle_fields import check_idle
from jointplay.solver.kinds.job import MechanismJob
from jointplay.solver.kinds.limits import MOST_SAMPLES_OF_STATISTICS, MOST_STATISTICS
from jointplay.solver.quantities.registry import NameIn
from jointplay.solver.quantities.units import quantity
from jointplay.solver.runs.study.fields import is_clearance
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.scene.pairs import pairs_of
from jointplay.solver.statistics import OF_CHANNELS, OF_CONTACTS, STATISTICS, Output, outputs_of

StatisticName = Annotated[str, NameIn(STATISTICS)]
StatisticChoice = Annotated[
    list[StatisticName],
    Field(
        max_length=16,
        description=(
            "kept beside the peaks, over the time after settling; impacts (beginnings of"
            " contact), largest_impact_force (N) and contact_share (0 to 1) are of each joint"
            " with clearance, the others of each channel, in its unit"
        ),
        examples=[["mean", "root_mean_square"]],
    ),
]
SamplesPerPeriod = Annotated[
    int,
    quantity(
        "1",
        ge=16,
        le=4096,
        description=(
            "equally spaced samples in a period, from which statistics of channels are made;"
            " without a common period, in the scene's own time scale instead"
        ),
    ),
]


def statistic_count(names: Sequence[str], channels: int, pairs: int) -> int:
    """Return how many numbers a point has of the statistics of channels and contact pairs."""
    of_contacts = sum(name in OF_CONTACTS for name in names)
    return (len(names) - of_contacts) * channels + of_contacts * pairs


def statistic_outputs(study: Study) -> dict[str, Output]:
    """Return unit and long name of the statistics of channels and contacts that a job chose."""
    joints = study.point_scene(0).joints
    paths = [leaf.path for leaf in study.scenes.leaves]
    varied = {path.split("/")[2] for path in paths if is_clearance(study.scenes.base, path)}
    loose = [name for name, joint in joints.items() if joint.has_play or name in varied]
    pairs = tuple(pair.name for name in loose for pair in pairs_of(name, joints[name]))
    return outputs_of(study.statistics, study.channels, pairs)


def check_statistics(names: Sequence[str], pairs: Collection[str], channels: int) -> None:
    """Refuse statistics that cannot be had of these pairs and so many channels, or are too many.

    The first with InvalidInput, as what is asked for twice, the second with LimitExceeded.
    """
    if problems := list(_problems(names, pairs, channels)):
        raise InvalidInput(problems)
    count = statistic_count(names, channels, len(pairs))
    if count > MOST_STATISTICS:
        of_contacts = sum(name in OF_CONTACTS for name in names)
        sentence = (
            f"{len(names) - of_contacts} statistics of {channels} channels and {of_contacts} of"
            f" {len(pairs)} pairs are {count} numbers a point; the limit is {MOST_STATISTICS}."
            " Choose fewer statistics, or fewer 'channels'."
        )
        raise LimitExceeded.at("/statistics", sentence)


def check_samples(job: MechanismJob, study: Study) -> None:
    """Refuse less than two samples of a point (InvalidInput), and too many (LimitExceeded).

    Statistics of contacts take none: beside them alone their number is refused (InvalidInput).
    """
    if OF_CHANNELS.keys().isdisjoint(study.statistics):
        check_idle(job, "'statistics' of channels", "samples_per_period")
        return
    per_period = study.job["samples_per_period"]
    left = study.duration - study.settle
    samples = left / study.period * per_period
    pointer = "/samples_per_period"
    if samples.min() < 2.0:
        point = int(samples.argmin())
        least = 2.0 * study.period[point] / per_period
        sentence = (
            f"At point {point} only {left[point]:g} s are left after settling,"
            f" less than two samples; statistics need {least:.3g} s, or more samples a period."
        )
        raise InvalidInput.at(pointer, sentence)
    total = float(samples.sum())
    if total > MOST_SAMPLES_OF_STATISTICS:
        sentence = (
            f"{per_period} samples a period are {total:.3g} samples of all points; the"
            f" limit is {MOST_SAMPLES_OF_STATISTICS:g}. Ask for fewer, or for fewer periods."
        )
        raise LimitExceeded.at(pointer, sentence)


def _problems(names: Sequence[str], pairs: Collection[str], channels: int) -> Iterator[Problem]:
    for index, name in enumerate(names):
        pointer = f"/statistics/{index}"
        if name in names[:index]:
            yield Problem(pointer, f"'{name}' is listed twice; list it once.")
        if name in OF_CONTACTS and not pairs:
            sentence = f"'{name}' is of joints with clearance, and this scene has none."
            yield Problem(pointer, sentence)
        if name in OF_CHANNELS and not channels:
            yield Problem(pointer, f"'{name}' is of channels; name them in 'channels'.")
