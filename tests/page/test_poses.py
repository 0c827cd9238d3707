"""Mechanisms before they are run: as the solver puts them together, driven, and dragged."""

import json
import math
import random
from collections.abc import Iterator
from typing import Any

import pytest

from jointplay.solver.kinds.assembled import assembled_scene, resolved_scene
from jointplay.solver.mechanics.absolute import AbsoluteMechanism
from jointplay.solver.mechanics.assembly import first_clocks
from jointplay.solver.mechanics.closing import arrays
from jointplay.solver.mechanics.view import view
from jointplay.solver.runs.ideal.following import follow
from jointplay.solver.scene import presets
from tests.page.browsing import barriers, expect
from tests.page.test_own_mechanism import paste
from tests.two_assemblies import arm, five_bar, link, revolute, toggle

CANVAS = "canvas[data-pose]"
POSE = "document.querySelector('canvas[data-pose]').dataset.pose"
POSED = [name for name in presets.names() if name != "seven-bar-test-bed"]
"""Presets that are run without a parameter."""
DRAWN = "pose => document.querySelector('canvas[data-pose]')?.dataset.pose === JSON.stringify(pose)"
SWINGING = {"type": "sinusoidal", "amplitude": 0.5, "frequency": 4.0, "phase": math.pi / 2}


def posed(answer: Any) -> bool:
    return answer.url.endswith("/v1/scenes/poses") and answer.status == 200


@pytest.fixture(scope="module")
def page(browsing: Any, service_url: str) -> Iterator[Any]:
    """The editor."""
    with browsing.page(f"{service_url}/#/editor") as page:
        page.locator(CANVAS).wait_for()
        yield page


def shown(page: Any, document: dict[str, Any]) -> dict[str, Any]:
    """Show a document; return what the service told of its pose, which is drawn then."""
    with page.expect_response(posed) as answer:
        paste(page, json.dumps(document, indent=2))
    found: dict[str, Any] = answer.value.json()
    page.wait_for_function(DRAWN, arg=found["poses"][0])
    return found


def drawn(page: Any) -> dict[str, list[float]]:
    found: dict[str, list[float]] = json.loads(page.evaluate(POSE))
    return found


def flat(pose: dict[str, Any]) -> list[float]:
    return [number for body in pose.values() for number in body]


def slide(page: Any, step: int, before: dict[str, Any]) -> dict[str, list[float]]:
    """Move the drivers' slider; return the pose that is drawn then."""
    page.locator("#sweep").fill(str(step))
    page.wait_for_function(f"pose => !({DRAWN})(pose)", arg=before)
    return drawn(page)


def test_the_editor_draws_the_pose_that_is_run(page: Any) -> None:
    names = random.Random(31).sample(sorted(POSED), 2)
    own = [toggle(), five_bar(), arm(position=0.2, motion=SWINGING)]
    for document in [presets.document(name) for name in names] + own:
        assert_drawn_as_run(page, document)
    assert drawn(page)["arm"][2] == pytest.approx(0.7)


@pytest.mark.long
def test_the_editor_draws_the_poses_in_which_all_presets_are_run(page) -> None:
    for name in POSED:
        assert_drawn_as_run(page, presets.document(name))


def assert_drawn_as_run(page: Any, document: dict[str, Any]) -> None:
    shown(page, document)
    expected = assembled_scene(document, is_whole=True).pose()
    assert flat(drawn(page)) == pytest.approx(flat(expected), abs=1e-12), document["name"]


def test_drivers_go_on_in_time_whatever_they_follow(page, artifacts) -> None:
    start = shown(page, five_bar())["poses"][0]
    expect(page.locator("#until")).to_have_attribute("placeholder", "1.571")
    expected = follow(resolved_scene(five_bar()), [math.pi / 2 * 40 / 120]).poses[0]
    moved = slide(page, 40, start)
    assert flat(moved) == pytest.approx(expected.tolist(), abs=1e-12)
    page.screenshot(path=artifacts / "five_bar.png")
    page.get_by_role("button", name="To the start").click()
    assert drawn(page) == start
    page.locator("#until").fill("0.3")
    page.locator("#until").press("Tab")
    expected = follow(resolved_scene(five_bar()), [0.3]).poses[0]
    assert flat(slide(page, 120, start)) == pytest.approx(expected.tolist(), abs=1e-12)


