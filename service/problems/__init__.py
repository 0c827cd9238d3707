"""RFC 9457 problem documents: everything that the service answers instead of a result.

`kinds` lists the problems that exist, `document` is their shape, `handlers` turns exceptions of
every layer into them, `endpoints` serves the page that each problem's ``type`` points to.
"""

from jointplay.service.problems.document import (
    ErrorDetail,
    ProblemDocument,
    RequestRefused,
    header,
    problems,
)
from jointplay.service.problems.handlers import install

__all__ = ["ErrorDetail", "ProblemDocument", "RequestRefused", "header", "install", "problems"]
