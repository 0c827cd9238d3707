"""What jobs are found by, how many steps they took, and when their results were removed."""

from typing import Any

import sqlalchemy as sa
from alembic import op

revision = "0003"
down_revision = "0002"


def upgrade() -> None:
    """Add columns to job and block, and an index for each filter of the list."""
    op.add_column("job", sa.Column("scene", sa.String(200)))
    op.add_column("job", sa.Column("steps", sa.BigInteger))
    op.add_column("job", sa.Column("removed", sa.Float(53)))
    op.add_column("block", sa.Column("progress_steps", sa.BigInteger))
    for column in ("kind", "label", "scene"):
        op.create_index(f"ix_job_{column}_id", "job", [column, "id"])
    op.create_index("ix_job_removed_expires", "job", ["removed", "expires"])
    op.drop_index("ix_job_expires", table_name="job")
    _name_scenes()


def _name_scenes() -> None:
    job = sa.table("job", sa.column("id"), sa.column("spec", sa.JSON), sa.column("scene"))
    connection = op.get_bind()
    found = connection.execute(sa.select(job.c.id, job.c.spec))
    names = [{"job": row.id, "name": _scene_of(row.spec)} for row in found]
    named = [one for one in names if one["name"] is not None]
    if named:
        of_job = sa.update(job).where(job.c.id == sa.bindparam("job"))
        connection.execute(of_job.values(scene=sa.bindparam("name")), named)


def _scene_of(spec: Any) -> str | None:
    scene = spec.get("scene") if isinstance(spec, dict) else None
    name = (scene.get("preset") or scene.get("name")) if isinstance(scene, dict) else None
    return None if name is None else str(name)[:200]
