"""Scenes over HTTP: the presets, and any scene checked or drawn before it is run."""
