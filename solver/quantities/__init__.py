"""Physical quantities: units of scene fields, scalars that may be numbers or expressions."""
