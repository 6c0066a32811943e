"""NATS servers and hosts of a cluster on loopback addresses, and bots that come back to their lice."""

import asyncio
import json
import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time

PROGRAM = os.environ["WOODLOUSE_SERVER"]
MAPS = os.environ["WOODLOUSE_MAPS"]
PATIENCE = 30.0


def missing():
    """Why there is no cluster to test here; empty: there can be one."""
    if shutil.which("nats-server") is None:
        return "nats-server is missing:  apt-get install nats-server"
    said = subprocess.run([PROGRAM, "cluster", "status", "/nonexistent"], capture_output=True, text=True)
    built = subprocess.run([PROGRAM, "cluster", "status", os.devnull], capture_output=True, text=True)
    if "built without NATS" in said.stderr + built.stderr:
        return "woodlouse-server was built without NATS:  apt-get install libnats-dev, and -DWOODLOUSE_CLUSTER=ON"
    return ""


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


class Nats:
    """As many nats-servers with JetStream as `replicas` says, and the file of a cluster that lives on them. address: where they
    listen; jetstream: more lines of that part of their configuration, as "max_file_store: 1MB"."""

    def __init__(self, replicas=1, address="127.0.0.1", jetstream="", **settings):
        self.folder = tempfile.mkdtemp(prefix="woodlouse-nats-")
        self.replicas = replicas
        ports = free_ports(2 * replicas)
        self.ports, routes = ports[:replicas], ports[replicas:]
        self.commands = []
        for number in range(replicas):
            self.configure(number, jetstream)
        for number, (port, route) in enumerate(zip(self.ports, routes)):
            command = ["nats-server", "-c", self.configuration(number), "-a", address, "-p", str(port), "-n", f"n{number}",
                       "-l", os.path.join(self.folder, f"nats{number}.log")]
            if replicas > 1:
                command += ["--cluster_name", "test", "--cluster", f"nats://127.0.0.1:{route}",
                            "--routes", ",".join(f"nats://127.0.0.1:{other}" for other in routes)]
            self.commands.append(command)
        self.processes = [None] * replicas
        for number in range(replicas):
            self.start(number)
        self.settings = {"replicas": replicas, **settings}
        self.file = self.file_for("127.0.0.1")
        end = time.monotonic() + PATIENCE
        while self.command("init")[0] != 0:
            assert time.monotonic() < end, self.command("init")
            time.sleep(0.2)

    def configuration(self, number):
        return os.path.join(self.folder, f"nats{number}.conf")

    def store(self, number):
        return os.path.join(self.folder, f"store{number}")

    def configure(self, number, jetstream):
        """Takes effect when that node is started again."""
        with open(self.configuration(number), "w") as out:
            out.write(f'jetstream {{\n  store_dir: "{self.store(number)}"\n  {jetstream}\n}}\n')

    def file_for(self, address):
        """A cluster's file for one who reaches NATS at that address."""
        file = os.path.join(self.folder, f"cluster-{address}.json")
        with open(file, "w") as out:
            json.dump({"nats": [f"nats://{address}:{port}" for port in self.ports], **self.settings}, out)
        return file

    def start(self, number):
        self.processes[number] = subprocess.Popen(self.commands[number], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def wait_there(self, number):
        """Until it takes connections; a host that finds none at its start ends."""
        end = time.monotonic() + PATIENCE
        while True:
            try:
                return socket.create_connection(("127.0.0.1", self.ports[number]), 1).close()
            except OSError:
                assert time.monotonic() < end, "NATS does not come back"
                time.sleep(0.05)

    def kill(self, number, by=signal.SIGKILL):
        self.processes[number].send_signal(by)
        if by != signal.SIGSTOP:
            self.processes[number].wait(PATIENCE)

    def command(self, *arguments):
        """`woodlouse-server cluster ...` of this cluster: (exit code, what it printed)."""
        action, *rest = arguments
        done = subprocess.run([PROGRAM, "cluster", action, self.file, *rest], capture_output=True, text=True, timeout=120)
        return done.returncode, done.stdout + done.stderr

    def leader(self):
        """The number of the node that leads the log; None: there is none now."""
        found = re.search(r"led by n(\d+)", self.command("status")[1])
        return int(found.group(1)) if found else None

    def tick(self):
        """That the log's last batch leads to; 0: there is none."""
        found = re.search(r"^room \S+: tick (\d+)", self.command("status")[1], re.M)
        return int(found.group(1)) if found else 0

    def stored(self):
        """Bytes that the log has on NATS' disk."""
        return int(re.search(r"batches \d+ to \d+, (\d+) bytes", self.command("status")[1]).group(1))

    def joined(self):
        """Each room's joined recordings, proven: {file's name: what verify says}."""
        folder = tempfile.mkdtemp(dir=self.folder)
        code, said = self.command("fsck", "--out", folder)
        proofs = {}
        for name in sorted(os.listdir(folder)):
            verify = subprocess.run([PROGRAM, "verify", os.path.join(folder, name)], capture_output=True, text=True, timeout=300)
            proofs[name] = (verify.returncode, verify.stdout + verify.stderr)
        return code, said, proofs

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for process in self.processes:
            if process is not None and process.poll() is None:
                process.kill()
                process.wait()
        shutil.rmtree(self.folder, ignore_errors=True)


class Host:
    """A woodlouse-server of the cluster. prefix: the command that starts it somewhere else; file: the cluster's, as it is there."""

    def __init__(self, nats, name, *arguments, maps=("volcano",), folder=MAPS, prefix=(), listen="127.0.0.1", file=None):
        self.name = name
        self.door = os.path.join(nats.folder, f"{name}-{time.monotonic_ns()}.sock")
        self.log_file = os.path.join(nats.folder, f"{name}-{time.monotonic_ns()}.log")
        games = [os.path.join(folder, each + ".json") for each in maps]
        self.process = subprocess.Popen(
            [*prefix, PROGRAM, "--map", *games, "--mode", "roam", "--cluster", file or nats.file, "--cluster-host", name,
             "--listen", f"{listen}:0", "--admin", self.door, "--log-file", self.log_file, *arguments],
            stdout=subprocess.PIPE, text=True)
        first = self.process.stdout.readline()
        assert first.startswith("listening "), first + self.log()
        self.address = first.split()[1]

    def log(self):
        try:
            with open(self.log_file) as file:
                return file.read()
        except FileNotFoundError:
            return ""

    def wait_for(self, text, count=1, patience=PATIENCE):
        end = time.monotonic() + patience
        while self.log().count(text) < count:
            assert time.monotonic() < end, f"{self.name} never said {text!r}:\n{self.log()}"
            assert self.process.poll() is None, f"{self.name} has ended:\n{self.log()}"
            time.sleep(0.02)

    def went_on_at(self):
        """The tick from which it goes on with the log, the last time."""
        return int(re.findall(r"goes on from the log of \S+ tick (\d+)", self.log())[-1])

    def signal(self, by):
        self.process.send_signal(by)

    def end(self):
        if self.process.poll() is None:
            self.process.terminate()
        code = self.process.wait(PATIENCE)
        self.process.stdout.close()
        return code

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.send_signal(signal.SIGCONT)
        self.end()


class EdgeHost(Host):
    """A woodlouse-server that plays nothing."""

    def __init__(self, nats, name, *arguments):
        self.name = name
        self.log_file = os.path.join(nats.folder, f"{name}-{time.monotonic_ns()}.log")
        self.process = subprocess.Popen(
            [PROGRAM, "--cluster", nats.file, "--cluster-edge", "--listen", "127.0.0.1:0", "--log-file", self.log_file, *arguments],
            stdout=subprocess.PIPE, text=True)
        first = self.process.stdout.readline()
        assert first.startswith("listening "), first + self.log()
        self.address = first.split()[1]


class Bot:
    """Steers a louse, and comes back to it wherever its room is. addresses: of all hosts."""

    def __init__(self, name, addresses, push=True, state_hz=2, room=""):
        self.name, self.addresses, self.push, self.state_hz, self.room = name, list(addresses), push, state_hz, room
        self.token, self.louse, self.seq = "", None, 0
        self.welcomes = []   # (time, message)
        self.losses = []     # times at which the line was cut
        self.byes = []         # of rooms that he was in
        self.turned_away = []  # byes of hosts that he came to while they left
        self.notices = []    # their codes
        self.newest = None   # (time, tick) of the newest frame
        self.frames = []     # (time, address) of each frame
        self.ticks = []      # (time, tick) likewise
        self.stopped = False

    async def run(self):
        place = 0
        while not self.stopped:
            address = self.addresses[place % len(self.addresses)]
            place += 1
            try:
                await self.visit(address)
            except (OSError, asyncio.IncompleteReadError, ConnectionError):
                pass
            await asyncio.sleep(0.02)

    async def visit(self, address):
        host, port = address.rsplit(":", 1)
        reader, writer = await asyncio.open_connection(host, int(port), limit=1 << 24)
        pushing = None
        try:
            def say(**message):
                writer.write(json.dumps(message).encode() + b"\n")

            joined = False
            while not self.stopped:
                line = await reader.readline()
                if not line:
                    break
                kind = line[9:line.index(b'"', 9)]
                if kind == b"hello":
                    say(type="join", protocol=1, role="bot", name=self.name, room=self.room, resume=self.token or True, state_hz=self.state_hz,
                        fields=["id", "x", "y"])
                elif kind in (b"key", b"delta"):
                    self.frames.append((time.monotonic(), address))
                    self.newest = (time.monotonic(), int(re.search(rb'"tick":(\d+)', line).group(1)))
                    self.ticks.append(self.newest)
                elif kind == b"welcome":
                    joined = True
                    message = json.loads(line)
                    self.token = message["resume_token"]
                    self.welcomes.append((time.monotonic(), message))
                    self.seq = 0
                    if self.push:
                        pushing = asyncio.ensure_future(self.steer(say))
                elif kind == b"ping":
                    say(type="pong", t=json.loads(line)["t"])
                elif kind == b"bye":
                    (self.byes if joined else self.turned_away).append(json.loads(line))
                elif kind == b"notice":
                    self.notices.append(json.loads(line)["code"])
                elif kind == b"error" and not joined:
                    return
            if joined:
                self.losses.append(time.monotonic())
        finally:
            if pushing:
                pushing.cancel()
            writer.close()

    async def steer(self, say):
        turn = sum(self.name.encode()) % 7 - 3
        while True:
            self.seq += 1
            say(type="input", seq=self.seq, thrust=[0.8, turn / 6])
            await asyncio.sleep(0.1)


class Clients:
    """Bots that run beside a test, on a thread of their own."""

    def __init__(self, count, addresses, room=""):
        self.bots = [Bot(f"bot {k}", addresses, room=room) for k in range(count)]
        self.loop = asyncio.new_event_loop()
        self.thread = threading.Thread(target=self.work)
        self.thread.start()

    def work(self):
        asyncio.set_event_loop(self.loop)
        self.loop.run_until_complete(asyncio.gather(*(bot.run() for bot in self.bots), return_exceptions=True))

    def wait_for(self, condition, what, patience=PATIENCE):
        end = time.monotonic() + patience
        while not all(condition(bot) for bot in self.bots):
            assert time.monotonic() < end, what
            time.sleep(0.02)

    def wait_here(self):
        self.wait_for(lambda bot: bot.welcomes and bot.newest and bot.newest[0] > bot.welcomes[-1][0], "no frames came")
        time.sleep(0.5)  # what was played last is not in the log yet

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for bot in self.bots:
            bot.stopped = True
        self.thread.join(PATIENCE)


def play(coroutine):
    return asyncio.run(coroutine)


def skip_where_missing():
    why = missing()
    if why:
        print("SKIPPED:", why)
        sys.exit(77)
