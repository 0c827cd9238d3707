"""Words and JSON go compressed to who takes gzip; files of numbers and short answers do not."""

import pytest

PLAIN = {"Accept-Encoding": "identity"}


@pytest.mark.parametrize("path", ["/openapi.json", "/v1/scenes", "/page/start.js"])
def test_an_answer_is_the_same_with_and_without(http, path):
    packed, plain = http.get(path), http.get(path, headers=PLAIN)
    assert packed.headers["Content-Encoding"] == "gzip"
    assert "Content-Encoding" not in plain.headers
    assert packed.content == plain.content
    assert int(packed.headers["Content-Length"]) < len(plain.content) / 2
    assert packed.headers["Vary"] == plain.headers["Vary"] == "Accept-Encoding"


def test_a_compressed_file_is_not_sent_again(http):
    tag = http.get("/page/start.js").headers["ETag"]
    assert tag.startswith("W/")
    assert http.get("/page/start.js", headers={"If-None-Match": tag}).status_code == 304


def test_what_is_packed_or_short_stays_as_it_is(http, finished_job):
    history = f"/v1/jobs/{finished_job}/history"
    for path, accept in (
        ("/healthz", "*/*"),
        (history, "application/x-npz"),
        (f"/v1/jobs/{finished_job}/zarr/time/c/0", "*/*"),
    ):
        answer = http.get(path, headers={"Accept": accept})
        assert (answer.status_code, answer.headers.get("Content-Encoding")) == (200, None), path
    numbers = http.get(history)
    assert numbers.headers["Content-Encoding"] == "gzip"
    assert numbers.json()["time"]["values"]
