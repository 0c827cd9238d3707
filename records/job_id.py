"""Ids of jobs and batches: 26 characters that sort by the time of submission."""

import re

_JOB_ID = re.compile("[0-9A-HJKMNP-TV-Z]{26}")


def is_job_id(text: str) -> bool:
    """Tell whether ``text`` is written as the id of a job or of a batch is."""
    return _JOB_ID.fullmatch(text) is not None
