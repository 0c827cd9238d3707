"""Checks of the Kubernetes manifest where there is no cluster."""

import os
import re
from contextlib import closing
from dataclasses import replace
from pathlib import Path
from typing import Any

import psycopg
import pytest
import yaml
from sqlalchemy import make_url

from jointplay.service.app import create_app
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import NewJob, Solver
from jointplay.storage.object_stores import object_store_at
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
SECRETS = set(re.findall(r"--from-file=(\w+)=", (ROOT / "kubernetes.yml").read_text()))


def test_our_processes_take_their_environment_and_its_files(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    (tmp_path / "..data").mkdir()  # as Kubernetes lays secrets out
    for name in SECRETS:
        monkeypatch.setenv(name, "")  # is taken away again
        del os.environ[name]
        (tmp_path / "..data" / name).write_text("p@ss/w:rd")
        (tmp_path / name).symlink_to(Path("..data") / name)
    for name, value in CONFIGURED.items():
        monkeypatch.setenv(name, value)
    monkeypatch.setenv("JOINTPLAY_SECRETS", str(tmp_path))
    settings = Settings()
    catalogue = make_url(settings.catalogue_url)
    assert (catalogue.password, catalogue.query["sslmode"]) == ("p@ss/w:rd", "verify-full")
    assert os.environ["AWS_SECRET_ACCESS_KEY"] == "p@ss/w:rd"
    assert settings.object_store is object_store_at(CONFIGURED["JOINTPLAY_RESULTS_URL"])
    assert (settings.keys, settings.log_format) == ("required", "json")
    known = {f"JOINTPLAY_{name.upper()}" for name in Settings.model_fields}
    assert set(CONFIGURED) - {"JOINTPLAY_SECRETS"} <= known


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
    assert container["envFrom"] == [{"configMapRef": {"name": "jointplay"}}]
    assert [(mount["name"], mount["mountPath"]) for mount in container["volumeMounts"]] == [
        ("data", CONFIGURED["JOINTPLAY_DATA"]),
        ("secrets", CONFIGURED["JOINTPLAY_SECRETS"]),
    ]
    data, secrets = pod["volumes"]
    assert (data["name"], secrets["name"]) == ("data", "secrets")
    assert secrets["secret"] == {"secretName": "jointplay", "defaultMode": 0o440}


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


def test_keda_counts_blocks_of_its_version_and_class_that_wait_or_are_computed() -> None:
    scaled = BY_NAME["ScaledObject", "worker"]["spec"]
    (trigger,) = scaled["triggers"]
    assert scaled["scaleTargetRef"]["name"] in PODS
    asked, catalogue_url = trigger["metadata"], make_url(CONFIGURED["JOINTPLAY_CATALOGUE_URL"])
    assert [asked[name] for name in ("host", "userName", "dbName", "sslmode")] == [
        catalogue_url.host,
        catalogue_url.username,
        catalogue_url.database,
        catalogue_url.query["sslmode"],
    ]
    (reference,) = BY_NAME["TriggerAuthentication", trigger["authenticationRef"]["name"]]["spec"][
        "secretTargetRef"
    ]
    assert reference["key"] in SECRETS
    solver = own_solver()
    query = asked["query"].replace("SOLVER_VERSION", solver.version)
    query = query.replace("PROCESSOR", solver.processor)
    assert "SOLVER" not in query
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
            job = catalogue.submit(replace(new, digest="e" * 64)).job.id
            assert counted() == 4
            foreign = Solver(solver.version, "another-class")
            assert catalogue.claim_block(f"{job}-0", "elsewhere", 30.0, foreign) is not None
            assert counted() == 1


def test_core_documents_are_of_the_schemas_of_kubernetes() -> None:
    schemas = pytest.importorskip("kubernetes_validate")
    core = [one for one in DOCUMENTS if "keda.sh" not in one["apiVersion"]]
    assert len(core) == len(DOCUMENTS) - 2
    for document in core:
        schemas.validate(document, "1.33", strict=True)
    document["spec"]["replica"] = 1
    with pytest.raises(schemas.ValidationError):
        schemas.validate(document, "1.33", strict=True)
