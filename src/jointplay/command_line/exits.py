"""Exit codes, and the exception that carries one."""

from enum import IntEnum


class Exit(IntEnum):
    """Exit codes, for scripts."""

    OK = 0
    CHECK_FAILED = 1  # of `jointplay chaos`, `doctor` and `verify`
    BAD_INPUT = 2  # also wrong usage
    FAILED = 3  # the job failed
    CANCELLED = 4  # the job was cancelled
    UNREACHABLE = 5  # no service answered
    INTERRUPTED = 130  # Ctrl-C, as shells have it


class Stopped(Exception):
    """Ends a command with one line on stderr and an exit code: by default, the input is wrong."""

    def __init__(self, line: str, code: Exit = Exit.BAD_INPUT) -> None:
        super().__init__(line)
        self.code = code