def test_a_driven_slider_shows_its_stroke_and_where_it_stops(page) -> None:
    """A slider pushes a crank of 0.1 m by a rod of 0.25 m, both along its axis 0.02 m later."""
    crank, rod, start = 0.1, 0.25, 0.33
    document = {
        "name": "pushed",
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": {
            "crank": link(crank / 2, "O", "A"),
            "rod": link(rod / 2, "A", "B"),
            "slider": {"mass": 1.0, "inertia": 1e-3, "points": {"B": [0.0, 0.0]}},
        },
        "joints": {
            "O": revolute("ground.O", "crank.O"),
            "A": revolute("crank.A", "rod.A"),
            "B": revolute("slider.B", "rod.B"),
            "guide": {
                "type": "prismatic",
                "guide": "ground.O",
                "slider": "slider.B",
                "axis": [1.0, 0.0],
            },
        },
        "drivers": {"push": {"joint": "guide", "position": start, "speed": 0.1}},
        "start": {"angles": {"crank": 0.7, "rod": -0.3}},
    }
    page.locator("#duration").fill("")
    found = shown(page, document)
    assert found["drivers_time"] == pytest.approx(crank / 0.1)  # its shortest link, not 62.8 s
    expect(page.locator("#duration")).to_have_value("1")
    last = slide(page, 120, found["poses"][0])["slider"][0]
    assert start < last < crank + rod + 1e-9
    dead_point = "The ideal mechanism comes to a dead point at t = 0.2 s"
    page.get_by_role("status").filter(has_text=dead_point).wait_for()


def test_drivers_are_moved_again_after_their_motion_could_not_be_had(
    browsing: Any, service_url: str
) -> None:
    address = "**/v1/scenes/poses"
    with browsing.page(f"{service_url}/#/editor", expected=("500",)) as page:
        page.locator(CANVAS).wait_for()
        found = shown(page, toggle())
        page.route(address, lambda route: route.fulfill(status=500, json={}))
        with page.expect_response(address):
            page.locator("#sweep").fill("30")
        page.unroute(address)
        with page.expect_response(posed):
            page.locator("#sweep").fill("60")
        assert slide(page, 90, found["poses"][0])


def test_a_mechanism_that_takes_too_long_to_pose_is_not_drawn_and_says_so(
    browsing: Any, service_url: str
) -> None:
    """The picture before it stayed, without a word."""
    address, sentence = "**/v1/scenes/poses", "Looking at this scene takes more than 20 s."
    problem = {"type": "/problems/limit-exceeded", "status": 422, "detail": sentence}
    with browsing.page(f"{service_url}/#/editor", expected=("422",)) as page:
        page.locator(CANVAS).wait_for()
        page.route(address, lambda route: route.fulfill(status=422, json=problem))
        paste(page, json.dumps(toggle()))
        page.get_by_role("status").filter(has_text=f"This is not drawn: {sentence}").wait_for()
        page.unroute(address)
        shown(page, five_bar())
        page.get_by_role("status").filter(has_text="Drag a point").wait_for()


