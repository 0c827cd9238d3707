"""Claims, which PostgreSQL carries out by itself, each in one exchange with it; see `calls`.

Claimants wait for each other: a claim of ten exchanges would hold what others want as long. The
functions do what the statements of `claims` do one by one on SQLite, to the same specifications.
The job is locked first: every later statement sees what others committed before that.
"""

from functools import reduce
from typing import Final

from sqlalchemy import Connection

from jointplay.storage.catalogue import fair_queueing

_WRITTEN: Final = (
    """
CREATE OR REPLACE FUNCTION claim_block(wanted text, claimant text, moment float8, lease float8,
  by_version text, by_processor text)
RETURNS TABLE (held block, of_job job) LANGUAGE plpgsql AS $$
#variable_conflict use_column
DECLARE
  last integer;
  least float8;
  paid float8;
BEGIN
  SELECT * INTO of_job FROM job
    WHERE id = (SELECT block.job FROM block WHERE block.id = wanted) FOR NO KEY UPDATE;
  IF NOT FOUND OR of_job.state IN ('succeeded', 'failed', 'cancelled') THEN
    RETURN;
  END IF;
  IF of_job.solver_version <> by_version OR of_job.processor <> by_processor THEN
    RETURN;
  END IF;
  UPDATE block
    SET state = 'running', attempt = attempt + 1, lease_until = moment + lease, worker = claimant
    WHERE id = wanted AND state = 'queued' RETURNING * INTO held;
  IF NOT FOUND THEN
    RETURN;
  END IF;
  DELETE FROM outbox WHERE block = wanted;
  least := coalesce((SELECT max(began) FROM share WHERE queue = 'jobs'), 0) - MOST_BEHIND;
  UPDATE share SET began = greatest(next, least), next = greatest(next, least) + cost
    WHERE queue = 'jobs' AND owner IN (
      SELECT owner FROM share WHERE queue = 'jobs' AND owner = of_job.owner
      FOR UPDATE SKIP LOCKED) RETURNING cost INTO paid;
  INSERT INTO attempt (block, number, worker, started, account, charged)
    VALUES (wanted, held.attempt, claimant, moment, 'jobs', coalesce(paid, 0));
  SELECT coalesce(max(seq), 0) INTO last FROM event WHERE job = of_job.id;
  IF of_job.state = 'queued' THEN
    last := last + 1;
    INSERT INTO event (job, seq, time, type, data)
      VALUES (of_job.id, last, moment, 'running', '{}');
  END IF;
  INSERT INTO event (job, seq, time, type, data)
    VALUES (of_job.id, last + 1, moment, 'claimed',
      json_build_object('block', wanted, 'attempt', held.attempt, 'worker', claimant));
  UPDATE job
    SET attempt = greatest(attempt, held.attempt), started = coalesce(started, moment),
      state = CASE state WHEN 'queued' THEN 'running' ELSE state END,
      processor = coalesce(processor, by_processor)
    WHERE id = of_job.id RETURNING * INTO of_job;
  RETURN NEXT;
END $$
""",
    """
CREATE OR REPLACE FUNCTION claim_next(claimant text, moment float8, lease float8,
  by_version text, by_processor text, queues text[], busy text[])
RETURNS TABLE (held block, of_job job) LANGUAGE plpgsql
SET plan_cache_mode = force_generic_plan SET enable_bitmapscan = off SET enable_hashjoin = off
SET enable_mergejoin = off SET enable_seqscan = off SET enable_sort = off AS $$
#variable_conflict use_column
DECLARE
  of_queue text;
  of_owner text;
  wanted text;
BEGIN
  FOR of_queue, of_owner IN
    WITH RECURSIVE waiting(queue, owner) AS (
      SELECT asked.queue, (SELECT min(outbox.owner) FROM outbox WHERE outbox.queue = asked.queue)
      FROM unnest(queues) AS asked(queue)
      UNION ALL
      SELECT waiting.queue, (SELECT min(outbox.owner) FROM outbox
        WHERE outbox.queue = waiting.queue AND outbox.owner > waiting.owner)
      FROM waiting WHERE waiting.owner IS NOT NULL)
    SELECT waiting.queue, waiting.owner FROM waiting
      LEFT JOIN share ON share.queue = 'jobs' AND share.owner = waiting.owner
      WHERE waiting.owner IS NOT NULL AND NOT waiting.owner = ANY(busy)
      ORDER BY waiting.queue <> 'recovered', coalesce(share.next, 0)
        + CASE waiting.queue WHEN 'interactive' THEN 0 ELSE HEAD_START END, waiting.owner
  LOOP
    FOR wanted IN
      SELECT outbox.block FROM outbox
        JOIN block ON block.id = outbox.block JOIN job ON job.id = block.job
        WHERE queue = of_queue AND outbox.owner = of_owner AND (due <= moment OR tries > 0)
          AND solver_version = by_version AND (processor IS NULL OR processor = by_processor)
        ORDER BY outbox.block LIMIT 100
    LOOP
      CONTINUE WHEN NOT pg_try_advisory_xact_lock(hashtextextended(wanted, 0));
      RETURN QUERY
        SELECT * FROM claim_block(wanted, claimant, moment, lease, by_version, by_processor);
      IF FOUND THEN
        RETURN;
      END IF;
    END LOOP;
  END LOOP;
END $$
""",
)
_NAMED: Final = {"MOST_BEHIND": fair_queueing.MOST_BEHIND, "HEAD_START": fair_queueing.HEAD_START}
FUNCTIONS: Final = tuple(
    reduce(lambda written, one: written.replace(one[0], f"{one[1]:g}"), _NAMED.items(), function)
    for function in _WRITTEN
)
"""A migration that changes one of them, or a number that they name, calls `make` again."""


def make(connection: Connection) -> None:
    """Make the functions, or replace them by those of this version, where there can be any."""
    if connection.dialect.name == "postgresql":
        for function in FUNCTIONS:
            connection.exec_driver_sql(function)


def lacking(connection: Connection) -> list[str]:
    """Name the functions that there should be, and are not."""
    if connection.dialect.name != "postgresql":
        return []
    names = [function.split("FUNCTION ")[1].partition("(")[0] for function in FUNCTIONS]
    given = "SELECT name FROM unnest(%s::text[]) AS name WHERE to_regproc(name) IS NULL"
    return list(connection.exec_driver_sql(given, (names,)).scalars())
