"""Jobs of kinds that this version does not have, as beside a newer one, or after going back."""

from jointplay.storage.catalogue.records import BlockEnd, BlockState, NewJob

LATER = NewJob("later-kind", {"kind": "later-kind", "odd": 1}, "e" * 64, "9.0.0+later")


def test_they_are_shown_and_keep_no_others_from_being_shown(http, catalogue):
    job = catalogue.submit(LATER).job.id
    listed = http.get("/v1/jobs").json()["jobs"]
    (shown,) = [one for one in listed if one["id"] == job]
    assert {*shown["links"]} == {"self", "cancel", "events"}
    assert http.get(f"/v1/jobs/{job}").json() == shown


def test_their_results_are_not_taken_for_damaged(http, catalogue):
    job = catalogue.submit(LATER).job.id
    assert catalogue.claim_block(f"{job}-0", "worker", 60.0) is not None
    catalogue.finish(f"{job}-0", 1, BlockEnd(BlockState.done))
    for what in ("history", "points", "figures", "zarr", "zarr/zarr.json", "zarr.zip"):
        answer = http.get(f"/v1/jobs/{job}/{what}")
        assert (answer.status_code, answer.json()["type"]) == (404, "/problems/wrong-kind")
        assert "does not know" in answer.json()["detail"]
    assert catalogue.get(job).damaged is None
    assert http.delete(f"/v1/jobs/{job}").status_code == 200
