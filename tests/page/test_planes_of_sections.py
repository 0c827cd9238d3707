"""Sections of a study on a plane: all pages of the answer, under the names that they have."""

from tests.page.browsing import expect

STUDY = """async () => {
  const { show } = await import("/page/views/job/sections.js");
  const asked = globalThis.fetch;
  globalThis.fetch = async (path, options) => {
    const query = new URL(path, location).searchParams;
    if (!path.startsWith("/sections")) return asked(path, options);
    const names = query.get("channels").split(",");
    if (names.includes("c")) {
      return new Response(JSON.stringify({ detail: "It broke." }), { status: 500 });
    }
    const start = Number(query.get("start") ?? 0);
    const one = (name) => [name, { unit: "m", values: [[start, start + 1]] }];
    return new Response(JSON.stringify({
      channels: Object.fromEntries(names.map(one)), note: "",
      next_start: start < 2 ? start + 1 : null,
    }));
  };
  const room = document.createElement("div");
  document.querySelector("main").replaceChildren(room);
  const job = { state: "succeeded", progress: { fraction: 1 }, links: { poincare: "/sections" },
    job: { observables: ["a", "b", "c"] } };
  const query = new URLSearchParams("x=a&y=b");
  const { signal } = new AbortController();
  await show(room, { job, query, signal, onChange: () => {} });
}"""


def test_all_pages_are_shown_and_points_keep_their_names(browsing, service_url):
    """The first page was shown as all; points had the names of a choice that had not come."""
    with browsing.page(f"{service_url}/") as page:
        page.get_by_role("heading", level=1).wait_for()
        page.evaluate(STUDY)
        plane = page.locator("canvas[data-points='6']")
        expect(plane).to_have_attribute("aria-label", "6 sections: b over a")
        page.get_by_label("Up").select_option("c")
        expect(page.get_by_text("It broke.")).to_be_visible()
        page.emulate_media(color_scheme="dark")  # it is drawn once more
        page.set_viewport_size({"width": 900, "height": 900})
        expect(plane).to_have_attribute("aria-label", "6 sections: b over a")
        page.get_by_label("Up").select_option("a")
        expect(plane).to_have_attribute("aria-label", "6 sections: a over a")
        expect(page.get_by_text("It broke.")).to_be_hidden()
