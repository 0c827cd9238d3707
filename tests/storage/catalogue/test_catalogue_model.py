"""The catalogue against a plain model of it: any sequence of requests, faults and late workers."""

import itertools
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, ClassVar

import hypothesis.strategies as st
import pytest
from hypothesis import HealthCheck, Phase, settings
from hypothesis.stateful import (
    Bundle,
    RuleBasedStateMachine,
    invariant,
    multiple,
    precondition,
    rule,
    run_state_machine_as_test,
)

from jointplay.records.job import JobError
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import Fenced, KeyReused
from jointplay.storage.catalogue.records import (
    LEGAL_STEPS,
    BlockState,
    JobState,
    NewJob,
    SubmissionKey,
    Verdict,
)
from tests.postgresql_server import Server

LEASE = 30.0
MAX_ATTEMPTS = 3
KEY_SECONDS = 100.0
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


class CatalogueModel(RuleBasedStateMachine):
    """Of the database of which `made` makes a catalogue, and `drop` removes it."""

    blocks = Bundle("blocks")
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

    @precondition(lambda self: len(self.model) < 3)
    @rule(target=blocks, count=st.integers(1, 3), seal=st.booleans(),
          key=st.sampled_from([None, "k1", "k2"]),
          fingerprint=st.sampled_from(["one", "other"]))  # fmt: skip
    def submit(self, count: int, seal: bool, key: str | None, fingerprint: str) -> Any:
        new = NewJob("simulate", {"n": count}, "d" * 64, "1", blocks=((0, 1),) * count, seal=seal)
        submission_key = SubmissionKey(key, fingerprint, KEY_SECONDS) if key else None
        known = self.keys.get(key or "")
        if known and known[2] > self.now and known[1] != fingerprint:
            with pytest.raises(KeyReused):
                self.catalogue.submit(new, submission_key)
            return multiple()
        submitted = self.catalogue.submit(new, submission_key)
        if known and known[2] > self.now:
            assert (submitted.job.id, submitted.created) == (known[0], False)
            return multiple()
        assert submitted.created
        assert submitted.job.id not in self.model
        last = [ModelBlock(BlockState.waiting)] if seal else []
        self.model[submitted.job.id] = ModelJob(blocks=[ModelBlock() for _ in range(count)] + last)
        if key:
            self.keys[key] = (submitted.job.id, fingerprint, self.now + KEY_SECONDS)
        return multiple(*((submitted.job.id, index) for index in range(count + seal)))

    @rule(seconds=st.sampled_from([1.0, 20.0, 40.0, 200.0]))
    def wait(self, seconds: float) -> None:
        self.now += seconds

    @rule(block=blocks)
    def claim(self, block: tuple[str, int]) -> None:
        job, held, name = self.find(block)
        claim = self.catalogue.claim_block(name, "worker", LEASE)
        if held.state is not BlockState.queued or job.state.terminal:
            assert claim is None
            return
        assert claim is not None
        held.state = BlockState.running
        held.attempt += 1
        held.lease_until = self.now + LEASE
        if job.state is JobState.queued:
            job.state = JobState.running
        assert claim.block.attempt == held.attempt
        assert claim.block.watermark == held.watermark
        assert claim.job.state is job.state

    @rule(block=blocks, lag=st.integers(0, 1), fraction=st.floats(0, 1))
    def report(self, block: tuple[str, int], lag: int, fraction: float) -> None:
        job, held, name = self.find(block)
        attempt = held.attempt - lag
        verdict = self.as_holder(
            held,
            attempt,
            lambda: self.catalogue.record_progress(
                name, attempt, LEASE, time=fraction, fraction=fraction
            ),
        )
        if verdict is not None:
            held.lease_until = self.now + LEASE
            if fraction > held.fraction:
                held.losses = 0
            held.fraction = fraction
            go_on = job.state is JobState.running
            assert verdict is (Verdict.go_on if go_on else Verdict.cancel)
            assert self.catalogue.verdict(name, attempt) is verdict

    @rule(block=blocks, lag=st.integers(0, 1), watermark=st.integers(0, 1000))
    def checkpoint(self, block: tuple[str, int], lag: int, watermark: int) -> None:
        _, held, name = self.find(block)
        attempt = held.attempt - lag
        stored = self.as_holder(
            held,
            attempt,
            lambda: (
                self.catalogue.record_checkpoint(name, attempt, watermark=watermark, checkpoint="c")
                or True
            ),
        )
        if stored:
            held.watermark = watermark

    @rule(block=blocks, lag=st.integers(0, 1), failed=st.booleans())
    def finish(self, block: tuple[str, int], lag: int, failed: bool) -> None:
        job, held, name = self.find(block)
        attempt = held.attempt - lag
        outcome = BlockState.failed if failed else BlockState.done
        error = JobError("solver", "step-size-underflow", "why", 0.5) if failed else None
        state = self.as_holder(
            held, attempt, lambda: self.catalogue.finish(name, attempt, outcome, error)
        )
        if state is None:
            return
        held.state = outcome
        held.fraction = held.fraction if failed else 1.0
        if failed:
            self.fail(job, "solver")
        self.settle(job)
        assert state is job.state

    @rule(block=blocks)
    def stop_as_asked(self, block: tuple[str, int]) -> None:
        job, held, name = self.find(block)
        if held.state is not BlockState.running:
            return
        if job.state is JobState.running:
            with pytest.raises(ValueError, match="was not asked"):
                self.catalogue.finish(name, held.attempt, BlockState.cancelled)
            return
        self.catalogue.finish(name, held.attempt, BlockState.cancelled)
        held.state = BlockState.cancelled
        self.settle(job)

    @rule(block=blocks, lag=st.integers(0, 1))
    def release(self, block: tuple[str, int], lag: int) -> None:
        job, held, name = self.find(block)
        attempt = held.attempt - lag
        released = self.as_holder(
            held, attempt, lambda: self.catalogue.release(name, attempt) or True
        )
        if released:
            held.state = BlockState.cancelled if job.state.terminal else BlockState.queued

    @rule(block=blocks, lag=st.integers(0, 1))
    def put_off(self, block: tuple[str, int], lag: int) -> None:
        job, held, name = self.find(block)
        attempt = held.attempt - lag
        put_off = self.as_holder(
            held, attempt, lambda: self.catalogue.put_off(name, attempt, "waiting") or True
        )
        if put_off:
            held.state = BlockState.cancelled if job.state.terminal else BlockState.queued
            assert self.catalogue.get(block[0]).activity == "waiting"

    @rule(block=blocks)
    def cancel(self, block: tuple[str, int]) -> None:
        job, _ = block
        state = self.catalogue.request_cancel(job).state
        cancelled = self.model[job]
        if cancelled.state in (JobState.queued, JobState.running):
            for block in cancelled.blocks:
                if block.state in NOBODYS and block.attempt == 0:
                    block.state = BlockState.cancelled
            if cancelled.state is JobState.running:
                cancelled.state = JobState.cancelling
            self.settle(cancelled)
        assert state is cancelled.state

    @rule(block=blocks, lag=st.integers(0, 1))
    def compile(self, block: tuple[str, int], lag: int) -> None:
        _, held, name = self.find(block)
        attempt = held.attempt - lag
        noted = self.as_holder(
            held,
            attempt,
            lambda: self.catalogue.note_activity(name, attempt, "compiling") or True,
        )
        if noted:
            assert self.catalogue.get(block[0]).activity == "compiling"

    @rule(block=blocks)
    def lose_worker(self, block: tuple[str, int]) -> None:
        _, held, _ = self.find(block)
        if held.state is BlockState.running:
            self.now = max(self.now, held.lease_until + 1)
            self.reap()
            self.claim(block)

    @rule()
    def reap(self) -> None:
        reaped = self.catalogue.reap(MAX_ATTEMPTS)
        requeued = set()
        expired = [
            (held.lease_until, name, index)
            for name, job in self.model.items()
            for index, held in enumerate(job.blocks)
            if held.state is BlockState.running and held.lease_until < self.now
        ]
        for _, name, index in sorted(expired):
            job, held = self.model[name], self.model[name].blocks[index]
            held.losses += 1
            if held.losses < MAX_ATTEMPTS and not job.state.terminal:
                held.state = BlockState.queued
                requeued.add(f"{name}-{index}")
            elif job.state is JobState.running:
                held.state = BlockState.failed
                self.fail(job, "platform")
            else:
                held.state = BlockState.cancelled
                self.settle(job)
        assert requeued == set(reaped.requeued)

    @rule(outstanding=st.integers(0, 4))
    def relay(self, outstanding: int) -> None:
        due = self.catalogue.due_wake_ups(outstanding)
        assert len(due) <= outstanding
        self.catalogue.mark_published(tuple(wake_up.block for wake_up in due), 20.0)

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


def tried(examples: int, made: Callable[[], str], drop: Callable[[str], None]) -> None:
    """Compare catalogue and model over some sequences."""

    class OfThisDatabase(CatalogueModel):
        pass

    OfThisDatabase.made, OfThisDatabase.drop = staticmethod(made), staticmethod(drop)
    chosen = settings(
        max_examples=examples,
        stateful_step_count=30,
        deadline=None,
        derandomize=True,
        phases=(Phase.explicit, Phase.generate),  # shrinking takes minutes: do it by hand
        suppress_health_check=[HealthCheck.too_slow],
    )
    run_state_machine_as_test(OfThisDatabase, settings=chosen)  # type: ignore[no-untyped-call]


def test_the_catalogue_is_as_its_model_in_sqlite(new_file: Callable[[], str]) -> None:
    tried(60, new_file, lambda url: Path(url.removeprefix("sqlite:///")).unlink())


@pytest.mark.parametrize("examples", [4, pytest.param(60, marks=pytest.mark.long)])
def test_the_catalogue_is_as_its_model_in_postgresql(postgresql: Server, examples: int) -> None:
    tried(examples, postgresql.new, postgresql.drop)
