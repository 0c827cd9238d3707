"""The search for an extreme: brackets about it, a quartic through them, closer looks."""
