"""The Celery application, through which workers are woken. Imports no task code.

Celery only wakes workers; a message carries a block's id and may be lost or come twice. Hence
messages are acknowledged before the work starts, nothing is prefetched, and there is no result
backend: the catalogue's leases say who works on what. With late acknowledgement a worker can
stop listening for good after Redis was silent; `socket_timeout` is safe only with early one.
"""

from typing import Any

from celery import Celery
from celery.app.amqp import AMQP
from kombu.connection import Connection
from kombu.entity import Exchange, Queue

from jointplay.storage.catalogue.records import QUEUES
from jointplay.storage.settings import Settings

RUN_BLOCK = "worker.run_block"
KEY_PREFIX = "jointplay:"  # of all keys in Redis


class _Connection(Connection):
    """A connection that is tried again every two seconds; Celery's pauses grow to half a minute."""

    def _ensure_connection(self, *given: Any, **named: Any) -> Any:
        pauses = {"interval_max": 2}
        return super()._ensure_connection(*given, **(pauses | named))  # type: ignore[no-untyped-call]


class _Messaging(AMQP):  # type: ignore[misc]
    Connection = _Connection


def broker_url(redis_url: str | None) -> str:
    """Return Celery's form of a Redis URL; certificates are verified unless it says otherwise."""
    if redis_url is None:
        return "redis://"
    if redis_url.startswith("rediss://") and "ssl_cert_reqs=" not in redis_url:
        # redis-py verifies by itself, and Celery does not
        return f"{redis_url}{'&' if '?' in redis_url else '?'}ssl_cert_reqs=required"
    return redis_url.replace("unix://", "redis+socket://", 1)


def make_app(redis_url: str | None) -> Celery:
    """Return an application that speaks to this Redis."""
    made = Celery("jointplay", amqp=_Messaging)
    made.conf.update(
        broker_url=broker_url(redis_url),
        result_backend=None,
        task_ignore_result=True,
        task_store_errors_even_if_ignored=False,
        task_acks_late=False,
        task_reject_on_worker_lost=False,
        worker_prefetch_multiplier=1,
        worker_disable_prefetch=True,
        worker_cancel_long_running_tasks_on_connection_loss=False,
        broker_connection_retry_on_startup=True,
        broker_connection_max_retries=None,
        broker_transport_options={
            "visibility_timeout": 3600,
            "unacked_restore_interval": 10,
            "unacked_restore_throttle": 1,
            "socket_connect_timeout": 5,
            "socket_keepalive": True,
            "health_check_interval": 10,
            "socket_timeout": 5,
            "global_keyprefix": KEY_PREFIX,
            "client_name": "jointplay-worker",
            "queue_order_strategy": "priority",
            "max_retries": 1,  # of a publisher: the relay comes back by itself
        },
        task_queues=[Queue(name, Exchange(name), name) for name in QUEUES],  # type: ignore[no-untyped-call]
        task_default_queue=QUEUES[-1],
        task_serializer="json",
        accept_content=["json"],
        task_create_missing_queues=False,
        task_publish_retry=False,
        task_time_limit=None,
        task_soft_time_limit=None,
        worker_max_tasks_per_child=200,
        worker_max_memory_per_child=1_500_000,
        worker_soft_shutdown_timeout=20,
        worker_send_task_events=False,
        worker_hijack_root_logger=False,
    )
    return made


app = make_app(Settings().redis_url)
