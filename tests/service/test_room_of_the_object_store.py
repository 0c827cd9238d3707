"""Jobs whose results the object store could not hold are refused before anything is computed."""

from pathlib import Path

import pytest

from jointplay.records.failure import LimitExceeded
from jointplay.service.jobs.submission import checked, repeated
from jointplay.storage.settings import Settings

LARGE = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 10.0}
STEPS = LARGE | {"steps_limit": 6_000_000_000}


@pytest.mark.parametrize(
    ("document", "field", "size"),
    [(LARGE | {"output_step": 2e-7}, "/output_step", "6.83 GB"), (STEPS, "/steps_limit", "6 GB")],
)
def test_what_a_bucket_cannot_hold_is_refused_with_the_field(
    tmp_path: Path, document: dict[str, object], field: str, size: str
) -> None:
    stored = checked(document, Settings(data=tmp_path), 0.0)[0].spec
    bucket = Settings(data=tmp_path, results_url="s3://results/here")
    with pytest.raises(LimitExceeded) as refused:
        checked(document, bucket, 0.0)
    (problem,) = refused.value.problems
    with pytest.raises(LimitExceeded):
        repeated(stored, bucket, 0.0)
    assert problem.pointer == field
    assert f"{size} before compression" in problem.detail
    assert "takes 5 GB" in problem.detail
