"""Which solver computes a job: that of the program that admitted it, on processors of one class.

Other sources and other processors give other bits, which must not be mixed in one store. A job that
no worker's solver is any more is begun anew by another one, if it may be; a study that has begun
waits, and its status says so.
"""

from collections.abc import Collection, Sequence
from dataclasses import fields
from typing import Any, Final

from sqlalchemy import and_, bindparam, delete, func, insert, or_, select, update

from jointplay.storage.catalogue import fair_queueing, tables, tally
from jointplay.storage.catalogue.connections import Unit
from jointplay.storage.catalogue.errors import TooManyWorkers
from jointplay.storage.catalogue.records import (
    LIVE,
    QUEUES,
    BlockState,
    Job,
    Solver,
    WorkerDevice,
)

PATIENCE: Final = 60.0
"""Seconds after which a worker that is silent, or a job that none has taken, is on its own."""
UNSERVED: Final = tables.NO_SOLVER
MOST_OF_KEY: Final = 1000
"""Workers that may join with one key in a minute: whoever has it makes up their names."""
_CANDIDATES: Final = 8
"""Abandoned blocks that a worker tries to take over: others may be quicker."""
_FORGOTTEN: Final = 3600.0  # s
_OF_DEVICES: Final = tuple(field.name for field in fields(WorkerDevice))
_PART_OF_WAIT: Final = 0.25
_LONGEST_PAUSE: Final = 300.0  # s
_job, _block, _worker = tables.job, tables.block, tables.worker
_waits = and_(_block.c.state == BlockState.queued, _job.c.state.in_(LIVE))
"""Whether there is something to claim; otherwise its wake-up is one that `doctor` removes."""


def fits(job: Job, solver: Solver) -> bool:
    """Whether a job is to be computed by this solver."""
    return job.solver_version == solver.version and job.processor in (None, solver.processor)


_FITS: Final = and_(
    _job.c.solver_version == bindparam("of_version"),
    or_(_job.c.processor.is_(None), _job.c.processor == bindparam("of_processor")),
)
_outbox = tables.outbox
_ANY: Final = select(_outbox.c.block).limit(1)
_QUEUED: Final = (  # of one queue, by index
    select(_outbox.c.block)
    .join(_block, _block.c.id == _outbox.c.block)
    .join(_job, _job.c.id == _block.c.job)
    .where(
        _outbox.c.queue == bindparam("of_queue"),
        # sent: only others are woken by it
        or_(_outbox.c.due <= bindparam("moment"), _outbox.c.tries > 0),
        _waits,
    )
    .order_by(_outbox.c.owner, _outbox.c.block)
)
_NEXT: Final = _QUEUED.where(_outbox.c.owner == bindparam("of_owner"), _FITS).limit(1)
_SERVED: Final = (  # by a worker that was heard of lately
    select(_worker.c.name)
    .where(
        _worker.c.version == _job.c.solver_version,
        or_(_job.c.processor.is_(None), _worker.c.processor == _job.c.processor),
        _worker.c.seen > bindparam("lately"),
    )
    .correlate(_job)
    .exists()
)
_other = _block.alias()  # by index: a count of a study's blocks, for each, takes their square
_SECOND: Final = select(_other.c.id).where(_other.c.job == _job.c.id, _other.c.index == 1)
_ABANDONED: Final = and_(  # may be begun anew by any solver: none of its blocks builds on another
    or_(_job.c.attempt == 0, ~_SECOND.correlate(_job).exists()),
    _job.c.created <= bindparam("lately"),
    ~_SERVED,
)
_TO_TAKE_OVER: Final = _QUEUED.where(
    ~_FITS, _ABANDONED, _outbox.c.owner.not_in(bindparam("busy", expanding=True))
).limit(_CANDIDATES)


def _asked_by(unit: Unit, solver: Solver) -> dict[str, Any]:
    own = {"of_version": solver.version, "of_processor": solver.processor}
    return {**own, "moment": unit.now, "lately": unit.now - PATIENCE}


def waiting_for(unit: Unit, solver: Solver, busy: Collection[str]) -> tuple[str, ...]:
    """Return the queued block whose turn it is of a solver's, if there is one, of idle owners."""
    own = _asked_by(unit, solver)
    for queue, owner in fair_queueing.in_order(unit):
        asked = {**own, "of_queue": queue, "of_owner": owner}
        found = None if owner in busy else unit.execute(_NEXT, asked).scalar_one_or_none()
        if found is not None:
            return (found,)
    return ()


def abandoned(unit: Unit, solver: Solver, busy: Collection[str]) -> tuple[str, ...]:
    """Return queued blocks that a solver may take over from others, of idle owners."""
    if unit.execute(_ANY).first() is None:  # so it is for most who ask again and again
        return ()
    asked = {**_asked_by(unit, solver), "busy": [*busy]}
    found: list[str] = []
    for queue in QUEUES:
        found += unit.execute(_TO_TAKE_OVER, {**asked, "of_queue": queue}).scalars()
    return tuple(found[:_CANDIDATES])


def take_over(unit: Unit, block_id: str, solver: Solver) -> bool:
    """Make a block's job this solver's, if it was abandoned; what it had computed is left."""
    queued = and_(_block.c.id == block_id, _block.c.state == BlockState.queued)
    of_block = _job.c.id == select(_block.c.job).where(queued).scalar_subquery()
    taken = unit.execute(
        update(_job)
        .where(of_block, _job.c.state.in_(LIVE), ~_FITS, _ABANDONED)
        .values(solver_version=solver.version, processor=solver.processor)
        .returning(_job.c.id),
        _asked_by(unit, solver),
    ).scalar_one_or_none()
    if taken is not None:
        anew = update(_block).where(_block.c.job == taken)
        unit.execute(anew.values(checkpoint=None, watermark=0))
    return taken is not None


