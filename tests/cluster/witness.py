"""A player by himself, who tells how long he was shown nothing."""

import asyncio
import multiprocessing

import stage


class Witness:
    """A player in a process of his own, who is shown 20 frames a second: many bots in one process keep each other waiting."""

    def __init__(self, addresses):
        self.pipe, there = multiprocessing.Pipe()
        self.process = multiprocessing.Process(target=self.work, args=(there, list(addresses)), daemon=True)
        self.process.start()

    @staticmethod
    def work(pipe, addresses):
        bot = stage.Bot("witness", addresses, state_hz=20)

        async def listen():
            running = asyncio.ensure_future(bot.run())
            while True:
                while not pipe.poll():
                    await asyncio.sleep(0.02)
                asked = pipe.recv()
                if asked is None:
                    break
                if isinstance(asked, list):
                    bot.addresses = asked
                else:
                    times = [at for at, _ in bot.frames if at > asked - 1]
                    pipe.send(max((b - a for a, b in zip(times, times[1:])), default=None))
            running.cancel()

        asyncio.run(listen())

    def use(self, addresses):
        self.pipe.send(list(addresses))

    def longest_gap(self, since):
        """Between two frames, from a second before `since` on [s]."""
        self.pipe.send(since)
        return self.pipe.recv()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.pipe.send(None)
        self.process.join(stage.PATIENCE)
