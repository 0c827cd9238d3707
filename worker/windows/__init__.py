"""Windows of stored trajectories, computed from their steps: a question, and who answers it."""
