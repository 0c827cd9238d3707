"""`AsyncBatch`: jobs that were submitted together, awaited."""

from jointplay.client.asynchronous.job import AsyncJob
from jointplay.client.asynchronous.verbs import awaited, changing, iterated
from jointplay.client.batch_record import BatchRecord
from jointplay.client.batches import Batch


class AsyncBatch(BatchRecord):
    """A `Batch` whose verbs are awaited; its record is at hand."""

    __slots__ = ("_blocking",)

    def __init__(self, batch: Batch) -> None:
        self.__dict__ = vars(batch)  # one record: what the one learns the other knows
        self._blocking = batch

    jobs = iterated(Batch.jobs, AsyncJob)
    refresh = changing(Batch.refresh)
    cancel = changing(Batch.cancel)
    retry = awaited(Batch.retry, lambda batch: AsyncBatch(batch))
    delete = awaited(Batch.delete)
    wait = changing(Batch.wait)
