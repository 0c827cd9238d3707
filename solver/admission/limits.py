"""How much a job may ask for."""

LONGEST_RUN = 1e6
"""Longest duration of one run, in periods."""
LONGEST_IDEAL_RUN = 100.0
"""The same for an ideal mechanism that never repeats: every pose follows from the one before."""
MOST_SAMPLES = 100_000_000
MOST_BYTES = 10_000_000_000
BYTES_PER_VALUE = 8.0
DEFAULT_SAMPLES = 2000

MOST_POINTS = 100_000
"""Of a study."""
MOST_GEOMETRIES = 2000
"""Of a study, or structures: each takes about two milliseconds to put together."""
MOST_PERIODS = 1e8
"""Of all points of a study together."""
LONGEST_SETTLING = 2000
"""Periods after which "settle": "auto" stops waiting."""
EVENT_PATIENCE = 20
"""Periods per section that is not taken at a crank angle, before a run ends without it."""
LONGEST_ACCURACY_STUDY = 100
"""Periods: each of some fifty runs takes that long, and references at the tightest tolerance."""
MOST_STATISTICS = 512
"""Of channels and contacts, a point: each is an array of its own."""
MOST_SAMPLES_OF_STATISTICS = 1e10
"""Of all points of a study together: some hours of looking at them."""
BYTES_PER_POINT = 512.0
"""Of a study beside sections and peaks: status, statistics, indicators."""
