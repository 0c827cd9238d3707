"""HTTP: the REST API over the catalogue and the results store."""
