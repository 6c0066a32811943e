"""A server whose metrics are read, and what is read."""

import http.client
import json
import os
import pathlib
import re
import socket
import tempfile
import time

from wire import PATIENCE, Server

DOCUMENT = pathlib.Path(__file__).parents[3] / "docs" / "metrics.md"


def documented():
    """{name: (type, {labels})} of the table in docs/metrics.md."""
    rows = re.findall(r"^\| `(woodlouse_\w+|process_\w+)` \| (\w+) \| ([\w, ]*) \|", DOCUMENT.read_text(), re.M)
    assert len(rows) > 30, rows
    return {name: (kind, frozenset(labels.split(", ")) - {""}) for name, kind, labels in rows}


class Scrape:
    """series: {(name, label value...): value}; types: {family: type}; labels: {family: {label}} without `le`."""

    def __init__(self, text):
        self.text = text
        self.series, self.types, self.labels = {}, {}, {}
        for line in text.splitlines():
            if found := re.match(r"# TYPE (\w+) (\w+)$", line):
                self.types[found[1]] = found[2]
                continue
            if line.startswith("#"):
                continue
            found = re.fullmatch(r'(\w+)(?:\{(.*)\})? (\S+)', line)
            assert found, line
            pairs = re.findall(r'(\w+)="((?:[^"\\]|\\.)*)"', found[2] or "")
            key = (found[1], *(value for _, value in pairs))
            assert key not in self.series, line
            self.series[key] = float(found[3])
            self.labels.setdefault(self.family(found[1]), frozenset(name for name, _ in pairs if name != "le"))

    def family(self, name):
        return name if name in self.types else re.sub(r"_(bucket|sum|count)$", "", name)

    def __getitem__(self, key):
        return self.series.get(key if isinstance(key, tuple) else (key,), -1.0)

    def by_label(self, name):
        return {key[1]: value for key, value in self.series.items() if key[0] == name}


class UnixConnection(http.client.HTTPConnection):
    def __init__(self, path):
        super().__init__("localhost", timeout=PATIENCE)
        self.path = path

    def connect(self):
        self.sock = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        self.sock.settimeout(PATIENCE)
        self.sock.connect(self.path)


class Watched(Server):
    """A server with an operator's door."""

    def __init__(self, *arguments, **options):
        self.folder = tempfile.TemporaryDirectory()
        self.door = os.path.join(self.folder.name, "admin.sock")
        super().__init__("--admin", self.door, *arguments, **options)
        line = self.process.stdout.readline()
        if line.startswith("web "):
            host, port = line.split()[1].removeprefix("http://").rstrip("/").rsplit(":", 1)
            self.web_address = (host, int(port))
            line = self.process.stdout.readline()
        assert line.startswith("admin "), line + self.log()

    def __exit__(self, *what):
        super().__exit__(*what)
        self.folder.cleanup()

    def command(self, command):
        """What the operator's door answers to that line."""
        with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as wire:
            wire.settimeout(PATIENCE)
            wire.connect(self.door)
            wire.sendall(json.dumps(command).encode() + b"\n")
            answer = json.loads(wire.makefile().readline())
        assert answer["type"] == "done", answer
        return answer

    def ask(self, path, connection=None):
        """(status, type, body)"""
        connection = connection or UnixConnection(self.door)
        connection.request("GET", path)
        answer = connection.getresponse()
        body = answer.read().decode()
        connection.close()
        return answer.status, answer.headers["Content-Type"], body

    def ask_web(self, path):
        return self.ask(path, http.client.HTTPConnection(*self.web_address, timeout=PATIENCE))

    def scrape(self):
        return Scrape(self.ask("/metrics")[2])

    def wait_for(self, is_so):
        """The first scrape of which that is so."""
        end = time.monotonic() + PATIENCE
        while not is_so(scrape := self.scrape()):
            if time.monotonic() > end:
                raise AssertionError("it never was so:\n" + scrape.text + self.log())
            time.sleep(0.1)
        return scrape
