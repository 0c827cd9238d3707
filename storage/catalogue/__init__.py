"""The catalogue of jobs: submission, claims, leases, fencing, outbox, history.

A local run needs its `records`, not the database that `catalogue` imports.
"""
