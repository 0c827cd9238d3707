"""What happens to jobs, as it happens: waiting for their end, and streams of their events."""
