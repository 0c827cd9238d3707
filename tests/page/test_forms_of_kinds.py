"""Forms that are made of what the service says of a kind, also of one from outside."""

import json
import re
import shlex

import pytest

from jointplay.solver.kinds import KINDS, admit
from tests.page.browsing import UNFINISHED, barriers, expect, run_and_come_back
from tests.seams.relief import Relief


@pytest.fixture
def relief():
    KINDS["relief"] = Relief()
    yield
    del KINDS["relief"]


def shown_document(page):
    """Return the job that the page shows as JSON."""
    return json.loads(page.get_by_label("The same job", exact=True).inner_text())


@pytest.mark.usefixtures("relief")
def test_a_kind_of_two_axes_is_filled_in_submitted_and_changed(browsing, http, service_url):
    lacking = UNFINISHED  # how long each point runs; the figures of what was cancelled
    address = f"{service_url}/#/new/seven-bar-press?kind=relief"
    with browsing.page(address, expected=lacking) as page:
        expect(page.get_by_label("What to compute")).to_have_value("relief")
        page.get_by_text("Peaks and statistics over two parameters").wait_for()
        proposed = [page.get_by_label(one, exact=True).input_value() for one in ("Along", "By")]
        assert len({*proposed}) == 2
        page.get_by_label("Along", exact=True).select_option("clearance")
        page.get_by_label("By", exact=True).select_option("friction")
        for axis, *texts in (("Along", "2e-4", "4e-4", "3"), ("By", "0", "0.1", "2")):
            for end, text in zip(("from", "to", "values"), texts, strict=True):
                page.get_by_label(f"{axis}, {end}", exact=True).fill(text)
        page.get_by_label("Periods", exact=True).fill("2")
        page.get_by_role("button", name="JSON").click()
        document = shown_document(page)
        assert document == {
            "kind": "relief",
            "scene": {"preset": "seven-bar-press"},
            "along": {"parameter": "clearance", "values": {"from": 2e-4, "to": 4e-4, "count": 3}},
            "by": {"parameter": "friction", "values": {"from": 0, "to": 0.1, "count": 2}},
            "periods": 2,
        }
        assert admit(document).shape == (2, 3)
        assert barriers(page) == []
        run_and_come_back(page)
        expect(page.get_by_label("By", exact=True)).to_have_value("friction")
        expect(page.get_by_label("By, values", exact=True)).to_have_value("2")
        page.goto(f"{service_url}/#/jobs?kind=relief")
        expect(page.locator(".row")).to_have_count(1)
        words = re.compile(r"clearance .* … .*, friction 0 … 0.1")
        expect(page.locator(".row")).to_contain_text(words)


def test_kinds_without_a_form_of_their_own_have_one(browsing, service_url):
    with browsing.page(f"{service_url}/#/new/slider-crank?kind=ensemble") as page:
        page.get_by_label("Members", exact=True).fill("3")
        page.get_by_role("button", name="JSON").click()
        assert shown_document(page)["members"] == 3
        page.get_by_label("What to compute").select_option("poincare")
        page.get_by_label("Record", exact=True).fill("7")
        assert shown_document(page) == {
            "kind": "poincare",
            "scene": {"preset": "slider-crank"},
            "record": 7,
        }


def test_a_label_is_still_there_when_one_comes_back(browsing, service_url):
    """It was the only field that was lost."""
    with browsing.page(f"{service_url}/#/new/slider-crank", expected=UNFINISHED) as page:
        page.get_by_label("Duration", exact=True).fill("0.01")
        label = page.get_by_label("Label", exact=True)
        for typed in ("12", "0.3 mm & Öl?"):
            label.fill(typed)
            page.get_by_role("button", name="Run", exact=True).click()
            page.get_by_role("heading", name=typed).wait_for()
            page.get_by_role("button", name="Cancel").click()
            page.go_back()
            expect(label).to_have_value(typed)
            expect(page.get_by_label("Duration", exact=True)).to_have_value("0.01")
        label.fill("")
        page.reload()
        expect(label).to_have_value("")


def filled(page, **texts):
    """Type texts into fields, by their labels with _ for a blank."""
    for label, text in texts.items():
        page.get_by_label(label.replace("_", " "), exact=True).fill(text)


