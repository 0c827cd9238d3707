"""The catalogue against a plain model of it: any sequence of requests, faults and late workers."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import hypothesis.strategies as st
import pytest
from hypothesis import HealthCheck, Phase, settings
from hypothesis.stateful import (
    Bundle,
    multiple,
    precondition,
    rule,
    run_state_machine_as_test,
)

from jointplay.records.job import JobError
from jointplay.storage.catalogue.errors import KeyReused
from jointplay.storage.catalogue.records import (
    BlockEnd,
    BlockState,
    JobState,
    NewJob,
    SubmissionKey,
    Verdict,
)
from tests.postgresql_server import Server
from tests.storage.catalogue.modelled import NOBODYS, ModelBlock, ModelJob, ModelledCatalogue

LEASE = 30.0
MAX_ATTEMPTS = 3
KEY_SECONDS = 100.0


class CatalogueModel(ModelledCatalogue):
    """Requests to a catalogue, faults of workers, and what the model says that comes of them."""

    blocks = Bundle("blocks")

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
            held, attempt, lambda: self.catalogue.finish(name, attempt, BlockEnd(outcome, error))
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
                self.catalogue.finish(name, held.attempt, BlockEnd(BlockState.cancelled))
            return
        self.catalogue.finish(name, held.attempt, BlockEnd(BlockState.cancelled))
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


@pytest.mark.parametrize("examples", [20, pytest.param(200, marks=pytest.mark.long)])
def test_the_catalogue_is_as_its_model_in_sqlite(
    examples: int, new_file: Callable[[], str]
) -> None:
    tried(examples, new_file, lambda url: Path(url.removeprefix("sqlite:///")).unlink())


@pytest.mark.parametrize("examples", [4, pytest.param(60, marks=pytest.mark.long)])
def test_the_catalogue_is_as_its_model_in_postgresql(postgresql: Server, examples: int) -> None:
    tried(examples, postgresql.new, postgresql.drop)
