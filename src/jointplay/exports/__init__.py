"""Results as text for other programs: CSV and JSON."""
