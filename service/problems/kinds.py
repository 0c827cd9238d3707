"""The problems that exist, each with its status and what a client can do about it."""

from dataclasses import dataclass
from typing import Annotated

from pydantic import Field


@dataclass(frozen=True)
class ProblemKind:
    """Explains one kind of problem."""

    type: Annotated[str, Field(description="As in the problem documents.")]
    title: str
    status: Annotated[int, Field(description="HTTP status of such a problem.")]
    help: Annotated[str, Field(description="What a client can do about it.")]


def _kind(name: str, status: int, title: str, remedy: str) -> ProblemKind:
    return ProblemKind(f"/problems/{name}", title, status, remedy)


MALFORMED_JSON = _kind(
    "malformed-json",
    400,
    "The body is not JSON",
    "Send JSON as RFC 8259 defines it: UTF-8, finite numbers (no NaN, nothing beyond 1.7e308), "
    "no key twice in one object, at most 64 levels. `errors` points at each place.",
)
NO_REQUEST = _kind(
    "no-request",
    400,
    "That is no HTTP request",
    "Send HTTP/1.1 as RFC 9112 defines it, with a head of at most 256 KiB.",
)
INVALID_JOB = _kind(
    "invalid-job",
    422,
    "The job cannot be run as it is described",
    "Correct the fields that `errors` points at; each sentence says what would be right. "
    "The job's schema is in /openapi.json.",
)
LIMIT_EXCEEDED = _kind(
    "limit-exceeded",
    422,
    "The job is larger than this service takes",
    "Each sentence of `errors` gives the estimate and the limit: shorten the duration, widen the "
    "output step, select fewer channels, or take fewer points.",
)
INVALID_REQUEST = _kind(
    "invalid-request",
    422,
    "A parameter of the request is wrong",
    "Correct the parameters that `errors` names.",
)
UNKNOWN_CHANNEL = _kind(
    "unknown-channel",
    422,
    "The job has no such channel",
    "Name channels as the job's `peaks` lists them, or by globs such as `A.*`.",
)
RESPONSE_TOO_LARGE = _kind(
    "response-too-large",
    422,
    "The answer would be too large",
    "Ask for fewer channels or a shorter window with `channels`, `start` and `stop`.",
)
KEY_MISSING = _kind(
    "key-missing",
    401,
    "A valid key is missing",
    "Send Authorization: Bearer and a key, which `jointplay key new` makes where the service runs; "
    "the client and the command line take it from JOINTPLAY_KEY.",
)
SCOPE_MISSING = _kind(
    "scope-missing",
    403,
    "The key is not for this",
    "Use a key that has the scope which the problem's `detail` names.",
)
TOO_MANY_REQUESTS = _kind(
    "too-many-requests",
    429,
    "These are too many requests",
    "Wait for the seconds that Retry-After gives; the client does so by itself. Wait for jobs with "
    "?wait=30 or events, and send many jobs as a batch.",
)
QUOTA_EXCEEDED = _kind(
    "quota-exceeded",
    403,
    "That is more than the key's owner may have",
    "Wait until some jobs have ended, cancel or delete some, or come back later: the problem's "
    "`detail` names what there is too much of, and GET /v1/usage shows all of it.",
)
FOREIGN_HOST = _kind(
    "foreign-host",
    403,
    "The request was sent by, or to, another site",
    "Use the address that the service announced; its administrator can add names with "
    "JOINTPLAY_HOSTS.",
)
UNKNOWN_JOB = _kind("unknown-job", 404, "There is no such job", "List the jobs with GET /v1/jobs.")
EXPIRED_JOB = _kind(
    "expired-job",
    410,
    "The job has expired",
    "It and its results were removed; submit its document again to compute it once more.",
)
DAMAGED_RESULTS = _kind(
    "damaged-results",
    410,
    "Files of the job's results are damaged",
    "The problem's `detail` names the file. The bytes are lost, and nothing of them is served: "
    "POST the job's document again, which computes it anew, or restore the file from a copy.",
)
NOT_FINISHED = _kind(
    "not-finished",
    409,
    "The job is not finished",
    "Cancel it with POST /v1/jobs/{id}/cancel, or /v1/batches/{id}/cancel, and wait for its end "
    "first.",
)
NOTHING_TO_RETRY = _kind(
    "nothing-to-retry",
    409,
    "There is nothing to retry",
    "Only a job that failed or was cancelled can be retried; GET it, or the batch, for its state. "
    "To compute another one once more, post its document with `cache: false`.",
)
KEY_REUSED = _kind(
    "key-reused",
    422,
    "The Idempotency-Key belongs to another request",
    "Send a new key with each new request, and the same key only with the same bytes as body.",
)
KEY_IN_FLIGHT = _kind(
    "key-in-flight",
    409,
    "A request with this Idempotency-Key is being answered",
    "Send the request again after the seconds that Retry-After gives.",
)
UNKNOWN_BATCH = _kind(
    "unknown-batch",
    404,
    "There is no such batch",
    "POST /v1/batches answers with the batch's id and address.",
)
WRONG_KIND = _kind(
    "wrong-kind",
    404,
    "A job of this kind has no such result",
    "The job's `links`, and the problem's `detail`, lead to the results that it has.",
)
UNKNOWN_SCENE = _kind(
    "unknown-scene", 404, "There is no such scene", "List the scenes with GET /v1/scenes."
)
UNKNOWN_FIGURE = _kind(
    "unknown-figure",
    404,
    "The job has no such figure",
    "The problem's `detail` lists the figures that the job has.",
)
NOT_DRAWABLE = _kind(
    "not-drawable",
    422,
    "The figure cannot be drawn of these results",
    "The problem's `detail` names what is missing, such as channels that the job did not store.",
)
NO_RESULTS = _kind(
    "no-results",
    404,
    "The job ended before anything was computed",
    "Its `error` says why; correct the cause and submit it again.",
)
RESULTS_NOT_READY = _kind(
    "results-not-ready",
    409,
    "There are no results yet",
    "Ask again in a moment: results can be read as soon as the job runs and has committed some.",
)
NOT_HELD = _kind(
    "not-held",
    409,
    "The attempt does not hold the block",
    "Another worker has it by now, or the job has ended: drop what was computed, and claim again.",
)
RESULTS_REFUSED = _kind(
    "results-refused",
    422,
    "The results are not those of the block",
    "The block was taken back and is computed anew: drop what was computed, and claim again. The "
    "problem's `detail` says what is wrong.",
)
OTHER_VERSION = _kind(
    "other-version",
    409,
    "The worker is of another version",
    "Install the version of jointplay that the problem's `detail` names, and join again.",
)
BODY_TOO_LARGE = _kind(
    "body-too-large",
    413,
    "The body is too large",
    "A job is a few kilobytes; the limit is in the problem's `detail`.",
)
BODY_TOO_SLOW = _kind(
    "body-too-slow",
    408,
    "The body arrived too slowly",
    "Send it again over a faster connection, or in smaller batches; the limit is in `detail`.",
)
NOT_JSON = _kind(
    "unsupported-media-type",
    415,
    "The body has another media type",
    "Send the job with Content-Type: application/json, for example with `curl --json @job.json`.",
)
NOT_FOUND = _kind(
    "not-found",
    404,
    "There is nothing at this address",
    "The addresses are in /openapi.json, readable at /docs.",
)
PRECONDITION_FAILED = _kind(
    "precondition-failed",
    412,
    "It has changed since",
    "ETag is that of the bytes that are there now; ask without If-Match to have them.",
)
RANGE_NOT_SATISFIABLE = _kind(
    "range-not-satisfiable",
    416,
    "The range has none of the bytes",
    "Content-Range gives the size; a range such as `bytes=-260` means the last bytes.",
)
NOT_ACCEPTABLE = _kind(
    "not-acceptable",
    406,
    "There is no such form of the answer",
    "The problem's `detail` lists the media types that Accept can ask for.",
)
METHOD_NOT_ALLOWED = _kind(
    "method-not-allowed",
    405,
    "This address does not know the method",
    "/docs describes the methods of every address.",
)
DISK_FULL = _kind(
    "disk-full",
    507,
    "There is no room for further results",
    "Nothing was recorded. Make room on the disk of the service, or delete jobs, and try again "
    "after the seconds that Retry-After gives; jobs that wait go on by themselves.",
)
UNAVAILABLE = _kind(
    "unavailable",
    503,
    "The service cannot do this at the moment",
    "Try again after the seconds that Retry-After gives.",
)
INTERNAL = _kind(
    "internal-error",
    500,
    "The service failed",
    "This is a fault of the service: its log says more. Please report it with what you sent.",
)

