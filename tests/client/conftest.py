from tests.service_in_thread import (
    application,
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
    "application",
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