def wake_again(unit: Unit, block_id: str, solver: Solver) -> None:
    """Have a worker woken again for a block that this one, which was woken for it, has not taken.

    At once; if it is another solver's after a part of the time that the block has waited. A unit of
    its own: where the worker has claimed a block, another one may hold that and want this one.
    """
    outbox = tables.outbox
    of_block = outbox.c.block == block_id
    offered = or_(outbox.c.tries > 0, outbox.c.due <= unit.now)  # otherwise it was put off since
    may = select(_job.c.id).join(_block).where(_block.c.id == block_id, _waits, _FITS)
    found = unit.execute(
        select(outbox.c.created, may.exists()).where(of_block, offered), _asked_by(unit, solver)
    ).one_or_none()
    if found is not None:
        created, may_take = found
        longer = min(max(_PART_OF_WAIT * (unit.now - created), 1.0), _LONGEST_PAUSE)
        due = unit.now + (0.0 if may_take else longer)
        unit.execute(update(outbox).where(of_block, offered).values(due=due, tries=0))


def machine_of(worker: str) -> str:
    """Return what tells the machine of a worker from others: its boot, or else its name.

    A worker that joined with a key may say what it likes: its machine is one of that key.
    """
    key, at, name = worker.rpartition("@")
    host, _, _, boot, *_ = [*name.split(":"), "", "", ""]
    return f"{key}{at}{boot or host}"


_HOLDER: Final = select(_block.c.worker).where(_block.c.id == bindparam("of_block"))
_HEARD_OF: Final = (
    update(_worker)
    .where(_worker.c.name == _HOLDER.scalar_subquery())
    .values(seen=bindparam("moment"))
)


def note_worker(
    unit: Unit,
    name: str,
    solver: Solver,
    device: WorkerDevice | None = None,
    *,
    of_key: str | None = None,
) -> None:
    """Remember that a worker was heard of just now, and its device if it has one.

    `of_key` : begins the names of all workers of its key, of which there may be `MOST_OF_KEY`;
    `TooManyWorkers` if there are. None: it is the service's own.
    """
    facts = {"version": solver.version, "processor": solver.processor, "seen": unit.now}
    facts |= dict.fromkeys(_OF_DEVICES) if device is None else vars(device)
    known = update(_worker).where(_worker.c.name == name).values(facts)
    if unit.execute(known).rowcount:
        return
    if of_key is not None:
        lately = _worker.c.seen > unit.now - PATIENCE
        of_one = _worker.c.name.startswith(of_key, autoescape=True)
        found = select(func.count()).select_from(_worker).where(lately, of_one)
        if unit.execute(found).scalar_one() >= MOST_OF_KEY:
            raise TooManyWorkers(MOST_OF_KEY)
    unit.execute(insert(_worker).values(name=name, since=unit.now, **facts))


def note_holder(unit: Unit, block_id: str) -> None:
    """Remember that the worker that holds a block was heard of just now."""
    unit.execute(_HEARD_OF, {"of_block": block_id, "moment": unit.now})


def forget_workers(unit: Unit, ended: Sequence[str]) -> None:
    """Forget workers that have ended, and those that have been silent for long."""
    silent = _worker.c.seen < unit.now - _FORGOTTEN
    unit.execute(delete(_worker).where(or_(_worker.c.name.in_(ended), silent)))
    tally.gather(unit)


def workers(unit: Unit) -> dict[str, Solver]:
    """Return the workers that were heard of lately, by name."""
    lately = select(_worker).where(_worker.c.seen > unit.now - PATIENCE)
    return {row.name: Solver(row.version, row.processor) for row in unit.execute(lately)}


def last_heard_of(unit: Unit) -> dict[str, float]:
    """Return when each known machine was heard of last [epoch s]."""
    heard: dict[str, float] = {}
    for row in unit.execute(select(_worker.c.name, _worker.c.seen)):
        machine = machine_of(row.name)
        heard[machine] = max(heard.get(machine, row.seen), row.seen)
    return heard


def unserved(unit: Unit) -> dict[str, Solver]:
    """Return live jobs that have waited for long for a solver that no worker has."""
    queued = (_block.c.job == _job.c.id) & (_block.c.state == BlockState.queued)
    waits = select(_block.c.id).where(queued).correlate(_job).exists()
    live = _job.c.state.in_(LIVE)
    rows = unit.execute(
        select(_job.c.id, _job.c.solver_version, _job.c.processor)
        .where(live, _job.c.created <= bindparam("lately"), waits, ~_SERVED)
        .order_by(_job.c.id),
        {"lately": unit.now - PATIENCE},
    )
    return {row.id: Solver(row.solver_version, row.processor or "") for row in rows}


def count_unserved(unit: Unit) -> int:
    """Count those of them whose status says so, which is quick, and is done by the relay."""
    found = select(_job.c.state).where(tables.UNSERVED, ~_SERVED)  # by an index of its own
    states = unit.execute(found, {"lately": unit.now - PATIENCE}).scalars()
    return sum(state in LIVE for state in states)


def note_unserved(unit: Unit) -> None:
    """Have the status of such jobs say so, and of no others: their workers may be back."""
    said = select(_job.c.id).where(tables.UNSERVED, _job.c.state.in_(LIVE), _SERVED)
    served = unit.execute(said, {"lately": unit.now - PATIENCE}).scalars().all()
    for found, activity in ((served, None), (list(unserved(unit)), UNSERVED)):
        if found:
            unit.execute(update(_job).where(_job.c.id.in_(found)).values(activity=activity))
