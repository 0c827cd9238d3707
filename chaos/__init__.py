"""Faults on purpose: a whole service under a seeded schedule of them, and what it made of it."""
