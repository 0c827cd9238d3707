"""Studies: jobs of many points, computed in blocks of lanes."""