def test_points_are_dragged_and_joints_stay_closed(page) -> None:
    start = shown(page, toggle())["poses"][0]
    asked: list[dict[str, Any]] = []
    on_their_way = [0]

    def sent(request: Any) -> None:
        if request.url.endswith("/v1/scenes/drag"):
            asked.append(request.post_data_json)
            on_their_way.append(on_their_way[-1] + 1)

    def answered(response: Any) -> None:
        if response.url.endswith("/v1/scenes/drag"):
            on_their_way.append(on_their_way[-1] - 1)

    page.on("request", sent)
    page.on("response", answered)
    box = page.locator(CANVAS).bounding_box()
    x, y = pixel_of(page, toggle(), start, "crank", [0.04, 0.0])
    page.mouse.move(box["x"] + x, box["y"] + y)
    page.mouse.down()
    for step in range(1, 41):
        page.mouse.move(box["x"] + x + 2 * step, box["y"] + y + step)
    let_go = f"angle => Math.abs(JSON.parse({POSE}).crank[2] - angle) > 0.1"  # by its driver
    page.wait_for_function(let_go, arg=start["crank"][2])
    assert misfit(toggle(), drawn(page)) < 1e-9
    page.mouse.up()
    page.get_by_role("button", name="To the start").click()
    page.wait_for_function(DRAWN, arg=start)
    assert {one["point"] for one in asked} == {"crank.A"}
    assert 1 <= len(asked) <= 40
    assert set(on_their_way) == {0, 1}


def test_what_nothing_drives_is_dragged_only(page) -> None:
    shown(page, presets.document("pendulum"))
    page.get_by_text("Nothing is driven.").wait_for()
    expect(page.locator("#sweep")).to_be_disabled()


def test_a_point_is_pulled_and_kept_as_the_start_without_a_pointer(
    browsing: Any, service_url: str
) -> None:
    """A mechanism that nothing drives could be moved with a pointer only."""
    document = presets.document(
        "pendulum"
    )  # whose angle is a parameter: the start was undone by it
    body, point = "rod", "tip"
    with browsing.page(f"{service_url}/#/editor") as page:
        page.locator(CANVAS).wait_for()
        start = shown(page, document)["poses"][0]
        page.get_by_label("Arrow keys move").select_option(f"{body}.{point}")
        page.locator(CANVAS).focus()
        before = start
        for key in ("ArrowUp", "ArrowUp", "ArrowLeft", "Shift+ArrowUp"):
            page.keyboard.press(key)
            page.wait_for_function(f"pose => !({DRAWN})(pose)", arg=before)
            before = drawn(page)
        assert misfit(document, before) < 1e-9
        assert abs(before[body][2] - start[body][2]) > 0.02
        expect(page.locator(CANVAS)).to_be_focused()
        page.wait_for_function("() => scrollY === 0")  # arrow keys move the point, not the page
        assert barriers(page) == []
        page.get_by_role("button", name="Start here").focus()
        with page.expect_response(posed) as answer:
            page.keyboard.press("Enter")
        assert flat(answer.value.json()["poses"][0]) == pytest.approx(flat(before), abs=1e-7)


def pixel_of(page: Any, scene: dict[str, Any], pose: Any, body: str, at: list[float]) -> Any:
    """Return where the page draws a point of a body, in pixels of its canvas."""
    return page.evaluate(
        """async ([scene, pose, body, at, base]) => {
          const [{ bounds }, { frame }, { world }] = await Promise.all(
            ["bounds", "frame", "placing"].map((name) => import(`${base}mechanism/${name}.js`)));
          const { clientWidth, clientHeight } = document.querySelector("canvas[data-pose]");
          const view = frame(bounds(scene, [pose]), clientWidth, clientHeight, 46);
          return view.pixel(world(pose, body, at));
        }""",
        [scene, pose, body, at, "/page/"],
    )


def misfit(document: dict[str, Any], pose: dict[str, list[float]]) -> float:
    """Return by how much joints are open, m or rad, whatever drivers prescribe."""
    scene = resolved_scene(document)
    mechanism = AbsoluteMechanism(scene, view(scene), close_play=True, driven=False)
    q = flat({body: pose[body] for body in scene.bodies})
    residual, _ = arrays(mechanism.rows(q, [0.0] * len(q), first_clocks(scene)), len(q))
    return float(abs(residual).max())


