"""Migrations of the catalogue's schema, one revision a file."""
