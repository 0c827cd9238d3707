"""Results of a study: one Zarr v3 store that the workers of its blocks fill together.

`store` makes the store and finishes it; `block` takes what one block computes, and `reader` reads
everything, also while it grows. The package knows nothing of mechanisms.
"""
