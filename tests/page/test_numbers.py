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
