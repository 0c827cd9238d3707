"""Operations that PostgreSQL carries out by itself, each in one exchange with it; see `calls`.

They do what the statements of `claims`, `holding` and `ending` do one by one, as which SQLite, that
is asked without a network between, carries them out; the specifications of the catalogue are those
of both. The job is locked first: every later statement of a function sees what others committed
before that.
"""

from functools import reduce
from typing import Final

from sqlalchemy import Connection

from jointplay.storage.catalogue import turns

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
    """
CREATE OR REPLACE FUNCTION record_progress(wanted text, number integer, until float8,
  reached float8, fraction float8, done bigint)
RETURNS text LANGUAGE plpgsql AS $$
#variable_conflict use_column
DECLARE
  of_job text;
  answer text;
BEGIN
  SELECT id, state INTO of_job, answer FROM job
    WHERE id = (SELECT block.job FROM block WHERE block.id = wanted) FOR NO KEY UPDATE;
  UPDATE block
    SET lease_until = until, progress_time = reached, progress_fraction = fraction,
      losses = CASE WHEN progress_fraction < fraction THEN 0 ELSE losses END,
      progress_steps = coalesce(done, progress_steps)
    WHERE id = wanted AND attempt = number AND state = 'running';
  IF NOT FOUND THEN
    RETURN NULL;
  END IF;
  UPDATE job
    SET progress_fraction = of_all.fraction, progress_time = of_all.reached, steps = of_all.steps,
      activity = NULL
    FROM (
      SELECT sum(count * progress_fraction) / sum(count) AS fraction,
        max(progress_time) AS reached, sum(progress_steps) AS steps
      FROM block WHERE job = of_job) AS of_all
    WHERE id = of_job;
  RETURN answer;
END $$
""",
    """
CREATE OR REPLACE FUNCTION finish_block(wanted text, holder integer, moment float8, ending text,
  failure json, reached float8, fraction float8, done bigint)
RETURNS text LANGUAGE plpgsql AS $$
#variable_conflict use_column
DECLARE
  of_job job;
  by_worker text;
  since float8;
  states text[];
  last text;
BEGIN
  SELECT * INTO of_job FROM job
    WHERE id = (SELECT block.job FROM block WHERE block.id = wanted) FOR NO KEY UPDATE;
  UPDATE block
    SET state = ending, lease_until = NULL, progress_time = coalesce(reached, progress_time),
      progress_fraction = coalesce(fraction, progress_fraction),
      progress_steps = coalesce(done, progress_steps)
    WHERE id = wanted AND attempt = holder AND state = 'running';
  IF NOT FOUND THEN
    RETURN NULL;
  END IF;
  IF ending = 'cancelled' AND of_job.state = 'running' THEN
    RETURN 'was not asked to be cancelled';
  END IF;
  UPDATE attempt SET ended = moment, outcome = ending
    WHERE block = wanted AND number = holder RETURNING worker, started INTO by_worker, since;
  INSERT INTO tally (name, worker, value) VALUES ('attempts ' || ending, by_worker, 1)
    ON CONFLICT (name, worker) DO UPDATE SET value = tally.value + 1;
  IF of_job.owner <> '' THEN
    INSERT INTO usage (owner, hour, worker, seconds) VALUES
      (of_job.owner, floor(moment / 3600), by_worker, greatest(moment - since, 0))
      ON CONFLICT (owner, hour, worker) DO UPDATE SET seconds = usage.seconds + excluded.seconds;
  END IF;
  IF ending = 'failed' THEN
    DELETE FROM outbox WHERE block IN
      (SELECT id FROM block WHERE job = of_job.id AND state IN ('queued', 'waiting'));
    UPDATE block SET state = 'cancelled'
      WHERE job = of_job.id AND state IN ('queued', 'waiting');
  END IF;
  SELECT array_agg(DISTINCT state) INTO states FROM block WHERE job = of_job.id;
  IF ending = 'failed' THEN
    last := 'failed';
  ELSIF states = '{done,waiting}' THEN
    WITH freed AS (
      UPDATE block SET state = 'queued' WHERE job = of_job.id AND state = 'waiting' RETURNING id)
    INSERT INTO outbox (block, queue, owner, created, due, tries)
      SELECT id, 'recovered', of_job.owner, moment, moment, 0 FROM freed;
  ELSIF NOT states && '{queued,running}' THEN
    last := CASE WHEN states = '{done}' THEN 'succeeded' ELSE 'cancelled' END;
  END IF;
  IF of_job.state = 'cancelling' OR of_job.state = 'running' AND last <> 'cancelled' THEN
    of_job.state := coalesce(last, of_job.state);
  ELSE
    last := NULL;
  END IF;
  UPDATE job
    SET progress_fraction = of_all.fraction, progress_time = of_all.reached, steps = of_all.steps,
      activity = NULL, state = of_job.state,
      error = CASE WHEN last IS NULL THEN error ELSE failure END,
      finished = CASE WHEN last IS NULL THEN finished ELSE moment END
    FROM (
      SELECT sum(count * progress_fraction) / sum(count) AS fraction,
        max(progress_time) AS reached, sum(progress_steps) AS steps
      FROM block WHERE job = of_job.id) AS of_all
    WHERE id = of_job.id;
  IF last IS NOT NULL THEN
    INSERT INTO event (job, seq, time, type, data)
      SELECT of_job.id, coalesce(max(seq), 0) + 1, moment, last,
        CASE WHEN failure IS NULL THEN '{}' ELSE json_build_object('error', failure) END
      FROM event WHERE job = of_job.id;
  END IF;
  RETURN of_job.state;
END $$
""",
)
_NAMED: Final = {"MOST_BEHIND": turns.MOST_BEHIND, "HEAD_START": turns.HEAD_START}
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
