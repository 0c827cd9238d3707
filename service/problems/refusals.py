"""From the exceptions of every layer to what clients are told: the only place that knows both.

Those of HTTP itself are added by `handlers`, so that processes without it need not load it.
"""

from functools import singledispatch

from jointplay.records.failure import InvalidInput, LimitExceeded
from jointplay.records.strict_json import MalformedJson
from jointplay.service.problems import (
    MOST_ERRORS,
    ErrorDetail,
    RequestRefused,
    clipped,
    kinds,
    unavailable,
)
from jointplay.storage.catalogue.errors import (
    BatchNotFinished,
    BatchNotFound,
    Fenced,
    JobNotFinished,
    KeyReused,
    QuotaExceeded,
    RetriedMeanwhile,
    TooManyWorkers,
    Unavailable,
)
from jointplay.worker.handed_in.errors import NotTheJobs


@singledispatch
def refusal(error: Exception) -> RequestRefused:
    """Return the answer to an exception; this one is of no known kind."""
    return RequestRefused(kinds.INTERNAL, "The service failed; its log says why.")


@refusal.register
def _(error: RequestRefused) -> RequestRefused:
    return error


@refusal.register
def _(error: MalformedJson) -> RequestRefused:
    errors = [ErrorDetail(pointer=clipped(f.pointer), detail=f.detail) for f in error.flaws]
    return RequestRefused(kinds.MALFORMED_JSON, errors[0].detail, errors)


@refusal.register
def _(error: InvalidInput) -> RequestRefused:
    kind = kinds.LIMIT_EXCEEDED if isinstance(error, LimitExceeded) else kinds.INVALID_JOB
    errors = [
        ErrorDetail(pointer=clipped(one.pointer), detail=clipped(one.detail))
        for one in error.problems[:MOST_ERRORS]
    ]
    count = len(error.problems)
    detail = errors[0].detail if count == 1 else f"{count} fields are wrong."
    return RequestRefused(kind, detail, errors)


@refusal.register
def _(error: ConnectionError) -> RequestRefused:
    """Another server that answers are made of, such as that of the results, is away."""
    detail = "The results cannot be reached at the moment; they are not lost."
    return RequestRefused(kinds.UNAVAILABLE, detail, headers={"Retry-After": "5"})


@refusal.register
def _(error: Unavailable) -> RequestRefused:
    kind = kinds.DISK_FULL if error.full else kinds.UNAVAILABLE
    detail = f"T{str(error)[1:]}; nothing was recorded."
    return RequestRefused(kind, detail, headers={"Retry-After": "5"})


@refusal.register
def _(error: Fenced) -> RequestRefused:
    return RequestRefused(kinds.NOT_HELD, f"A{str(error)[1:]}.")


@refusal.register
def _(error: NotTheJobs) -> RequestRefused:
    return RequestRefused(kinds.RESULTS_REFUSED, f"The block was taken back: {error}.")


@refusal.register
def _(error: KeyReused) -> RequestRefused:
    sentence = f"T{str(error)[1:]}."  # which quotes a key: its letters stay as they are
    errors = [ErrorDetail(parameter="Idempotency-Key", detail=clipped(sentence))]
    return RequestRefused(kinds.KEY_REUSED, sentence, errors)


@refusal.register
def _(error: QuotaExceeded) -> RequestRefused:
    return RequestRefused(kinds.QUOTA_EXCEEDED, f"{error}.")


@refusal.register
def _(error: RetriedMeanwhile) -> RequestRefused:
    return unavailable(f"A{str(error)[1:]}.", 1)


@refusal.register
def _(error: TooManyWorkers) -> RequestRefused:
    return RequestRefused(kinds.TOO_MANY_REQUESTS, f"{error}.", headers={"Retry-After": "60"})


@refusal.register
def _(error: JobNotFinished) -> RequestRefused:
    return RequestRefused(kinds.NOT_FINISHED, f"J{str(error)[1:]}.")


@refusal.register
def _(error: BatchNotFinished) -> RequestRefused:
    return RequestRefused(kinds.NOT_FINISHED, f"{error}.")


@refusal.register
def _(error: BatchNotFound) -> RequestRefused:
    return RequestRefused(kinds.UNKNOWN_BATCH, f"T{str(error)[1:]}.")
