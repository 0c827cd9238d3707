"""The mechanism in motion, its joints with play magnified: as a film, and as one frame of it."""

from jointplay.figures.animation.film import film
from jointplay.figures.animation.pace import Pace
from jointplay.figures.animation.still import ANIMATION

__all__ = ["ANIMATION", "Pace", "film"]
