from tests.service.guarded import guarded
from tests.service_in_thread import (
    application,
    catalogue,
    fresh_service,
    http,
    service_url,
    settings,
)
from tests.worker_by_hand import (
    finished_accuracy,
    finished_job,
    finished_study,
    finished_sweep,
    worker,
)
