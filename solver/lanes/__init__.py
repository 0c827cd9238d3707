"""Lanes of kernels, as runs use them: problems bound to numbers, started, advanced and read."""