def dragged_to(page: Any, document: dict[str, Any], body: str, at: list[float]) -> dict[str, Any]:
    """Drag a point of a scene that is shown; return the pose that is drawn when all is answered."""
    before = drawn(page)
    box = page.locator(CANVAS).bounding_box()
    x, y = pixel_of(page, document, before, body, at)
    page.mouse.move(box["x"] + x, box["y"] + y)
    page.mouse.down()
    for step in range(1, 21):
        page.mouse.move(box["x"] + x - step, box["y"] + y + step)
    page.mouse.up()
    page.wait_for_function(f"pose => !({DRAWN})(pose)", arg=before)
    expect(page.locator(CANVAS)).to_have_attribute("aria-busy", "false")
    return drawn(page)


@pytest.mark.parametrize("name", ["four-bar", "toggle", "slider without a driver", "body"])
def test_a_dragged_pose_is_kept_as_the_start(browsing: Any, service_url: str, name: str) -> None:
    """It could be looked at only: what was dragged into place had to be typed."""
    free = {key: value for key, value in toggle().items() if key != "drivers"}
    turned = five_bar() | {"drivers": {"turn": {"body": "left", "position": 2.0, "speed": 1.0}}}
    document, body, at = {
        "four-bar": (presets.document("four-bar"), "crank", [0.1, 0.0]),
        "toggle": (toggle(), "crank", [0.04, 0.0]),
        "slider without a driver": (free, "crank", [0.04, 0.0]),
        "body": (turned, "left", [0.1, 0.0]),
    }[name]
    with browsing.page(f"{service_url}/#/editor") as page:
        page.locator(CANVAS).wait_for()
        assert_kept(page, document, body, at)


def test_a_parameter_of_the_start_is_kept_as_it_was_dragged(
    browsing: Any, service_url: str
) -> None:
    """Its default put the mechanism back to where it had been."""
    document = presets.document("double-pendulum")
    target = {"path": "/start/angles/upper", "factor": -0.5}
    document["parameters"]["angle_upper"] |= {"default": -2.0, "targets": [target]}
    with browsing.page(f"{service_url}/#/editor") as page:
        page.locator(CANVAS).wait_for()
        shown(page, document)
        whole = assembled_scene(document, is_whole=True).document
        pose = dragged_to(page, whole, "lower", [0.5, 0.0])
        with page.expect_response(posed) as answer:
            page.get_by_role("button", name="Start here").click()
        assert flat(answer.value.json()["poses"][0]) == pytest.approx(flat(pose), abs=1e-7)
        written = json.loads(page.evaluate("sessionStorage.getItem('jointplay-scene')"))
    assert flat(assembled_scene(written, is_whole=True).pose()) == pytest.approx(
        flat(pose), abs=1e-7
    )
    before, now = document["parameters"], written["parameters"]
    found = {name: one["default"] for name, one in now.items() if one != before[name]}
    assert found == pytest.approx(
        {"angle_upper": -2.0 * pose["upper"][2], "angle_lower": pose["lower"][2]}
    )


def assert_kept(page: Any, document: dict[str, Any], body: str, at: list[float]) -> None:
    start = shown(page, document)["poses"][0]
    button = page.get_by_role("button", name="Start here")
    expect(button).to_be_disabled()
    pose = dragged_to(page, document, body, at)
    assert abs(pose[body][2] - start[body][2]) > 0.02
    with page.expect_response(posed) as answer:
        button.click()
    assert flat(answer.value.json()["poses"][0]) == pytest.approx(flat(pose), abs=1e-7)
    expect(button).to_be_disabled()
    written = json.loads(page.evaluate("sessionStorage.getItem('jointplay-scene')"))
    scene = assembled_scene(written, is_whole=True)
    assert flat(scene.pose()) == pytest.approx(flat(pose), abs=1e-7)
    assert {**written, "start": 0, "drivers": 0} == {**document, "start": 0, "drivers": 0}
