"""The programs that bench/crowd_table.py runs, each on a core of its own, and what they say."""
import os
import pathlib
import re
import signal
import subprocess
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
SERVER_CORE, LOAD_CORE = "0", "1"


def number(pattern, text, otherwise=None):
    """The first number that the pattern's group finds in the text."""
    found = re.search(pattern, text, re.MULTILINE)
    if not found and otherwise is None:
        raise RuntimeError(f"nothing like {pattern} in:\n{text}")
    return float(found.group(1)) if found else otherwise


class Server:
    """A server of a tree's programs; `with` starts and ends it. Its log goes to a file in the scratch folder."""

    def __init__(self, programs, scratch, *options, host="127.0.0.1", maps=1):
        self.log = scratch / "server.log"
        self.said = scratch / "server.said"
        self.summary = ""
        self.command = ["taskset", "-c", SERVER_CORE, programs / "woodlouse-server", "--listen", f"{host}:0", *options]
        self.command += [part for _ in range(maps) for part in ("--map", ROOT / "maps" / "volcano.json")]

    def __enter__(self):
        with open(self.log, "wb") as log, open(self.said, "wb") as said:
            self.process = subprocess.Popen([str(part) for part in self.command], stdout=said, stderr=log)
        for _ in range(100):
            listening = re.search(r"^listening (\S+):(\d+)$", self.said.read_text(), re.MULTILINE)
            if listening:
                self.host, self.port = listening.group(1), int(listening.group(2))
                self.address = f"{self.host}:{self.port}"
                time.sleep(0.3)
                return self
            if self.process.poll() is not None:
                break
            time.sleep(0.1)
        self.process.kill()
        raise RuntimeError(f"the server did not listen: {self.log.read_text()[-500:]}")

    def __exit__(self, *_):
        self.process.send_signal(signal.SIGTERM)
        try:
            self.process.wait(30)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        self.summary = self.said.read_text()

    def cpu_seconds(self):
        fields = pathlib.Path(f"/proc/{self.process.pid}/stat").read_text().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def resident_kb(self):
        return number(r"^VmRSS:\s+(\d+)", pathlib.Path(f"/proc/{self.process.pid}/status").read_text())

    def lateness(self, which):
        """Of the room that was the latest, ms; which: p99 or max."""
        return max(float(ms) for ms in re.findall(rf"lateness .*?{which} ([\d.]+) ms", self.summary))


class Load:
    """The load tool, always of this tree."""

    def __init__(self, programs):
        self.programs = programs

    def start(self, program, *options):
        command = ["taskset", "-c", LOAD_CORE, self.programs / program, *options]
        return subprocess.Popen([str(part) for part in command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def swarm(self, address, options):
        """Its report; who is refused is told there and no failure."""
        process = self.start("woodlouse-swarm", address, *str(options).split())
        text, error = process.communicate()
        if process.returncode not in (0, 1):
            raise RuntimeError(f"woodlouse-swarm {options}: exit status {process.returncode}: {error}")
        return text

    def send_floor(self, clients, size, hz, seconds):
        """CPU of a bare send [us]: the loop stands where the server stood, the readers where the load did."""
        command = ["taskset", "-c", SERVER_CORE, self.programs / "woodlouse-send-floor", "--listen", "127.0.0.1:0",
                   "--clients", clients, "--bytes", size, "--hz", hz, "--seconds", seconds]
        loop = subprocess.Popen([str(part) for part in command], stdout=subprocess.PIPE, text=True)
        address = loop.stdout.readline().split()[1]
        readers = self.start("woodlouse-swarm", "--raw", "--bots", clients, "--seconds", seconds + 60, address)
        text, _ = loop.communicate()
        readers.communicate()
        return number(r"([\d.e+-]+) us a send", text)


def gap(report, which, phase="under load"):
    """A figure of the healthy clients' frame gaps [ms]; which: p50, p99 or max."""
    return number(rf"^healthy {phase}: gap .*?{which} ([\d.]+)", report)


def ack(report, which):
    return number(rf"^healthy under load: .*ack .*?{which} ([\d.]+)", report)


def refused(report):
    return sum(int(count) for count in re.findall(r"^others lost: (\d+) x", report, re.MULTILINE))
