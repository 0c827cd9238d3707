"""What accuracy costs: every method and tolerance on one scene, against a reference run."""
