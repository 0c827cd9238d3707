"""Requests that a Zarr client may make of a store, and that nobody may: ranges, tags, keys."""

import httpx
import pytest


@pytest.fixture(scope="module")
def base(finished_job):
    return f"/v1/jobs/{finished_job}/zarr"


@pytest.fixture(scope="module")
def whole(http, base):
    return http.get(f"{base}/time/c/0").content


@pytest.mark.parametrize(
    ("asked", "start", "stop"),
    [
        ("bytes=0-0", 0, 1),
        ("Bytes=0-0", 0, 1),  # names of units have no case (RFC 9110, section 14.1)
        ("bytes=10-99", 10, 100),
        ("bytes=100-", 100, None),
        ("bytes=-260", -260, None),
        ("bytes=100-999999999999", 100, None),
        ("bytes=-999999999999", 0, None),
    ],
)
def test_a_range_is_answered_with_its_bytes(http, base, whole, asked, start, stop):
    answer = http.get(f"{base}/time/c/0", headers={"Range": asked})
    assert answer.status_code == 206
    assert answer.content == whole[start:stop]
    first = whole.index(answer.content)
    size = len(whole)
    expected = f"bytes {first}-{first + len(answer.content) - 1}/{size}"
    assert answer.headers["Content-Range"] == expected
    assert answer.headers["Content-Length"] == str(len(answer.content))


@pytest.mark.parametrize("asked", ["bytes=999999999-", "bytes=-0"])
def test_a_range_without_bytes_is_a_problem_that_gives_the_size(http, base, whole, asked):
    answer = http.get(f"{base}/time/c/0", headers={"Range": asked})
    assert answer.status_code == 416
    assert answer.headers["Content-Range"] == f"bytes */{len(whole)}"
    assert answer.json()["type"] == "/problems/range-not-satisfiable"


@pytest.mark.parametrize("asked", ["bytes=9-3", "rows=0-5", "bytes=0-1,4-5", "bytes=", "nonsense"])
def test_a_range_that_is_none_means_the_whole(http, base, whole, asked):
    answer = http.get(f"{base}/time/c/0", headers={"Range": asked})
    assert (answer.status_code, answer.content) == (200, whole)


def test_head_tells_what_get_would(http, base):
    for key in ("time/c/0", "zarr.json"):
        plain = {"Accept-Encoding": "identity"}
        head = http.head(f"{base}/{key}", headers=plain)
        get = http.get(f"{base}/{key}", headers=plain)
        assert (head.status_code, head.content) == (200, b"")
        differing = {"date"}
        assert {k: v for k, v in head.headers.items() if k not in differing} == {
            k: v for k, v in get.headers.items() if k not in differing
        }
        assert int(head.headers["Content-Length"]) == len(get.content)


def test_what_is_sealed_may_be_kept_for_ever_and_is_not_sent_twice(http, base):
    for key in ("time/c/0", "zarr.json", "poincare/zarr.json"):
        first = http.get(f"{base}/{key}")
        assert first.headers["Cache-Control"] == "public, max-age=31536000, immutable"
        tag = first.headers["ETag"]
        assert tag.startswith('"')
        again = http.get(f"{base}/{key}", headers={"If-None-Match": f'"other", {tag}'})
        assert (again.status_code, again.content) == (304, b"")
        assert again.headers["ETag"] == tag
        assert http.get(f"{base}/{key}", headers={"If-None-Match": '"other"'}).status_code == 200


def test_a_range_of_another_version_is_the_whole(http, base, whole):
    tag = http.head(f"{base}/time/c/0").headers["ETag"]
    for condition, status in ((tag, 206), ('"other"', 200)):
        headers = {"Range": "bytes=0-9", "If-Range": condition}
        assert http.get(f"{base}/time/c/0", headers=headers).status_code == status


@pytest.mark.parametrize("path", ["/zarr/time/c/0", "/zarr.zip", "/page/start.js"])
def test_what_has_changed_since_is_not_mixed_with_what_a_client_has(http, base, path):
    address = path if path.startswith("/page") else base.removesuffix("/zarr") + path
    tag = http.head(address, headers={"Accept-Encoding": "identity"}).headers["ETag"]
    for condition in (tag, f'"other", {tag}', "*"):
        assert http.get(address, headers={"If-Match": condition}).status_code == 200
    asked = {"Range": "bytes=0-9", "If-None-Match": tag}
    for condition in ('"other"', f"W/{tag}"):
        answer = http.get(address, headers=asked | {"If-Match": condition})
        assert (answer.status_code, answer.headers["ETag"]) == (412, tag)
        assert answer.json()["type"] == "/problems/precondition-failed"


def test_documents_are_compressed_for_those_who_ask(http, base):
    packed = http.get(f"{base}/zarr.json", headers={"Accept-Encoding": "gzip"})
    plain = http.get(f"{base}/zarr.json", headers={"Accept-Encoding": "gzip;q=0, br"})
    assert packed.headers["Content-Encoding"] == "gzip"
    assert "Content-Encoding" not in plain.headers
    assert packed.content == plain.content  # httpx has unpacked it
    assert int(packed.headers["Content-Length"]) < len(plain.content) / 10
    assert packed.headers["ETag"] != plain.headers["ETag"]
    assert packed.headers["Vary"] == "Accept-Encoding"


@pytest.mark.parametrize(
    "key",
    [
        "",
        "MANIFEST.json",
        "job.json",
        "parts/00000001",
        "slider7.x",
        "slider7.x/zarr.jso",
        "nothing/zarr.json",
        ".zgroup",
        "time/c/1",
        "time/c/0/0",
        "time/c/%D9%A1",  # a digit, but not an ASCII one
        "..%2fzarr.json",
        "poincare/..%2f..%2fzarr.json",
        "%2e%2e/%2e%2e/zarr.json",
        "%2fetc/passwd",
        "zarr.json%00",
        "time/c/0%00",
        "zarr.json%0a",
        "time/c/0%0a",
        "c/" * 2500 + "0",
        "x" * 5000 + "/zarr.json",
        "a/b/c/d/e/zarr.json",
        "time//zarr.json",
        "time/c/0/",
        "pyramid/64/extremes/c/0/0",
    ],
)
def test_what_is_not_there_is_not_found(service_url, base, key):
    with httpx.Client(trust_env=False, timeout=60) as client:
        for method in ("GET", "HEAD"):
            answer = client.request(method, f"{service_url}{base}/{key}")
            assert answer.status_code == 404
            assert answer.headers["Content-Type"] == "application/problem+json"


def test_a_store_has_no_parameters_and_is_not_written_to(http, base):
    assert http.get(f"{base}/zarr.json", params={"x": 1}).status_code == 422
    for method in ("PUT", "POST", "DELETE", "PATCH"):
        assert http.request(method, f"{base}/zarr.json").status_code == 405


def test_a_job_that_waits_has_nothing_yet(http, worker):
    answer = http.get(f"/v1/jobs/{worker.submit()}/zarr/zarr.json")
    assert answer.status_code == 404
    assert "queued" in answer.json()["detail"]
