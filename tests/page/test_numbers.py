"""Numbers as people read them."""

READ = """async (pairs) => {
  const { notRounding, withUnit } = await import("/page/interface/numbers.js");
  return pairs.map(([value, beside]) => withUnit(notRounding(value, beside), "m"));
}"""


def test_rounding_beside_a_larger_value_is_nothing(browsing, service_url):
    crank = 0.08  # m; at 90 degrees it is 4.9e-18 m to the side
    pairs = [
        [4.9e-18, crank],
        [-4.9e-18, -crank],
        [4.9e-15, crank],
        [crank, 4.9e-18],
        [None, crank],
    ]
    with browsing.page(f"{service_url}/") as page:
        read = page.evaluate(READ, pairs)
    assert read == ["0 m", "0 m", "0.0049 pm", "80 mm", "–"]


AXIS = """async (lists) => {
  const { apart, axisLabel } = await import("/page/interface/numbers.js");
  return [lists.map((values) => apart(values).map(([, text]) => text)),
    axisLabel("friction", ""), axisLabel("clearance", "mm")];
}"""


def test_numbers_along_an_axis_differ(browsing, service_url):
    lists = [[0.17044, 0.17046, 0.17048], [0.1 + 0.2, 0.4], [-1.0, 0.0], [2.0], []]
    with browsing.page(f"{service_url}/") as page:
        texts, *labels = page.evaluate(AXIS, lists)
    assert texts == [["0.17044", "0.17046", "0.17048"], ["0.3", "0.4"], ["−1", "0"], ["2"], []]
    assert labels == ["friction", "clearance [mm]"]


HIDDEN = """async (names) => {
  const { table } = await import("/page/interface/table.js");
  const number = "−103600 m/s²";
  const made = table("Extremes", ["Channel", "Smallest", "at", "Largest", "at"],
    names.map((name) => [name, number, "2.989 ms", number, "2.989 ms"]));
  const panel = document.createElement("div");
  panel.style.width = "677px"; // beside another on a page of 1280 px
  panel.append(made);
  document.querySelector("main").replaceChildren(panel);
  return [made.scrollWidth - made.clientWidth, made.querySelector("tbody th").textContent];
}"""


def test_a_table_of_long_names_shows_all_its_columns(browsing, service_url):
    with browsing.page(f"{service_url}/") as page:
        hidden, name = page.evaluate(HIDDEN, ["guide.upper_right_corner.penetration_rate"])
    assert (hidden, name) == (0, "guide.upper_right_corner.penetration_rate")
