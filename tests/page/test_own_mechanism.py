"""A mechanism of one's own: proposed, corrected, drawn, run."""

import json

import httpx

from jointplay.solver.scene import presets
from tests.page.browsing import barriers, expect
from tests.page.test_watching import MOVED
from tests.two_assemblies import arm, toggle

PASTED = """(editor, text) => {
  const clipboardData = new DataTransfer();
  clipboardData.setData("text/plain", text);
  editor.dispatchEvent(new ClipboardEvent("paste", { clipboardData, cancelable: true }));
}"""
KEPT = "text => sessionStorage.getItem('jointplay-scene') === text"


def paste(page, document):
    """Replace the editor's text, as its own commands do.

    Playwright's `fill` selects in the browser, which the editor takes back when it marks an error
    in the same moment: the text would then be inserted instead.
    """
    text = page.get_by_label("Scene document")
    text.press("Control+a")
    text.evaluate(PASTED, document)
    page.wait_for_function(KEPT, arg=document)


def test_a_mechanism_is_written_corrected_and_run(browsing, url, artifacts):
    with browsing.page(f"{url}/#/editor", expected=("422",)) as page:
        text = page.get_by_label("Scene document")
        text.wait_for()
        assert barriers(page) == []
        page.screenshot(path=artifacts / "editor.png")
        page.get_by_label("Begin with").select_option("slider-crank")
        page.get_by_text('"slider-crank"').first.wait_for()
        page.get_by_text("Degrees of freedom: 2, or 0 without the clearance of P.").wait_for()
        page.get_by_text("of one core").wait_for()
        document = page.evaluate("sessionStorage.getItem('jointplay-scene')")
        wrong = document.replace('"mass": 0.21', '"mass": -0.21')
        assert wrong != document
        paste(page, wrong)
        page.get_by_role("button", name="/bodies/rod/mass").wait_for()
        paste(page, document.replace('"mass": 0.21', '"mass": 0.22'))
        page.get_by_role("button", name="/bodies/rod/mass").wait_for(state="detached")
        page.get_by_label("Duration").fill("0.01")
        page.get_by_role("button", name="Run", exact=True).click()
        page.wait_for_function(MOVED, arg=0)


def test_a_mechanism_of_ones_own_is_varied(browsing, url):
    with browsing.page(f"{url}/#/editor") as page:
        page.get_by_text("of one core").wait_for()
        page.get_by_role("button", name="Vary it …").click()
        page.get_by_label("What to compute").select_option("sweep")
        page.get_by_label("First parameter", exact=True).select_option("clearance")
        page.get_by_label("Values", exact=True).fill("3")
        page.get_by_label("Duration", exact=True).fill("0.05")
        page.get_by_label("speed", exact=True).fill("50")
        assert barriers(page) == []
        page.get_by_role("button", name="Run", exact=True).click()
        page.get_by_role("heading", name="mine · sweep").wait_for()
        page.get_by_text("succeeded", exact=True).wait_for()
        page.get_by_text("As a table").wait_for()
        job = page.url.split("/")[-1].split("?")[0]
    document = httpx.get(f"{url}/v1/jobs/{job}", trust_env=False).json()["job"]
    assert document["scene"]["parameters"]["speed"]["default"] == 50
    assert document["grid"]["clearance"]["count"] == 3
    with browsing.page(f"{url}/#/new") as page:
        page.get_by_text("No mechanism is being written in this tab").wait_for()


def test_the_editor_proposes_and_explains_what_the_schema_says(browsing, service_url):
    with browsing.page(f"{service_url}/#/editor") as page:
        text = page.get_by_label("Scene document")
        text.wait_for()
        text.press("Control+Home")
        text.press("End")
        text.press("Enter")
        text.type('"gra')
        page.get_by_role("option", name='"gravity"').click()  # Enter counts only a while later
        text.type("[0, -9.81],")
        page.wait_for_function("() => sessionStorage.getItem('jointplay-scene').includes('-9.81')")
        page.get_by_text('"ground"').first.hover()
        page.get_by_text("The frame: named points in world coordinates.").wait_for()
        page.get_by_text("Every field of a scene").click()
        page.get_by_label("Find a field").fill("effective_mass")
        page.get_by_role("heading", name="Tsuji").wait_for()
        assert barriers(page) == []


def test_what_a_run_does_not_keep_is_said_in_the_editor_and_of_the_run(browsing, url, artifacts):
    document = toggle()
    document["start"] = {"points": {"rod.K": [-0.06, 0.21]}}
    with browsing.page(f"{url}/#/editor") as page:
        page.get_by_label("Scene document").wait_for()
        paste(page, json.dumps(document))
        minus = "\N{MINUS SIGN}"
        asked = f"/start/points/rod.K asks for {minus}0.06, 0.21 m; the start has {minus}0.0518"
        page.get_by_text(asked).wait_for()
        page.screenshot(path=artifacts / "editor_notes.png")
        page.get_by_label("Duration").fill("0.001")
        page.get_by_role("button", name="Run", exact=True).click()
        page.get_by_text("for -0.06, 0.21 at /start/points/rod.K.").wait_for()
        page.screenshot(path=artifacts / "run_notes.png")


