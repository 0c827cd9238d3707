"""From numbers that were measured to the job that looks for the parameters that give them."""

from tests.page.browsing import barriers, expect

MEASURED = "channel,to,value\nbearing.normal_force,0.018,{}"


def test_what_was_measured_is_given_as_a_table_and_can_be_changed(browsing, url, artifacts):
    with browsing.page(f"{url}/#/new/bouncing-journal?kind=calibration&restitution=1") as page:
        measured = page.get_by_label("What was measured")
        measured.fill(MEASURED.format("much"))
        page.get_by_text("Line 2: “much” is no number for value.").wait_for()
        measured.fill(MEASURED.format(800))
        page.get_by_label("From", exact=True).fill("1e9")
        page.get_by_label("To", exact=True).fill("1e10")
        page.get_by_text("of one core").wait_for()
        page.get_by_role("button", name="JSON").click()
        copied = page.get_by_label("The same job", exact=True)
        expect(copied).to_contain_text('"spacing": "log"')
        assert barriers(page) == []
        page.screenshot(path=artifacts / "calibration-form.png", full_page=True)
        page.get_by_role("button", name="Run", exact=True).click()
        page.get_by_role("heading", name="bouncing journal · calibration").wait_for()
        page.get_by_role("button", name="Cancel").click()  # the search would take its time
        page.get_by_role("link", name="Run with changes").click()
        expect(measured).to_have_value(
            "channel,statistic,from,to,value,weight\nbearing.normal_force,maximum,0,0.018,800,1"
        )
        expect(page.get_by_label("To", exact=True)).to_have_value("10000000000")
