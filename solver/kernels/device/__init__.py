"""Lanes on a graphics processor: the loop and the equations of the CPU, one lane a thread."""
