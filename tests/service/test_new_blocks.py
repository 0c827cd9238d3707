import asyncio

from jointplay.service.workers.new_blocks import NewBlocks

LONG = 3600.0  # s; a test that waits for it fails


def test_a_new_block_wakes_who_has_waited_longest_and_nobody_else() -> None:
    async def announced() -> list[bool]:
        new_blocks = NewBlocks()
        waiting = [asyncio.create_task(new_blocks.wait(LONG)) for _ in range(3)]
        await asyncio.sleep(0)
        waiting[0].cancel()  # its worker has gone
        await asyncio.sleep(0)
        await asyncio.to_thread(new_blocks.announce, 1)
        first = await waiting[1]
        others = [task.done() for task in waiting[2:]]
        new_blocks.announce(5)
        return [first, *others, await waiting[2], await new_blocks.wait(0.0)]

    assert asyncio.run(announced()) == [True, False, True, False]
