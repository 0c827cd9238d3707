"""Charts over HTTP: axes and quantities, one point, rectangles, and pictures."""

import io

import numpy as np
import pytest
from PIL import Image

from jointplay.records.coarse_to_fine import coarse_to_fine, order_of, over_axes
from jointplay.records.motion import colour_of
from jointplay.service.charts import schemas
from jointplay.solver.nonlinear.grounds import grounds
from tests.service.answers import get
from tests.worker_by_hand import CHART

WIDTH, HEIGHT = 300, 5
ORDER = coarse_to_fine((HEIGHT, WIDTH))
FAILED = 7


@pytest.fixture(scope="module")
def chart(worker):
    """Verdicts go round by point, and steps are 1000 and the point's number; one has failed."""
    return worker.finished_study(**CHART, failing=(FAILED,))


@pytest.fixture(scope="module")
def growing(worker):
    """A chart of whose first block four points have ended."""
    job = worker.submit(**CHART)
    worker.compute(worker.start(job), points=4)
    return job


def picture(http, job, quantity, place, **query):
    answer = http.get(f"/v1/jobs/{job}/tiles/{quantity}/{place}.png", params=query)
    assert answer.status_code == 200, answer.text
    assert answer.headers["content-type"] == "image/png"
    return np.array(Image.open(io.BytesIO(answer.content)).convert("RGBA"))


def test_answers_are_as_the_openapi_document_says(http, chart):
    for path, model in (
        ("", schemas.Chart),
        ("/point?column=3&row=2", schemas.ChartPoint),
        ("/values?quantity=steps", schemas.Rectangle),
    ):
        answer = http.get(f"/v1/jobs/{chart}/chart{path}")
        document = model.model_validate_json(answer.content, strict=True)
        assert document.model_dump(mode="json") == answer.json()


def test_axes_and_quantities_are_told(http, chart):
    found = get(http, f"/v1/jobs/{chart}/chart")
    assert (found["complete"], found["points"], found["ended"]) == (True, 1500, 1500)
    assert found["x"]["values"] == np.linspace(1e-4, 1e-3, WIDTH).tolist()
    assert (found["y"]["parameter"], found["y"]["unit"]) == ("friction", "1")
    assert found["levels"] == 2
    motion, *others = found["quantities"]
    counts = {label["name"]: label["points"] for label in motion["labels"]}
    assert counts["failed"] == 1
    assert sum(counts.values()) == 1500
    steps = next(one for one in others if one["name"] == "steps")
    assert steps["low"] == pytest.approx(1000 + 0.02 * 1499, abs=1)  # 2 % of 1000 to 2499


def test_a_point_tells_all_that_is_known_of_it(http, chart):
    at = int(np.flatnonzero(ORDER == 2 * WIDTH + 3)[0])
    found = get(http, f"/v1/jobs/{chart}/chart/point", column=3, row=2)
    assert found["quantities"]["steps"]["value"] == 1000 + at
    kept = {"verdict": at % 4, "lyapunov": 0.1 * at, "lyapunov_error": 0.01}
    assert found["detail"] == grounds(kept) != ""
    row, column = divmod(int(ORDER[FAILED]), WIDTH)
    failed = get(http, f"/v1/jobs/{chart}/chart/point", column=column, row=row)
    assert (failed["status"], failed["detail"]) == ("failed", "The step fell below 1e-15 s.")


def test_values_lie_where_their_points_are(http, chart):
    steps = over_axes(1000.0 + np.arange(1500.0), ORDER, (HEIGHT, WIDTH))
    asked = {"quantity": "steps", "x_start": 10, "x_stop": 14, "y_start": 1, "y_stop": 3}
    found = get(http, f"/v1/jobs/{chart}/chart/values", **asked)
    assert found["values"] == steps[1:3, 10:14].tolist()
    coarse = get(http, f"/v1/jobs/{chart}/chart/values", quantity="steps", every=2)
    assert coarse["values"][1][5] == pytest.approx(steps[2:4, 10:12].mean(), rel=1e-6)  # float32
    assert coarse["columns"][5] == 10


