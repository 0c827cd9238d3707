"""From the mechanics on abstract scalars to kernels that run eight parameter sets at once."""
