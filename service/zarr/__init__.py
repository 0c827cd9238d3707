"""The stores of jobs over HTTP, for stock Zarr clients."""
