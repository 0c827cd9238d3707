"""Streams of events: one for each view of a job, and none of a tab that is hidden."""

from tests.page.browsing import expect

FOLLOWED = """async () => {
  const { follow } = await import("/page/requests/following.js");
  const others = fetch;
  Object.assign(globalThis, { opened: [], open: 0, left: new AbortController(), told: [] });
  globalThis.fetch = async (path, options) => {
    if (!path.startsWith("/late")) return others(path, options);
    opened.push(options.headers["Last-Event-ID"] ?? "");
    open += 1;
    let control;
    const body = new ReadableStream({ start: (some) => (control = some) });
    options.signal.addEventListener("abort", () => {
      open -= 1;
      control.error(new DOMException("", "AbortError"));
    });
    const event = { type: "claimed", n: opened.length };
    control.enqueue(new TextEncoder().encode(
      `id: ${opened.length}\\ndata: ${JSON.stringify(event)}\\n\\n`));
    return new Response(body);
  };
  follow("/late", { signal: left.signal, onEvent: ({ n }) => told.push(n) });
}"""
HIDDEN = """(hidden) => {
  Object.defineProperty(document, "hidden", { value: hidden, configurable: true });
  document.dispatchEvent(new Event("visibilitychange"));
}"""


def test_a_hidden_tab_has_no_stream_and_misses_nothing(browsing, service_url):
    """A browser has six connections to a service for all tabs: the seventh tab stood still."""
    with browsing.page(f"{service_url}/") as page:
        page.evaluate(FOLLOWED)
        page.wait_for_function("() => told.length === 1 && open === 1")
        page.evaluate(HIDDEN, True)
        page.wait_for_function("() => open === 0")
        page.evaluate(HIDDEN, False)
        page.wait_for_function("() => told.length === 2 && open === 1")
        opened = page.evaluate("() => opened")
        assert opened == ["", "1"]
        page.evaluate("() => left.abort()")
        page.wait_for_function("() => open === 0")


def test_a_document_hears_from_the_stream_of_its_job(browsing, service_url, worker):
    """It had a second one."""
    job_id = worker.submit(label="one stream")
    asked = []

    def note(request):
        if request.url.endswith("/events"):
            asked.append(request.url)

    with browsing.page(f"{service_url}/healthz") as page:
        page.on("request", note)
        page.goto(f"{service_url}/#/job/{job_id}/document")
        rows = page.locator("tbody tr")
        expect(rows.first).to_contain_text("queued")
        worker.start(job_id)
        page.get_by_text("running", exact=True).first.wait_for()
        expect(rows).not_to_have_count(1)
    assert len(asked) == 1
