"""Computing in this process, without a service."""