def test_what_may_be_meant_otherwise_is_said_in_the_editor(browsing, url):
    document = presets.document("pendulum")
    document["bodies"]["rod"]["mass"] = 2.0
    document["ground"]["points"]["W"] = [1.0, 1.0]
    ends = {"first": "ground.W", "second": "rod.tip"}
    document["forces"] = {"spring": {"type": "spring-damper", "stiffness": 10.0} | ends}
    with browsing.page(f"{url}/#/editor") as page:
        page.get_by_label("Scene document").wait_for()
        paste(page, json.dumps(document))
        page.get_by_text("mass puts 1 in place of 2 at /bodies/rod/mass").wait_for()
        page.get_by_text("it is 1 m long and pulls with 10 N").wait_for()


def test_what_is_told_of_a_scene_is_told_of_the_one_that_is_there(browsing, service_url):
    with browsing.page(f"{service_url}/#/editor") as page:
        page.get_by_label("Scene document").wait_for()
        duration, estimate = page.get_by_label("Duration"), page.get_by_text("of one core")
        for speed, proposed in ((4.0, "6.3"), (40.0, "0.63")):
            paste(page, json.dumps(arm(speed=speed)))
            expect(duration).to_have_value(proposed)
        estimate.wait_for()
        page.get_by_text("Degrees of freedom: 0.").wait_for()
        paste(page, '{"name": ')
        page.get_by_text("No estimate: ").wait_for()
        expect(page.get_by_text("Degrees of freedom")).to_have_count(0)
        expect(page.get_by_role("button", name="Run", exact=True)).to_be_disabled()
        paste(page, json.dumps(arm()).replace('"mass"', '"mass": 3.0, "mass"', 1))
        page.get_by_text("The key 'mass' is given twice").first.wait_for()
        expect(page.get_by_role("button", name="Run", exact=True)).to_be_disabled()
        duration.fill("0.5")
        swung = arm() | {"drivers": {}, "start": {"points": {"arm.E": [0.0, 0.2]}}}
        paste(page, json.dumps(swung))
        page.get_by_text("asks for 0, 0.2 m; the start has 0, 0.1 m.").wait_for()
        expect(duration).to_have_value("0.5")
        estimate.wait_for()
        aside = {"outputs": [{"name": "height", "channel": "arm.z", "help": "none"}]}
        paste(page, json.dumps(swung | aside))
        expect(page.get_by_text("No estimate: ")).to_contain_text("There is no channel 'arm.z'")


def test_a_scene_is_saved_as_a_file_and_opened_from_one(browsing, service_url, tmp_path):
    with browsing.page(f"{service_url}/#/editor", expected=("422",)) as page:
        text = page.get_by_label("Scene document")
        text.wait_for()
        written = json.dumps(arm(speed=4.0) | {"name": "arm-1"}, indent=1)
        paste(page, written)
        with page.expect_download() as begun:
            page.get_by_role("button", name="Save as a file").click()
        assert begun.value.suggested_filename == "arm-1.json"
        saved = tmp_path / "saved.json"
        begun.value.save_as(saved)
        assert saved.read_text() == written
        page.get_by_label("Begin with").select_option("pendulum")
        page.wait_for_function(
            "() => sessionStorage.getItem('jointplay-scene').includes('pendulum')"
        )
        page.get_by_label("A file with a scene").set_input_files(saved)
        page.wait_for_function(KEPT, arg=written)
        page.get_by_text("saved.json is open.").wait_for()
        page.get_by_text("Degrees of freedom: 0.").wait_for()
        other = tmp_path / "notes.txt"
        other.write_text("no scene")
        page.get_by_label("A file with a scene").set_input_files(other)
        page.get_by_text("No estimate: ").wait_for()
        text.press("Control+z")
        page.wait_for_function(KEPT, arg=written)  # what was there is one undo away
        assert barriers(page) == []


def test_a_picture_of_an_earlier_text_says_so(browsing, service_url):
    """Under a text that cannot be drawn it looked like its picture."""
    with browsing.page(f"{service_url}/#/editor", expected=("422",)) as page:
        page.get_by_text("Drag a point").wait_for()
        told = page.get_by_text("the picture is of an earlier one")
        fine = json.dumps(presets.document("pendulum"))
        for wrong in ("{", fine.replace("pendulum", "a pendulum", 1)):  # no document; no name
            paste(page, wrong)
            expect(told).to_be_visible()
            paste(page, fine)
            expect(told).to_have_count(0)


def test_a_duration_that_was_typed_is_that_of_what_is_varied(browsing, service_url):
    with browsing.page(f"{service_url}/#/editor") as page:
        duration = page.get_by_label("Duration")
        expect(duration).to_have_value("0.42")
        duration.fill("0.3")
        page.get_by_role("button", name="Vary it …").click()
        page.get_by_label("What to compute").wait_for()
        expect(page.get_by_label("Duration", exact=True)).to_have_value("0.3")
