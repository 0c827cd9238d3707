"""Preset mechanisms, one JSON document each."""
