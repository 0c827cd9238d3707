"""The cost of accuracy: every method and tolerance on one scene, against a reference run."""
