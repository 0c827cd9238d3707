"""Workers that reach a service over HTTPS alone: no database, broker or bucket is theirs.

Each claims blocks from the service, computes them in a folder of its own as any worker does, and
sends the files before it says that they are there.
"""