def test_a_continuation_is_filled_in_submitted_and_changed(browsing, service_url):
    lacking = UNFINISHED  # while fields are empty; the figures of what was cancelled
    address = f"{service_url}/#/new/impact-oscillator?kind=continuation"
    with browsing.page(address, expected=lacking) as page:
        page.get_by_label("Parameter", exact=True).select_option("speed")
        expect(page.get_by_label("From", exact=True)).to_have_value("13")  # of 25 rad/s a half
        expect(page.get_by_label("To", exact=True)).to_have_value("38")
        filled(page, From="20", To="30", Values="5")
        page.get_by_role("button", name="JSON").click()
        document = {
            "kind": "continuation",
            "scene": {"preset": "impact-oscillator"},
            "parameter": "speed",
            "values": {"from": 20, "to": 30, "count": 5},
        }
        assert shown_document(page) == document
        assert admit(document).points
        page.get_by_label("Second", exact=True).select_option("amplitude")
        second = {"parameter": "amplitude", "values": {"from": 0.0025, "to": 0.0075, "count": 24}}
        assert shown_document(page)["second"] == second
        assert barriers(page) == []
        run_and_come_back(page)
        expect(page.get_by_label("Parameter", exact=True)).to_have_value("speed")
        expect(page.get_by_label("To", exact=True)).to_have_value("30")
        expect(page.get_by_label("Second", exact=True)).to_have_value("amplitude")


def test_numbers_of_the_start_vary_and_are_drawn(browsing, service_url):
    lacking = UNFINISHED
    place, rate = ("/start/joints/stop/eccentricity/0", "/start/joints/stop/rate/0")
    address = f"{service_url}/#/new/impact-oscillator?kind=basins"
    with browsing.page(address, expected=lacking) as page:  # which proposes a place and its speed
        page.get_by_role("button", name="JSON").click()
        document = shown_document(page)
        values = {"from": -0.18, "to": 0.18, "count": 24}  # nine tenths of the play
        assert document["along"] == {"start": place, "values": values}
        assert document["by"]["start"] == rate
        assert admit(document).shape == (24, 24)
        run_and_come_back(page)
        expect(page.get_by_label("Along", exact=True)).to_have_value(place)
        expect(page.get_by_label("Along, to", exact=True)).to_have_value("0.18")
        page.goto(f"{service_url}/#/jobs?kind=basins")
        words = "stop.eccentricity_x −180 mm … 180 mm, stop.eccentricity_rate_x"
        expect(page.locator(".row").first).to_contain_text(words)
        page.go_back()
        page.get_by_label("What to compute").select_option("basin-stability")
        filled(page, Samples="7", Record="5")
        page.get_by_role("button", name="JSON").click()
        document = shown_document(page)
        assert document == {
            "kind": "basin-stability",
            "scene": {"preset": "impact-oscillator"},
            "starts": {place: {"distribution": "uniform", "low": -0.18, "high": 0.18}},
            "samples": 7,
            "record": 5,
        }
        assert admit(document).points == 7


def test_proposed_ranges_ascend_within_what_is_allowed(browsing, service_url):
    proposed = {
        ("double-four-bar", "sweep", "First parameter", "speed"): ("-1.5", "-0.5"),  # of -1 rad/s
        ("jansen-leg", "sweep", "First parameter", "restitution"): ("0.45", "1"),  # at most
        ("slider-crank", "sweep", "First parameter", "clearance_Q"): ("0", "0.01"),  # 0 by default
    }
    with browsing.page(service_url, expected=("422",)) as page:
        for (scene, kind, label, parameter), ends in proposed.items():
            page.goto(f"{service_url}/#/new/{scene}?kind={kind}")
            page.get_by_label(label, exact=True).select_option(parameter)
            for end, value in zip(("From", "To"), ends, strict=True):
                expect(page.get_by_label(end, exact=True)).to_have_value(value)
        page.goto(f"{service_url}/#/new/driven-pendulum?kind=basins")  # its motor turns the crank
        expect(page.get_by_label("Along", exact=True)).to_have_value("/start/angles/rod")


