"""``/v1/batches``: many jobs submitted together, all or none of them."""
