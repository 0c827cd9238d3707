"""From traced equations to kernels that advance several parameter sets at once."""
