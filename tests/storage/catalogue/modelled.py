"""A catalogue beside a plain model of it, and all that both must agree on."""

import itertools
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, ClassVar

import pytest
from hypothesis.stateful import (
    RuleBasedStateMachine,
    invariant,
    precondition,
)

from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import Fenced
from jointplay.storage.catalogue.records import (
    LEGAL_STEPS,
    BlockState,
    JobState,
)

LIVE = (BlockState.queued, BlockState.running)
NOBODYS = (BlockState.queued, BlockState.waiting)


@dataclass
class ModelBlock:
    state: BlockState = BlockState.queued
    attempt: int = 0
    losses: int = 0
    fraction: float = 0.0
    lease_until: float = 0.0
    watermark: int = 0


@dataclass
class ModelJob:
    state: JobState = JobState.queued
    blocks: list[ModelBlock] = field(default_factory=list)
    error_class: str | None = None


class ModelledCatalogue(RuleBasedStateMachine):
    """A catalogue and its model, in a database that `made` makes and `drop` removes."""

    made: ClassVar[Callable[[], str]]
    drop: ClassVar[Callable[[str], None]]

    def __init__(self) -> None:
        super().__init__()
        self.url = type(self).made()
        self.now = 1_800_000_000.0
        self.catalogue = Catalogue(self.url, clock=lambda: self.now)
        self.model: dict[str, ModelJob] = {}
        self.keys: dict[str, tuple[str, str, float]] = {}

    def teardown(self) -> None:
        self.catalogue.close()
        type(self).drop(self.url)

    def find(self, block: tuple[str, int]) -> tuple[ModelJob, ModelBlock, str]:
        job = self.model[block[0]]
        return job, job.blocks[block[1]], f"{block[0]}-{block[1]}"

    def settle(self, job: ModelJob) -> None:
        if {block.state for block in job.blocks} == {BlockState.done, BlockState.waiting}:
            job.blocks[-1].state = BlockState.queued
        if not any(block.state in LIVE for block in job.blocks) and not job.state.terminal:
            done = all(block.state is BlockState.done for block in job.blocks)
            job.state = JobState.succeeded if done else JobState.cancelled

    def fail(self, job: ModelJob, error_class: str) -> None:
        if not job.state.terminal:
            job.state, job.error_class = JobState.failed, error_class
        for block in job.blocks:
            if block.state in NOBODYS:
                block.state = BlockState.cancelled

    def as_holder(self, block: ModelBlock, attempt: int, act: Callable[[], Any]) -> Any:
        """Do it if the model says this attempt holds the block, else expect to be fenced."""
        if block.state is BlockState.running and block.attempt == attempt:
            return act()
        with pytest.raises(Fenced):
            act()
        return None

    @precondition(lambda self: self.model)
    @invariant()
    def catalogue_and_model_agree(self) -> None:
        listed = {job.id: job for job in self.catalogue.jobs(limit=1000).jobs}
        assert listed.keys() == self.model.keys()
        for name, model in self.model.items():
            job = listed[name]
            assert job.state is model.state
            assert (job.error.error_class if job.error else None) == model.error_class
            assert (job.finished is not None) == model.state.terminal
            assert job.attempt == max(block.attempt for block in model.blocks)
            stored = self.catalogue.blocks(name)
            assert [(b.state, b.attempt, b.losses, b.watermark) for b in stored] == [
                (b.state, b.attempt, b.losses, b.watermark) for b in model.blocks
            ]

    @invariant()
    def exactly_the_queued_blocks_are_in_the_outbox(self) -> None:
        before, self.now = self.now, self.now + 1e9  # when every wake-up is due again
        due = {wake_up.block for wake_up in self.catalogue.due_wake_ups(10_000)}
        self.now = before
        assert due == {
            f"{name}-{index}"
            for name, job in self.model.items()
            for index, block in enumerate(job.blocks)
            if block.state is BlockState.queued
        }

    @invariant()
    def histories_are_legal_and_without_gaps(self) -> None:
        for name, model in self.model.items():
            events = self.catalogue.events(name)
            assert [event.seq for event in events] == list(range(1, len(events) + 1))
            states = [JobState(e.type) for e in events if e.type in set(JobState)]
            assert states[0] is JobState.queued
            assert states[-1] is model.state
            for before, after in itertools.pairwise(states):
                assert after in LEGAL_STEPS[before]
            open_attempts = [a for a in self.catalogue.attempts(name) if a.ended is None]
            running = [b for b in model.blocks if b.state is BlockState.running]
            assert len(open_attempts) == len(running)
