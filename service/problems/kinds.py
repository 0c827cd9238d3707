"""The problems that exist, each with its status and what a client can do about it."""

from typing import NamedTuple


class Kind(NamedTuple):
    """One kind of problem; its ``type`` is ``/problems/{name}``."""

    name: str
    status: int
    title: str
    help: str

    @property
    def type(self) -> str:
        """The URI reference that identifies the kind, and where it is explained."""
        return f"/problems/{self.name}"


MALFORMED_JSON = Kind(
    "malformed-json",
    400,
    "The body is not JSON",
    "Send JSON as RFC 8259 defines it: UTF-8, finite numbers (no NaN, nothing beyond 1.7e308), "
    "no key twice in one object, at most 64 levels. `errors` points at each place.",
)
INVALID_JOB = Kind(
    "invalid-job",
    422,
    "The job cannot be run as it is described",
    "Correct the fields that `errors` points at; each sentence says what would be right. "
    "The job's schema is in /openapi.json.",
)
LIMIT_EXCEEDED = Kind(
    "limit-exceeded",
    422,
    "The job is larger than this service takes",
    "Each sentence of `errors` gives the estimate and the limit: shorten the duration, widen the "
    "output step, select fewer channels, or take fewer points.",
)
INVALID_REQUEST = Kind(
    "invalid-request",
    422,
    "A parameter of the request is wrong",
    "Correct the parameters that `errors` names.",
)
UNKNOWN_CHANNEL = Kind(
    "unknown-channel",
    422,
    "The job has no such channel",
    "Name channels as the job's `peaks` lists them, or by globs such as `A.*`.",
)
RESPONSE_TOO_LARGE = Kind(
    "response-too-large",
    422,
    "The answer would be too large",
    "Ask for fewer channels or a shorter window with `channels`, `start` and `stop`.",
)
UNKNOWN_JOB = Kind(
    "unknown-job",
    404,
    "There is no such job",
    "List the jobs with GET /v1/jobs.",
)
EXPIRED_JOB = Kind(
    "expired-job",
    410,
    "The job has expired",
    "It and its results were removed; submit its document again to compute it once more.",
)
NOT_FINISHED = Kind(
    "not-finished",
    409,
    "The job is not finished",
    "Cancel it with POST /v1/jobs/{id}/cancel and wait for its end first.",
)
KEY_REUSED = Kind(
    "key-reused",
    422,
    "The Idempotency-Key belongs to another request",
    "Send a new key with each new request, and the same key only with the same body.",
)
KEY_IN_FLIGHT = Kind(
    "key-in-flight",
    409,
    "A request with this Idempotency-Key is being answered",
    "Send the request again after the seconds that Retry-After gives.",
)
UNKNOWN_BATCH = Kind(
    "unknown-batch",
    404,
    "There is no such batch",
    "POST /v1/batches answers with the batch's id and address.",
)
WRONG_KIND = Kind(
    "wrong-kind",
    404,
    "A job of this kind has no such result",
    "The job's `links`, and the problem's `detail`, lead to the results that it has.",
)
UNKNOWN_SCENE = Kind(
    "unknown-scene",
    404,
    "There is no such scene",
    "List the scenes with GET /v1/scenes.",
)
UNKNOWN_FIGURE = Kind(
    "unknown-figure",
    404,
    "The job has no such figure",
    "The problem's `detail` lists the figures that the job has.",
)
NOT_DRAWABLE = Kind(
    "not-drawable",
    422,
    "The figure cannot be drawn of these results",
    "The problem's `detail` names what is missing, such as channels that the job did not store.",
)
NO_RESULTS = Kind(
    "no-results",
    404,
    "The job ended before anything was computed",
    "Its `error` says why; correct the cause and submit it again.",
)
RESULTS_NOT_READY = Kind(
    "results-not-ready",
    409,
    "There are no results yet",
    "Ask again in a moment: results can be read as soon as the job runs and has committed some.",
)
BODY_TOO_LARGE = Kind(
    "body-too-large",
    413,
    "The body is too large",
    "A job is a few kilobytes; the limit is in the problem's `detail`.",
)
NOT_JSON = Kind(
    "unsupported-media-type",
    415,
    "The body has another media type",
    "Send the job with Content-Type: application/json, for example with `curl --json @job.json`.",
)
NOT_FOUND = Kind(
    "not-found",
    404,
    "There is nothing at this address",
    "The addresses are in /openapi.json, readable at /docs.",
)
RANGE_NOT_SATISFIABLE = Kind(
    "range-not-satisfiable",
    416,
    "The range has none of the bytes",
    "Content-Range gives the size; a range such as `bytes=-260` means the last bytes.",
)
NOT_ACCEPTABLE = Kind(
    "not-acceptable",
    406,
    "There is no such form of the answer",
    "The problem's `detail` lists the media types that Accept can ask for.",
)
METHOD_NOT_ALLOWED = Kind(
    "method-not-allowed",
    405,
    "This address does not know the method",
    "/docs describes the methods of every address.",
)
UNAVAILABLE = Kind(
    "unavailable",
    503,
    "The service cannot do this at the moment",
    "Try again after the seconds that Retry-After gives.",
)
INTERNAL = Kind(
    "internal-error",
    500,
    "The service failed",
    "This is a fault of the service: its log says more. Please report it with what you sent.",
)

ALL = {kind.name: kind for kind in [*globals().values()] if isinstance(kind, Kind)}
OF_RESULTS = (
    UNKNOWN_JOB,
    EXPIRED_JOB,
    WRONG_KIND,
    NO_RESULTS,
    RESULTS_NOT_READY,
    INVALID_REQUEST,
    UNKNOWN_CHANNEL,
    RESPONSE_TOO_LARGE,
)
"""Problems of every address where a job's results are read."""
