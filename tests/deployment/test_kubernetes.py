"""Checks of the Kubernetes manifest where there is no cluster."""

from contextlib import closing
from dataclasses import replace
from pathlib import Path
from typing import Any

import psycopg
import pytest
import yaml

from jointplay.service.app import create_app
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import NewJob
from jointplay.storage.places import place_at
from jointplay.storage.settings import Settings
from jointplay.worker.own_solver import own_solver
from tests.postgresql_server import running_server

ROOT = Path(__file__).resolve().parents[2]
DOCUMENTS: list[dict[str, Any]] = list(yaml.safe_load_all((ROOT / "kubernetes.yml").read_text()))
BY_NAME = {(one["kind"], one["metadata"]["name"]): one for one in DOCUMENTS}
PODS = {
    name: one["spec"]["template"] for (kind, name), one in BY_NAME.items() if kind == "Deployment"
}
COMPOSE = yaml.safe_load((ROOT / "compose.cluster.yml").read_text())["services"]
CONFIGURED: dict[str, str] = BY_NAME["ConfigMap", "jointplay"]["data"]
SECRETS = {"JOINTPLAY_CATALOGUE_URL": "postgresql://h/d", "JOINTPLAY_REDIS_URL": "rediss://h"}


def test_our_processes_take_their_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    given = CONFIGURED | SECRETS
    for name, value in given.items():
        monkeypatch.setenv(name, value)
    settings = Settings()
    assert settings.place is place_at(CONFIGURED["JOINTPLAY_RESULTS_URL"])
    assert (settings.keys, settings.log_format) == ("required", "json")
    assert set(given) <= {f"JOINTPLAY_{name.upper()}" for name in Settings.model_fields}


@pytest.mark.parametrize("name", ["api", "relay", "worker"])
def test_pods_run_what_compose_runs_without_privileges(name: str) -> None:
    pod = PODS[name]["spec"]
    (container,) = pod["containers"]
    assert container["command"] == COMPOSE[name]["command"]
    assert container["image"] == COMPOSE[name]["image"]
    assert (
        BY_NAME["Deployment", name]["spec"]["selector"]["matchLabels"]
        == (PODS[name]["metadata"]["labels"])
    )
    assert pod["securityContext"]["runAsNonRoot"]
    assert pod["securityContext"]["runAsUser"] > 0
    assert not pod["automountServiceAccountToken"]
    assert container["securityContext"] == {
        "allowPrivilegeEscalation": False,
        "capabilities": {"drop": ["ALL"]},
    }
    assert [list(source.values()) for source in container["envFrom"]] == [
        [{"name": "jointplay"}]
    ] * 2
    assert container["volumeMounts"] == [
        {"name": "data", "mountPath": CONFIGURED["JOINTPLAY_DATA"]}
    ]


def test_probes_and_service_meet_the_api(tmp_path: Path) -> None:
    (container,) = PODS["api"]["spec"]["containers"]
    (port,) = container["ports"]
    assert container["command"][-2:] == ["--port", str(port["containerPort"])]
    assert f"EXPOSE {port['containerPort']}\n" in (ROOT / "Dockerfile").read_text()
    paths = create_app(Settings(data=tmp_path)).openapi()["paths"]
    probes = {name: container[f"{name}Probe"]["httpGet"] for name in ("liveness", "readiness")}
    assert all(
        probe["port"] == port["name"] and probe["path"] in paths for probe in probes.values()
    )
    assert (probes["liveness"]["path"], probes["readiness"]["path"]) == ("/healthz", "/readyz")
    service = BY_NAME["Service", "jointplay"]["spec"]
    assert service["selector"] == PODS["api"]["metadata"]["labels"]
    assert service["ports"][0]["targetPort"] == port["name"]
    assert [BY_NAME["Deployment", name]["spec"].get("replicas") for name in PODS] == [2, 2, None]


def test_keda_counts_blocks_of_its_version_that_wait_or_are_computed() -> None:
    scaled = BY_NAME["ScaledObject", "worker"]["spec"]
    (trigger,) = scaled["triggers"]
    assert scaled["scaleTargetRef"]["name"] in PODS
    assert trigger["metadata"]["connectionFromEnv"] in SECRETS
    solver = own_solver()
    query = trigger["metadata"]["query"].replace("SOLVER_VERSION", solver.version)
    assert query != trigger["metadata"]["query"]
    with running_server() as server:
        url = server.new()
        with (
            closing(Catalogue(url)) as catalogue,
            psycopg.connect(url, autocommit=True) as connection,
        ):

            def counted() -> int:
                row = connection.execute(query).fetchone()
                assert row is not None
                return int(row[0])

            assert counted() == 0
            new = NewJob(
                "sweep", {}, "d" * 64, solver.version, blocks=((0, 4), (4, 4), (8, 2)), seal=True
            )
            catalogue.submit(replace(new, solver_version="another"))
            assert counted() == 0
            job = catalogue.submit(new).job.id
            assert counted() == 3  # the block that seals waits for the others
            assert catalogue.claim_block(f"{job}-0", "worker", 30.0, solver) is not None
            assert counted() == 3
            catalogue.request_cancel(job)
            assert counted() == 1
