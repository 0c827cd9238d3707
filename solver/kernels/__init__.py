"""Kernels: equations recorded, emitted as compiled code, and the loop that drives them."""
