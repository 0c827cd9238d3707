"""Whatever happens to an object of an installation is found, and the job that it is of marked."""

import itertools
from random import Random

import pytest

from jointplay.storage.catalogue.records import JobState
from tests.storage.reconciliation.harms import Harm, empty, flip, remove, swap, truncate
from tests.storage.reconciliation.installation import Installed

HARMS = (flip, truncate, empty, remove, swap)
SUBJECTS: dict[str, tuple[str, str]] = {
    "succeeded": ("", "swept"),
    "swept": ("", "succeeded"),
    "cancelled": ("", "succeeded"),
    "cut short": ("study/documents.zip", "cut short, too"),
    "cut short, too": ("study/parts/00000", "cut short"),
    "given up": ("a1/documents.zip", "running"),
}
"""By job: the object that is harmed, the sealed one if it has no name; the job of the other one."""
EVERY_HARM = [
    one
    for one in itertools.product(SUBJECTS, HARMS, ("in_a_folder", "in_servers"))
    if one[:2] != ("cancelled", remove)  # nobody knows whether it had begun
]
SAMPLED = Random(5).sample(EVERY_HARM, 6)


@pytest.mark.parametrize(
    ("subject", "harm", "installed"),
    [one if one in SAMPLED else pytest.param(*one, marks=pytest.mark.long) for one in EVERY_HARM],
    indirect=["installed"],
)
def test_whatever_happens_to_an_object_is_found_and_its_job_is_marked(
    installed: Installed, subject: str, harm: Harm
) -> None:
    name, other = SUBJECTS[subject]
    one, two = (
        installed.running(label).object(name) if name else installed.sealed(label)
        for label in (subject, other)
    )
    harm(one, two)
    found = {one.subjects: one for one in installed.mend()}
    mine = f"job {installed.jobs[subject]}"
    assert (mine,) in found, found
    assert found[mine,].mended == "marked as damaged"
    harmed = {mine, f"job {installed.jobs[other]}"} if harm is swap else {mine}
    assert {subjects[0] for subjects in found} <= harmed
    left = {one.subjects: (one.found, one.mend) for one in installed.look()}
    assert left == {subjects: (one.found, None) for subjects, one in found.items()}
    assert installed.catalogue.get(installed.jobs[subject]).damaged == found[mine,].found


def test_a_job_with_damaged_results_is_marked(installed: Installed) -> None:
    flip(installed.sealed("succeeded"))
    installed.mend()
    job = installed.catalogue.get(installed.jobs["succeeded"])
    assert installed.sealed("succeeded").key in str(job.damaged)
    assert job.state is JobState.succeeded