def test_a_tile_has_the_colour_of_each_point_from_the_bottom_up(http, chart):
    labels = get(http, f"/v1/jobs/{chart}/chart/values", quantity="motion")["values"]
    for tile, columns in (("0/0", range(256)), ("1/0", range(256, WIDTH))):
        shown = picture(http, chart, "motion", f"1/{tile}")
        assert shown.shape == (256, 256, 4)
        for row in range(HEIGHT):
            for column in columns[:: len(columns) // 7]:
                pixel = shown[255 - row, column - columns[0]]
                assert "#" + bytes(pixel[:3]).hex() == colour_of(int(labels[row][column]))
        assert shown[200, 0, 3] == 0  # beyond the chart nothing is drawn
    whole = picture(http, chart, "motion", "0/0/0")
    assert (whole[:, :, 3] > 0).sum() == 150 * 3


def test_colours_of_values_go_from_low_to_high(http, chart):
    shown = picture(http, chart, "steps", "1/0/0", low=0.0, high=1e9)
    assert {tuple(pixel) for pixel in shown[255 - HEIGHT + 1 :, :256].reshape(-1, 4)} == {
        (0x00, 0x22, 0x4E, 255)
    }


def test_a_growing_chart_shows_the_nearest_point_that_is_known(http, growing):
    found = get(http, f"/v1/jobs/{growing}/chart")
    assert (found["complete"], found["ended"]) == (False, 4)
    steps = get(http, f"/v1/jobs/{growing}/chart/values", quantity="steps")["values"]
    known = dict(zip(ORDER[:4].tolist(), 1000.0 + np.arange(4.0), strict=True))
    assert steps[0][0] == known[0] == steps[4][63]
    assert steps[0][64] == known[64] == steps[3][100]
    assert steps[0][299] is None  # 256 and 299 wait, and so does what is coarser


def test_a_tile_of_a_state_to_come_is_not_kept_as_that_state(http, worker):
    job = worker.submit(**CHART)
    claim = worker.start(job)
    worker.compute(claim, points=4)
    early = http.get(f"/v1/jobs/{job}/tiles/steps/0/0/0.png?ended=8")
    worker.compute(claim, points=8)
    assert get(http, f"/v1/jobs/{job}/chart")["ended"] == 8
    steps = get(http, f"/v1/jobs/{job}/chart/values", quantity="steps")["values"]
    known = over_axes(1000.0 + np.arange(1500.0), ORDER, (HEIGHT, WIDTH))
    for place in ORDER[:8].tolist():
        row, column = divmod(place, WIDTH)
        assert steps[row][column] == known[row, column]
    assert early.status_code == 422


def test_only_tiles_of_a_state_that_is_named_are_kept_by_clients(http, growing):
    address = f"/v1/jobs/{growing}/tiles/steps/0/0/0.png"
    answers = [http.get(address), http.get(f"{address}?ended=4")]
    assert [one.headers["Cache-Control"] for one in answers] == [
        "no-cache",
        "private, max-age=3600",
    ]


def test_a_tile_of_a_state_that_has_gone_by_is_kept_by_nobody(http, worker):
    """More points have ended than when the chart was asked for: the tile is not of that state."""
    job = worker.submit(**CHART)
    claim = worker.start(job)
    worker.compute(claim, points=4)
    worker.compute(claim, points=8)
    for place in ("0/0/0", "1/0/0"):
        address = f"/v1/jobs/{job}/tiles/steps/{place}.png"
        told = [http.get(f"{address}?ended={ended}").headers["Cache-Control"] for ended in (4, 8)]
        assert told == ["no-cache", "private, max-age=3600"]


@pytest.mark.parametrize("rule", [{"refine": 2}, {"continuation": "backward"}])
def test_values_lie_where_their_points_are_in_other_orders(http, worker, rule):
    order = order_of(rule, (HEIGHT, WIDTH))
    assert order.tolist() != ORDER.tolist()
    shown = worker.finished_study(**CHART, **rule)
    steps = over_axes(1000.0 + np.arange(1500.0), order, (HEIGHT, WIDTH))
    found = get(http, f"/v1/jobs/{shown}/chart/values", quantity="steps")
    assert found["values"] == steps.tolist()
    begun = worker.submit(**CHART, **rule)
    worker.compute(worker.start(begun), points=4)
    growing = get(http, f"/v1/jobs/{begun}/chart/values", quantity="steps")["values"]
    assert [growing[0][place] for place in order[:4].tolist()] == [1000.0, 1001.0, 1002.0, 1003.0]
    at = int(np.flatnonzero(order == 2 * WIDTH + 3)[0])
    point = get(http, f"/v1/jobs/{shown}/chart/point", column=3, row=2)
    assert point["quantities"]["steps"]["value"] == 1000.0 + at


def test_a_refined_chart_says_how_many_points_inherit(http, worker, chart):
    refined = worker.finished_study(**CHART, refine=2)
    found = get(http, f"/v1/jobs/{refined}/chart")
    assert (found["ended"], found["inherited"]) == (1500, 750)
    assert "inherited" in [one["name"] for one in found["quantities"]]
    assert get(http, f"/v1/jobs/{chart}/chart")["inherited"] == 0


@pytest.mark.parametrize(
    ("path", "status", "words"),
    [
        ("chart/point?column=300&row=0", 422, "300 of them"),
        ("chart/values?quantity=weight", 422, "There is no quantity 'weight'"),
        ("chart/values?quantity=steps&x_start=9&x_stop=3", 422, "rectangle is empty"),
        ("tiles/weight/0/0/0.png", 422, "There is no quantity"),
        ("tiles/steps/2/0/0.png", 422, "levels 0 to 1"),
        ("tiles/steps/1/2/0.png", 422, "no tile"),
        ("tiles/steps/1/0/0.png?low=nan", 422, "'low' must be a finite number"),
        ("tiles/steps/1/0/0.png?low=2&high=1", 422, "high (1) is below low (2)"),
        ("tiles/steps/1/0/0.png?ended=1501", 422, "1500 points have ended, and not 1501"),
    ],
)
def test_what_a_chart_has_not_is_refused(http, chart, path, status, words):
    answer = http.get(f"/v1/jobs/{chart}/{path}")
    assert answer.status_code == status
    assert words in answer.text


@pytest.fixture(scope="module")
def basins(worker):
    """Twenty starts, of phases and friction."""
    start = {"start": "/drivers/drive1/position", "values": [0.0, 0.5, 1.0, 1.5]}
    return worker.finished_study(**CHART | {"kind": "basins", "along": start})


def test_basins_have_attractors_with_names_of_their_own(http, basins):
    answer = http.get(f"/v1/jobs/{basins}/attractors")
    document = schemas.Attractors.model_validate_json(answer.content, strict=True)
    assert document.model_dump(mode="json") == answer.json()
    assert document.ended == document.points == sum(one.points for one in document.attractors)
    first, *_ = get(http, f"/v1/jobs/{basins}/chart")["quantities"]
    assert first["name"] == "attractor"
    table = {one.name: (one.points, one.colour) for one in document.attractors}
    assert {one["name"]: (one["points"], one["colour"]) for one in first["labels"]} == table
    point = get(http, f"/v1/jobs/{basins}/chart/point", column=1, row=0)
    assert point["quantities"]["attractor"]["label"] in table
    assert picture(http, basins, "attractor", "0/0/0")[255, 0, 3] == 255


def test_drawn_starts_have_attractors_over_a_parameter_and_no_chart(http, worker):
    drawn = {"/drivers/drive1/position": {"distribution": "uniform", "low": 0.0, "high": 6.0}}
    fields = {name: field for name, field in CHART.items() if name not in ("along", "by")}
    along = {"parameter": "clearance", "values": [1e-4, 2e-4, 3e-4]}
    fields |= {"kind": "basin-stability", "starts": drawn, "samples": 40, "along": along}
    job = worker.finished_study(**fields)
    answer = http.get(f"/v1/jobs/{job}/attractors")
    document = schemas.Attractors.model_validate_json(answer.content, strict=True)
    assert document.model_dump(mode="json") == answer.json()
    assert document.along.values == along["values"]
    assert document.along.ended == [40, 40, 40]
    for index in range(3):
        assert sum(one.shares[index] for one in document.attractors) == pytest.approx(1.0)
    assert document.attractors[0].row is None
    refused = http.get(f"/v1/jobs/{job}/chart")
    assert refused.status_code == 404
    assert "has no chart" in refused.json()["detail"]


def test_a_chart_has_no_attractors(http, chart):
    assert http.get(f"/v1/jobs/{chart}/attractors").status_code == 404


def test_other_jobs_have_no_chart(http, finished_sweep):
    assert http.get(f"/v1/jobs/{finished_sweep}/chart").status_code == 404
    assert http.get(f"/v1/jobs/{finished_sweep}/tiles/steps/0/0/0.png").status_code == 404
