"""The vocabulary that every package shares: runs, studies, channels, failures, names."""