ALL = {
    kind.type.rpartition("/")[2]: kind
    for kind in [*globals().values()]
    if isinstance(kind, ProblemKind)
}
OF_THE_DOOR = KEY_MISSING, SCOPE_MISSING, FOREIGN_HOST, TOO_MANY_REQUESTS, INVALID_REQUEST
"""Problems of every address that shows or changes jobs."""
OF_A_JOB = UNKNOWN_JOB, EXPIRED_JOB
"""Problems of every address of a job."""
OF_RETRIES = NOTHING_TO_RETRY, INVALID_JOB, LIMIT_EXCEEDED, QUOTA_EXCEEDED, DISK_FULL, UNAVAILABLE
"""Problems of retries: a document may be one that this version refuses."""
OF_KEYS = KEY_REUSED, KEY_IN_FLIGHT, INVALID_REQUEST
"""Problems of an Idempotency-Key."""
OF_A_BODY = (
    MALFORMED_JSON,
    BODY_TOO_LARGE,
    BODY_TOO_SLOW,
    NOT_JSON,
    INVALID_JOB,
    LIMIT_EXCEEDED,
    UNAVAILABLE,
    DISK_FULL,
)
OF_SUBMISSIONS = (
    *OF_A_BODY,
    *OF_KEYS,
    SCOPE_MISSING,
    QUOTA_EXCEEDED,
)
OF_STORES = (
    *OF_A_JOB,
    WRONG_KIND,
    NO_RESULTS,
    DAMAGED_RESULTS,
    RESULTS_NOT_READY,
    INVALID_REQUEST,
)
OF_RESULTS = *OF_STORES, UNKNOWN_CHANNEL, RESPONSE_TOO_LARGE
"""Problems of every address where numbers of a job's results are read."""
