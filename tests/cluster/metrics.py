"""What a server counts of itself, read at its operator's door while it runs (docs/metrics.md)."""

import http.client
import re
import socket

LATENESS = "woodlouse_room_tick_lateness_seconds"
WORK = "woodlouse_room_tick_work_seconds"


class Door(http.client.HTTPConnection):
    """To a Unix socket: of the file system, so that a server in a network of its own is reached too."""

    def __init__(self, path):
        super().__init__("localhost", timeout=10)
        self.path = path

    def connect(self):
        self.sock = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        self.sock.settimeout(self.timeout)
        self.sock.connect(self.path)


class Metrics:
    """One reading. Of all rooms together."""

    def __init__(self, door):
        connection = Door(door)
        connection.request("GET", "/metrics")
        answer = connection.getresponse()
        self.text = answer.read().decode()
        connection.close()
        assert answer.status == 200, self.text

    def total(self, name):
        values = re.findall(rf"^{name}(?:\{{[^}}]*\}})? (\S+)$", self.text, re.M)
        assert values, f"{name} is not told:\n{self.text}"
        return sum(float(value) for value in values)

    def within(self, name):
        """{bound in seconds: how many were at most so long}."""
        counts = {}
        for bound, count in re.findall(rf'^{name}_bucket\{{[^}}]*le="([^"]+)"[^}}]*\}} (\S+)$', self.text, re.M):
            counts[float(bound)] = counts.get(float(bound), 0) + float(count)
        assert counts, f"{name} is not told:\n{self.text}"
        return counts


def since(former, now):
    """Of two readings of a histogram, what came between."""
    return {bound: now[bound] - former[bound] for bound in now}


def together(one, other):
    return {bound: one.get(bound, 0) + other[bound] for bound in other}


def share_above(counts, bound):
    """Of those that were longer; 0 where there are none."""
    everything = counts[float("inf")]
    assert bound in counts, f"there is no bound {bound}: {sorted(counts)}"
    return (everything - counts[bound]) / everything if everything else 0.0


def quantile(counts, share):
    """The smallest bound that so many keep to, in seconds, as fine as the bounds are."""
    everything = counts[float("inf")]
    assert everything > 0
    return min(bound for bound, count in counts.items() if count >= share * everything)
