"""The driving loop around generated kernels: runs side by side, and all it keeps of them."""
