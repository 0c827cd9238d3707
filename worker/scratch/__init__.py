"""Computing a block in a folder of this machine, of which others need what is sent.

Whoever keeps the files may be the object store, or a service that a worker joined.
"""
