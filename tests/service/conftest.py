from tests.service_in_thread import (
    catalogue,
    finished_accuracy,
    finished_job,
    finished_study,
    finished_sweep,
    fresh_service,
    http,
    service_url,
    settings,
    worker,
)

__all__ = [
    "catalogue",
    "finished_accuracy",
    "finished_job",
    "finished_study",
    "finished_sweep",
    "fresh_service",
    "http",
    "service_url",
    "settings",
    "worker",
]
