"""The loose slider-crank with random laws of contact and friction."""

from typing import Any

from benchmarks.lies.draw import Draw
from benchmarks.lies.scenes.mechanisms import slider_crank

DISSIPATIONS = (
    *("exact", "hunt-crossley", "herbert-mcwhannell", "lee-wang", "lankarani-nikravesh"),
    *("gonthier", "zhiying-qishao", "flores", "hu-guo", "gharib-hurmuzlu"),
    "safaeifar-farshidianfar",
)
"""Laws that need the restitution coefficient alone."""


def loose_slider_crank(draw: Draw) -> tuple[dict[str, Any], float]:
    """Return the mechanism with laws of its own at either pin."""
    scene, unit = slider_crank(draw)
    for joint in ("P", "Q"):
        clearance = scene["joints"][joint]["clearance"]
        contact = clearance["contact"]
        clearance["contact"] = {
            "law": "stiffness-and-dissipation",
            "stiffness": {
                "law": "power",
                "stiffness": contact["stiffness"],
                "exponent": draw.even(1.2, 2.0),
            },
            "dissipation": {
                "law": draw.one_of(*DISSIPATIONS),
                "restitution": contact["restitution"],
            },
        }
        clearance["friction"] = _friction(draw, clearance["friction"])
    return scene, unit


def _friction(draw: Draw, coulomb: dict[str, Any]) -> dict[str, Any]:
    """Return one of the laws, as strong and as steep as Coulomb's with bends."""
    coefficient, slip = coulomb["coefficient"], coulomb["dynamic_velocity"]
    static = {"static_coefficient": 1.3 * coefficient, "kinetic_coefficient": coefficient}
    return draw.one_of(
        coulomb,
        {"law": "threlfall", "coefficient": coefficient, "full_velocity": slip},
        {"law": "brown-mcphee", **static, "transition_velocity": slip},
        {"law": "stribeck", **static},
    )