def test_the_ends_of_a_range_have_the_unit_of_what_varies(browsing, service_url):
    def unit(page, label):
        return page.get_by_label(label, exact=True).locator("xpath=following-sibling::*")

    wrong = ("422",)  # a speed that is typed, of a study over speeds
    with browsing.page(f"{service_url}/#/new/slider-crank?kind=sweep", expected=wrong) as page:
        expect(unit(page, "From")).to_have_text("m")
        page.get_by_label("First parameter", exact=True).select_option("speed")
        expect(unit(page, "To")).to_have_text("rad/s")
        expect(unit(page, "Second parameter, from")).to_have_text("")
        page.get_by_label("Second parameter", exact=True).select_option("clearance")
        expect(unit(page, "Second parameter, from")).to_have_text("m")
        page.get_by_label("What to compute").select_option("sensitivity")
        deviation = "Parameter 1, high or standard deviation"
        expect(unit(page, deviation)).to_have_text("m")
        page.get_by_label("Parameter 1, distribution", exact=True).select_option("log-normal")
        expect(unit(page, deviation)).to_have_text("")  # of the logarithm
        expect(unit(page, "Parameter 1, low or mean or median")).to_have_text("m")
        page.goto(f"{service_url}/#/new/slider-crank?kind=bifurcation&parameter=speed")
        expect(unit(page, "From")).to_have_text("rad/s")
        page.get_by_text("Its drivers come round every 12 ms.").wait_for()  # 5000 rpm
        page.get_by_text("more parameters").click()
        page.get_by_label("speed", exact=True).fill("100")
        page.get_by_text("Its drivers come round every 62.83 ms.").wait_for()


def test_the_command_line_says_all_of_a_run_or_takes_it_from_a_file(browsing, service_url):
    lacking = UNFINISHED
    with browsing.page(f"{service_url}/#/new/slider-crank", expected=lacking) as page:
        filled(page, Duration="0.05", Settling="0.01", Output_step="1e-4", Label="it's mine")
        page.get_by_role("button", name="Command line").click()
        text = page.get_by_label("The same job", exact=True)
        expect(text).to_have_text(
            "jointplay submit slider-crank --duration 0.05 --settle 0.01 --output-step 0.0001"
            r" --label 'it'\''s mine' --wait"
        )
        page.get_by_role("button", name="Run", exact=True).click()
        expect(page).to_have_url(re.compile("#/job/"))
        page.get_by_role("button", name="Cancel").click()
        page.get_by_role("link", name="Document").click()
        page.get_by_role("button", name="Command line").click()
        expect(text).to_contain_text("jointplay submit job.json")  # it has a tolerance, for example
        page.get_by_role("link", name="Run with changes").click()
        expect(page.get_by_label("Settling", exact=True)).to_have_value("0.01")
        expect(page.get_by_label("Output step", exact=True)).to_have_value("0.0001")


def test_what_is_proposed_follows_what_is_typed(browsing, service_url):
    with browsing.page(
        f"{service_url}/#/new/slider-crank?kind=bifurcation&parameter=speed"
    ) as page:
        start = page.get_by_label("From", exact=True)
        expect(start).to_have_value("260")  # rad/s, a half of the default: not of the clearance
        page.get_by_label("What to compute").select_option("basins")
        reach = page.get_by_label("Along, to", exact=True)
        expect(reach).to_have_value("0.00045")  # nine tenths of the play
        filled(page, clearance="2e-4")
        expect(reach).to_have_value("0.00018")
        filled(page, clearance="5e-4")
        expect(reach).to_have_value("0.00045")
        expect(page).to_have_url(re.compile(r"slider-crank\?kind=basins$"))  # as at first
        page.get_by_label("What to compute").select_option("simulate")
        duration = page.get_by_label("Duration", exact=True)
        expect(duration).to_have_value("0.048")  # four turns
        page.get_by_text("more parameters").click()
        filled(page, speed="100")
        expect(duration).to_have_value("0.25")
        filled(page, Duration="0.1", speed="200")
        page.get_by_text("A period is 31.42 ms here.").wait_for()
        expect(duration).to_have_value("0.1")


def test_what_the_service_refuses_stands_beside_its_field(browsing, service_url):
    def wrong(page, label, words):
        field = page.get_by_label(label, exact=True)
        expect(field).to_have_attribute("aria-invalid", "true")
        expect(field.locator("xpath=ancestor::div[@class='field'][1]")).to_contain_text(words)

    address = f"{service_url}/#/new/slider-crank?kind=bifurcation"
    with browsing.page(address, expected=("422",)) as page:
        filled(page, To="1")
        wrong(page, "To", "Value 47 of 'clearance' is 1 m; it lies between 0 and 0.01 m.")
        filled(page, To="0.001")
        expect(page.get_by_label("To", exact=True)).to_have_attribute("aria-invalid", "false")
        page.get_by_label("What to compute").select_option("sweep")
        page.get_by_label("Second parameter", exact=True).select_option("friction")
        filled(page, **{"Second parameter, to": "11"})
        wrong(page, "Second parameter, to", "is 11; it lies between 0 and 10.")
        page.get_by_label("What to compute").select_option("basins")
        filled(page, **{"Along, from": "-1"})
        wrong(page, "Along, from", "An eccentricity of 1 m is beyond reach")
        page.get_by_label("What to compute").select_option("sensitivity")
        expect(page.get_by_label("Parameter 2, distribution", exact=True)).to_be_hidden()
        filled(page, **{"Parameter 1, high or standard deviation": "1e-5"})
        wrong(page, "Parameter 1, high or standard deviation", "is not above 'low'")


