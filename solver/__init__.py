"""Physics of planar mechanisms: scenes, their equations, the kernels compiled from them."""
