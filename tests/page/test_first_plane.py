"""The two channels that sections and phase portraits show before anything else is chosen."""

FIRST = """async (lists) => {
  const { firstPlane } = await import("/page/plots/plane.js");
  return lists.map((names) => firstPlane(names, new URLSearchParams()));
}"""
CRANK = ["crank.x", "crank.y", "crank.theta", "crank.omega"]


def test_it_is_of_what_moves(browsing, service_url):
    rod = ["rod.theta", "rod.omega"]
    wall = ["slot.wall_1.penetration", "slot.wall_1.penetration_rate"]
    pin = ["A.eccentricity_x", "A.eccentricity_y"]
    outputs = ["stroke", "speed"]
    lists = [
        [*CRANK, *rod],
        [*CRANK, *rod, *wall, "stroke"],
        [*CRANK, *wall, *pin],
        [*CRANK, *pin, *outputs],
        ["mass.x", "mass.vx"],
    ]
    with browsing.page(f"{service_url}/") as page:
        found = page.evaluate(FIRST, lists)
    assert found == [rod, wall, pin, outputs, ["mass.x", "mass.vx"]]
