"""The restitution that dissipation laws deliver in free impacts, beside the one that is asked.

Measured by the solver: ``python -m benchmarks restitution``, tolerance 1e-10. Laws whose damping is
a multiple of the elastic force deliver it at any speed, mass and stiffness; `jankowski` and `tsuji`
with the exponent 1.5 and the mass that the contact feels.
"""

ASKED = (0.1, 0.3, 0.5, 0.7, 0.8, 0.9, 0.95, 0.99)
DELIVERED: dict[str, tuple[float, ...]] = {
    "exact": (0.1000, 0.3000, 0.5000, 0.7000, 0.8000, 0.9000, 0.9500, 0.9900),
    "hunt-crossley": (0.5158, 0.5813, 0.6630, 0.7680, 0.8329, 0.9090, 0.9524, 0.9901),
    "herbert-mcwhannell": (0.4907, 0.5200, 0.5936, 0.7227, 0.8070, 0.9009, 0.9501, 0.9900),
    "lee-wang": (0.6867, 0.7390, 0.7992, 0.8693, 0.9090, 0.9524, 0.9756, 0.9950),
    "lankarani-nikravesh": (0.6653, 0.6842, 0.7252, 0.7960, 0.8471, 0.9132, 0.9535, 0.9901),
    "gonthier": (0.1010, 0.3042, 0.4877, 0.6696, 0.7680, 0.8764, 0.9359, 0.9868),
    "zhiying-qishao": (0.2175, 0.3267, 0.4826, 0.6796, 0.7874, 0.8959, 0.9489, 0.9900),
    "flores": (0.0694, 0.2562, 0.4704, 0.6832, 0.7885, 0.8939, 0.9468, 0.9893),
    "hu-guo": (0.0741, 0.2707, 0.4877, 0.6973, 0.7992, 0.8999, 0.9500, 0.9900),
    "gharib-hurmuzlu": (0.1000, 0.2819, 0.4107, 0.5008, 0.5362, 0.5668, 0.5807, 0.5911),
    "safaeifar-farshidianfar": (0.0889, 0.3138, 0.5362, 0.7350, 0.8271, 0.9152, 0.9580, 0.9917),
    "jankowski": (0.0933, 0.2917, 0.4946, 0.6977, 0.7989, 0.8997, 0.9499, 0.9900),
    "tsuji": (0.2527, 0.3971, 0.5503, 0.7182, 0.8081, 0.9020, 0.9505, 0.9900),
}
"""Restitution delivered, by law, for each one asked."""
