"""A TCP line between a client and a server that is long: it delays, unevenly, and stands still from time to time. Standard library only."""

import asyncio
import random
import socket
import threading

_PIECE = 65536


class SlowLine:
    """Listens at `address` and passes on what comes to and from `server`, later by `delay` [s] each way.

    jitter: up to so much more [s], anew for each piece; what is passed on keeps its order, as TCP's does.
    stalls: (every, lasts) [s]: nothing passes for `lasts`, each `every`, as when a packet is lost and sent again.
    """

    def __init__(self, server, delay=0.0, jitter=0.0, stalls=None, seed=1):
        host, port = server.rsplit(":", 1)
        self._server = host, int(port)
        self._delay, self._jitter, self._stalls = delay, jitter, stalls
        self._random = random.Random(seed)
        self._loop = asyncio.new_event_loop()
        self._begun = self._loop.time()
        self._listening = self._loop.run_until_complete(asyncio.start_server(self._serve, "127.0.0.1", 0))
        self.address = "127.0.0.1:%d" % self._listening.sockets[0].getsockname()[1]
        self._thread = threading.Thread(target=self._loop.run_forever, daemon=True)
        self._thread.start()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.stop()

    def stop(self):
        async def end():
            self._listening.close()
            others = asyncio.all_tasks() - {asyncio.current_task()}
            for task in others:
                task.cancel()
            await asyncio.gather(*others, return_exceptions=True)
            self._loop.stop()
        asyncio.run_coroutine_threadsafe(end(), self._loop)
        self._thread.join(10)

    def _passes_at(self, now):
        """When a piece that comes now goes on; without regard to those before it."""
        at = now + self._delay + self._random.uniform(0.0, self._jitter)
        if self._stalls:
            every, lasts = self._stalls
            into = (at - self._begun) % every
            at += max(0.0, into - (every - lasts)) and every - into
        return at

    async def _serve(self, reader, writer):
        try:
            far_reader, far_writer = await asyncio.open_connection(*self._server)
        except OSError:
            return writer.close()
        for end in (writer, far_writer):
            end.get_extra_info("socket").setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        await asyncio.gather(self._carry(reader, far_writer), self._carry(far_reader, writer))

    async def _carry(self, reader, writer):
        waiting = asyncio.Queue()
        passing = asyncio.ensure_future(self._pass_on(waiting, writer))
        last = 0.0
        data = b"-"
        while data:
            try:
                data = await reader.read(_PIECE)
            except OSError:
                data = b""
            last = max(last, self._passes_at(self._loop.time()))
            waiting.put_nowait((last, data))
        await passing

    async def _pass_on(self, waiting, writer):
        while True:
            at, data = await waiting.get()
            await asyncio.sleep(max(0.0, at - self._loop.time()))
            if not data:
                return writer.close()
            writer.write(data)
            try:
                await writer.drain()
            except OSError:
                return None
