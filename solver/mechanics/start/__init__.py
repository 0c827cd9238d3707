"""The start: what a scene gives holds where the joints allow it, the rest is fitted."""