@pytest.mark.parametrize(
    ("kind", "first", "second"),
    [
        ("sweep", "First parameter", "Second parameter"),
        ("sensitivity", "Parameter 1", "Parameter 2"),
    ],
)
def test_what_is_chosen_twice_is_refused(browsing, service_url, kind, first, second):
    """It was sent once, with the second range."""
    with browsing.page(f"{service_url}/#/new/slider-crank?kind={kind}") as page:
        chosen = page.get_by_label(first, exact=True).input_value()
        again = page.get_by_label(second, exact=True)
        again.select_option(chosen)
        expect(page.get_by_text("It is named twice.")).to_have_count(2)
        expect(again).to_have_attribute("aria-invalid", "true")
        page.get_by_role("button", name="Run", exact=True).click()
        expect(page.get_by_text("Correct the marked fields first.").first).to_be_visible()
        again.select_option("–")
        expect(page.get_by_text("It is named twice.")).to_have_count(0)


TEXT = """async (job) => {
  const { jobAsText } = await import("/page/interface/job_as_text.js");
  const { element } = jobAsText(() => job);
  [...element.querySelectorAll("button")].find((one) => one.textContent === "Command line").click();
  return element.querySelector("pre").textContent;
}"""
CHOICE = """async (law) => {
  const { ParameterFields } = await import("/page/interface/parameter_fields.js");
  const declared = { law: { choices: ["dry", "wet"], default: "dry", help: "", unit: "1" } };
  return new ParameterFields(declared, { law }).valid;
}"""


def test_a_command_to_copy_takes_values_literally(browsing, service_url):
    """A link could give a value that a shell evaluates."""
    evil = "$(touch x) 'y'"
    scene = {"preset": "slider-crank", "parameters": {"clearance": 2e-4, "law": evil}}
    job = {"kind": "simulate", "scene": scene, "duration": 0.5, "label": "it's"}
    with browsing.page(f"{service_url}/") as page:
        command = page.evaluate(TEXT, job)
        known, unknown = page.evaluate(CHOICE, "wet"), page.evaluate(CHOICE, evil)
    assert shlex.split(command) == [
        *("jointplay", "submit", "slider-crank", "--set", "clearance=0.0002"),
        *("--set", f"law={evil}", "--duration", "0.5", "--label", "it's", "--wait"),
    ]
    assert "--set clearance=0.0002 " in command
    assert (known, unknown) == (True, False)


def test_the_value_at_which_a_branch_begins_has_the_unit_of_its_parameter(browsing, service_url):
    """It was called "the parameter's unit", and a help was of a document's members."""
    address = f"{service_url}/#/new/impact-oscillator?kind=continuation"
    with browsing.page(address, expected=("422",)) as page:
        at = page.get_by_label("At", exact=True)
        for parameter, unit in {"gap": "m", "speed": "rad/s"}.items():
            page.get_by_label("Parameter", exact=True).select_option(parameter)
            expect(at.locator("xpath=following-sibling::*")).to_have_text(unit)
        second = page.get_by_label("Second", exact=True).locator("xpath=../..")
        expect(second).to_contain_text("of the first branch are followed.")
        orbits = page.get_by_label("Values", exact=True).locator("xpath=../..")
        expect(orbits).to_contain_text("how many orbits a branch may have in each direction.")


def test_no_cost_is_shown_of_another_job(browsing, service_url):
    """While the next one was asked for, the last answer stood there, and so did its refusal."""
    with browsing.page(f"{service_url}/#/new/pendulum") as page:
        page.get_by_text("of one core").wait_for()
        held = []
        page.route("**/v1/estimates", lambda route: held.append(route))  # no answer yet
        page.clock.install(time=0)
        page.clock.pause_at(1000)  # s
        for typed, told in {
            "none": "No estimate: Correct the marked fields first.",
            "0.25": "Estimating the cost …",
        }.items():
            page.get_by_label("Duration").fill(typed)
            page.clock.run_for(1000)  # ms: what is asked for later is asked for
            expect(page.locator(".acting [role=status]")).to_have_text(told)
