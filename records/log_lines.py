"""Log lines of all processes, as text or as JSON objects that say what they are about."""

import json
import logging
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from datetime import UTC, datetime
from typing import Any, Literal

from jointplay.records.log_repetitions import OncePerPeriod

LogFormat = Literal["text", "json"]
_TEXT = "%(asctime)s %(levelname)s %(message)s"
_about: ContextVar[Mapping[str, object]] = ContextVar("about", default={})  # noqa: B039 - never changed


def begin(log_format: LogFormat, level: int = logging.INFO) -> None:
    """Write lines of this level and above, and warnings, to standard error.

    Of warnings that repeat one is written a minute.
    """
    handler = logging.StreamHandler()
    handler.addFilter(OncePerPeriod())
    handler.setFormatter(JsonLines() if log_format == "json" else logging.Formatter(_TEXT))
    logging.basicConfig(level=level, handlers=[handler])
    logging.captureWarnings(True)
    logging.getLogger("httpx").setLevel(logging.WARNING)  # else it writes signed addresses
    logging.getLogger("alembic").setLevel(logging.WARNING)  # else nine lines for new tables


@contextmanager
def about(**facts: object) -> Iterator[None]:
    """Give facts, such as a job's id, to every line of JSON that is written inside."""
    token = _about.set({**_about.get(), **facts})
    try:
        yield
    finally:
        _about.reset(token)


def note(**facts: object) -> None:
    """Give facts to every further line of this task, such as that of one request."""
    _about.set({**_about.get(), **facts})


class JsonLines(logging.Formatter):
    """One object a line: time (RFC 3339, UTC), level, logger, message, and the noted facts."""

    def format(self, record: logging.LogRecord) -> str:
        """Return a record as a line; what an error left behind is its member "exception"."""
        line: dict[str, Any] = {
            "time": datetime.fromtimestamp(record.created, UTC).isoformat(timespec="milliseconds"),
            "level": record.levelname,
            "logger": record.name,
            "message": record.getMessage(),
            **_about.get(),
        }
        if record.exc_info:
            line["exception"] = self.formatException(record.exc_info)
        return json.dumps(line)
