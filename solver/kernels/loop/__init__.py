"""Eight runs side by side: the driving loop around generated kernels, and all it keeps."""
