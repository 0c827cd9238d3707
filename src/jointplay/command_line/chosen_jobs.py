"""Jobs that a command acts on: by their ids, or all of a service that fit."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated, NamedTuple

import typer

from jointplay.command_line.exits import Stopped

if TYPE_CHECKING:
    from jointplay.client import Client, Job

IDS = Annotated[list[str] | None, typer.Argument(metavar="[ID]...", help="Ids of jobs.")]
BATCH = Annotated[str | None, typer.Option(metavar="ID", help="The jobs of this batch.")]
KIND = Annotated[str | None, typer.Option(help="Only jobs of this kind.")]
LABEL = Annotated[str | None, typer.Option(help="Only jobs with exactly this label.")]
SCENE = Annotated[str | None, typer.Option(help="Only jobs of this preset or scene.")]
YES = Annotated[bool, typer.Option("--yes", help="Do not ask.")]


class Filters(NamedTuple):
    """Facts that jobs have in common; None: anything."""

    state: str | None
    kind: str | None
    label: str | None
    scene: str | None

    @property
    def given(self) -> bool:
        """Whether anything is asked for."""
        return any(one is not None for one in self)

    def fit(self, job: "Job") -> bool:
        """Whether a job of a batch is one of them."""
        shown = job.state, job.kind, self.label in job.labels and self.label, job.scene_name
        return all(one in (None, found) for one, found in zip(self, shown, strict=True))


def refuse_empty(ids: Sequence[str] | None, batch: str | None, filters: Filters) -> None:
    """Stop where one is empty, as that of a variable that is not set: it does not mean all jobs."""
    named = {**filters._asdict(), "batch": batch}
    for name, one in named.items():
        if one == "":
            raise Stopped(f"--{name} is empty; say which, or leave it out.")
    if "" in (ids or ()):
        raise Stopped("The id of a job is empty.")


def chosen(
    client: "Client",
    ids: Sequence[str] | None,
    batch: str | None,
    filters: Filters,
    states: Sequence[str],
) -> "list[Job]":
    """Return the jobs that are meant; those that are not named are in one of the states.

    Raises
    ------
    Stopped
        Nothing says which, two things do, or a state is none of those.
    """
    if ids and (batch or filters.given):
        raise Stopped("Give ids of jobs, or say by --batch, --state and so on which; not both.")
    if not (ids or batch or filters.given):
        raise Stopped("Which jobs? Give their ids, --batch, --state, --kind, --label or --scene.")
    if filters.state is not None and filters.state not in states:
        raise Stopped(f"--state is {' or '.join(states)}, not {filters.state!r}.")
    if ids:
        return [client.job(one) for one in ids]
    if batch is not None:
        found = [job for job in client.batch(batch).jobs() if filters.fit(job)]
    else:
        found = list(client.jobs(**filters._asdict()))
    return [job for job in found if job.state in states]


def agree(question: str, *, yes: bool) -> None:
    """Ask on a terminal; stop where the answer is no, or where nobody can be asked."""
    import sys

    if yes:
        return
    if not sys.stdin.isatty():
        raise Stopped(f"{question} Say --yes: there is no terminal to ask.")
    if not typer.confirm(question):
        raise Stopped("Nothing was done.")
