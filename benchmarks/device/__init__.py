"""Three mechanisms on a graphics processor: their bits, and revolutions a second."""
