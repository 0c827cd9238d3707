"""How far a trajectory can be believed: what seven companions in its bundle say of it."""
