"""Execution: joins the solver and the store, woken by Celery."""
