"""Numbers as people read them."""

import pytest

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
    assert read == ["0 m", "0 m", "4.9e−15 m", "80 mm", "–"]


ERRORS = """async (pairs) => {
  const { withError } = await import("/page/interface/numbers.js");
  return pairs.map(([value, error]) => withError(value, error));
}"""


def test_a_value_has_the_digits_that_its_error_leaves(browsing, service_url):
    pairs = [[2.60417, 1.17], [-1.6372, 2.31], [93.04, 2.6], [1234.5, 0.012], [0, 2.4], [1.5, 0]]
    with browsing.page(f"{service_url}/") as page:
        read = page.evaluate(ERRORS, pairs)
    told = ["2.6 ± 1.2", "−1.6 ± 2.3", "93 ± 2.6", "1234.5 ± 0.012", "0 ± 2.4", "1.5 ± 0"]
    assert read == told


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


TICKS = """async (ranges) => {
  const { ticks } = await import("/page/plots/axes.js");
  return ranges.map(([low, high, wanted]) => ticks([low, high], wanted));
}"""


def test_the_scale_of_a_low_axis_can_be_read(browsing, service_url):
    exponents = [-768, 700, 84 / 45]  # 1/s on 84 px: one round number alone says nothing
    with browsing.page(f"{service_url}/") as page:
        low, usual, point = page.evaluate(TICKS, [exponents, [0, 1, 5], [2, 2, 3]])
    assert low == [-500, 0, 500]
    assert usual == pytest.approx([0, 0.2, 0.4, 0.6, 0.8, 1])
    assert len(point) <= 1


NARROW = """async (lists) => {
  const { extent, ticks } = await import("/page/plots/axes.js");
  return lists.map(([low, high]) => [extent([[low, high]]), ticks([low, high], 9)]);
}"""


def test_values_that_rounding_alone_parts_have_an_axis(browsing, service_url):
    """Counting from one round number to the next never came to the end: 1e16 + 1 is 1e16."""
    lists = [[1.0, 1 + 2.2e-16], [-3.0, -3 + 2e-12], [0.0, 5e-324], [1.0, 1 + 1e-9]]
    with browsing.page(f"{service_url}/") as page:
        one, minus, nought, apart = page.evaluate(NARROW, lists)
    assert one == [pytest.approx([0.5, 1.5]), [1.0]]
    assert minus == [pytest.approx([-4.5, -1.5]), [-3.0]]
    assert nought[1] == [0.0]
    (low, high), marks = apart
    assert low < 1.0
    assert high > 1 + 1e-9
    assert 2 <= len(marks) <= 20
    assert all(1.0 <= one <= 1 + 1.001e-9 for one in marks)


HIDDEN = """async ([titles, row, look, width]) => {
  const { table } = await import("/page/interface/table.js");
  const made = table("Numbers", titles, [row], look);
  const panel = document.createElement("div");
  panel.style.width = `${width}px`;
  panel.append(made);
  document.querySelector("main").replaceChildren(panel);
  return [made.scrollWidth - made.clientWidth, made.querySelector("tbody th").textContent];
}"""
NAME = "guide.upper_right_corner.penetration_rate"
NUMBER = "−103600\u00a0m/s²"
EXTREMES = (["Channel", "Smallest", "at", "Largest", "at"], [NAME, *[NUMBER, "2.989 ms"] * 2])
SPREADS = (["Channel", "Smallest", "Largest"], [NAME, *[f"{NUMBER} … {NUMBER}"] * 2])
ORBITS = (
    ["Orbit", "speed", "±", "there"],
    ["LP", "31.93 rad/s", "2e−12 rad/s", "fold: a multiplier passes 1 and the branch turns back"],
)


@pytest.mark.parametrize(
    ("shown", "look", "width"),
    [
        pytest.param(EXTREMES, "", 677, id="names beside another table on a page of 1280 px"),
        pytest.param(SPREADS, "small ranges", 480, id="ranges"),
        pytest.param(ORBITS, "small explained", 600, id="sentences"),
    ],
)
def test_a_table_of_long_texts_shows_all_its_columns(browsing, service_url, shown, look, width):
    with browsing.page(f"{service_url}/") as page:
        hidden, name = page.evaluate(HIDDEN, [*shown, look, width])
    assert (hidden, name) == (0, shown[1][0])
