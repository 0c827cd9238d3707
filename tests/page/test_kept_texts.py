"""Texts that a tab keeps, its storage full or forbidden; pictures of a service that is away."""

import pytest

FULL = """async () => {
  sessionStorage.setItem("jointplay-scene", "older");
  Storage.prototype.setItem = () => { throw new DOMException("full", "QuotaExceededError"); };
  const { keep, kept } = await import("/page/editor/kept.js");
  keep("newer");
  return [kept(), sessionStorage.getItem("jointplay-scene")];
}"""
FORBIDDEN = """async () => {
  const refuse = { get() { throw new DOMException("denied", "SecurityError"); } };
  Object.defineProperty(globalThis, "sessionStorage", refuse);
  const { keep, kept } = await import("/page/editor/kept.js");
  const { keepKey, keyHeaders } = await import("/page/requests/key.js");
  const before = [kept(), keyHeaders()];
  keep("text");
  keepKey("jp_key");
  return [...before, kept(), keyHeaders().Authorization];
}"""
AWAY = """async () => {
  const { openAddress } = await import("/page/requests/key.js");
  globalThis.fetch = async () => { throw new TypeError("Failed to fetch"); };
  return openAddress("/v1/picture.png", true);
}"""


@pytest.mark.parametrize(
    ("script", "found"),
    [
        (FULL, ["newer", None]),
        (FORBIDDEN, [None, {}, "text", "Bearer jp_key"]),
        (AWAY, "/v1/picture.png"),
    ],
    ids=["full", "forbidden", "away"],
)
def test_the_page_goes_on(browsing, service_url, script, found):
    """These were errors: what was written was lost, or nothing was shown at all."""
    with browsing.page(f"{service_url}/") as page:
        answer = page.evaluate(script)
    assert answer == found
