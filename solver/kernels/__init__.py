"""Kernels: equations traced, emitted as compiled code, and the loop that drives them."""
