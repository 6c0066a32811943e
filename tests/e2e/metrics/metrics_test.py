"""/metrics of a server that is played on: every documented name is there, and the figures are what its clients saw."""

import array
import json
import os
import pathlib
import re
import socket
import struct
import sys
import tempfile
import time
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "server"))
from scrape import DOCUMENT, Watched, documented
from wire import PATIENCE, map_file, run


def until_end(wire):
    """All that comes until the server closes."""
    data = b""
    try:
        while part := wire.recv(65536):
            data += part
    except ConnectionResetError:  # it had not read all
        pass
    return data


class Metrics(unittest.TestCase):
    def test_every_documented_metric_is_told_with_its_type_and_labels_and_no_other(self):
        with tempfile.TemporaryDirectory() as folder:
            grid = pathlib.Path(folder, "alps")  # stepped on from its file
            grid.with_suffix(".hdr").write_text("ncols 200\nnrows 200\nxllcenter 0\nyllcenter 0\ncellsize 1\nbyteorder LSBFIRST\n")
            grid.with_suffix(".flt").write_bytes(array.array("f", [0.0] * 40000).tobytes())
            grid.with_suffix(".json").write_text(json.dumps(
                {"name": "alps", "terrain": {"file": "alps.flt", "storage": "tiles"}}))
            with Watched("--web", "127.0.0.1:0", "--shadow", "--record", os.path.join(folder, "game.ndjson"), "--bots", "2",
                         maps=("volcano", str(grid))) as server:
                with server.player(), server.player("eva", room="alps"):
                    server.wait_for(lambda s: all(s["woodlouse_room_ticks_total", r] >= 60 for r in ("volcano", "alps")))
                    scrape = server.scrape()
            told = {name: (scrape.types[name], labels) for name, labels in scrape.labels.items()}
            self.assertEqual(told, {name: what for name, what in documented().items() if not name.startswith("woodlouse_cluster_")})

    def test_alarms_ask_for_metrics_that_there_are(self):
        rules = (DOCUMENT.parent / "alarms.yml").read_text()
        asked = set(re.findall(r"\b((?:woodlouse|process)_\w+)[\[{ )]", "\n".join(
            line for line in rules.splitlines() if "expr:" in line or "sum by" in line)))
        self.assertGreater(len(asked), 12)
        self.assertEqual({re.sub("_bucket$", "", name) for name in asked} - documented().keys(), set())

    def test_lines_and_bytes_are_what_clients_sent_and_got(self):
        with Watched() as server:
            got = 0
            for lines in (b'{"type":"nonsense"}\n' * 7, b'{"type":"chat","text":"x"}\n' * 3 + b"[]\n{\n", b""):
                with socket.create_connection((server.host, server.port), PATIENCE) as wire:
                    wire.sendall(lines + b'{"type":"leave"}\n')
                    got += len(until_end(wire))
            with socket.create_connection((server.host, server.port), PATIENCE) as wire:
                wire.sendall(b"x" * 70000)  # no line has so many
                got += len(until_end(wire))
            after = server.wait_for(lambda s: s["woodlouse_sessions"] == 0)
            self.assertEqual(after["woodlouse_sent_bytes_total"], got)
            self.assertEqual(after["woodlouse_received_lines_total"], 7 + 5 + 3 + 1)
            refused = after.by_label("woodlouse_refused_lines_total")
            self.assertEqual({code: count for code, count in refused.items() if count},
                             {"unknown_type": 7, "not_joined": 3, "not_an_object": 1, "bad_json": 1, "line_too_long": 1})
            ends = after.by_label("woodlouse_session_ends_total")
            self.assertEqual({code: count for code, count in ends.items() if count}, {"left": 3, "line_too_long": 1})
            self.assertEqual(after["woodlouse_connections_total"], 4)

    def test_what_the_room_refuses_is_counted_and_a_broken_connection_is_one_that_was_lost(self):
        with Watched("--bots", "1") as server:
            with server.player() as mara:
                for seq in (1, 1, 1):
                    mara.send({"type": "input", "seq": seq, "thrust": [0.1, 0]})
                mara.expect("error", code="stale_seq")
                mara.expect("error", code="stale_seq")
                inside = server.scrape()
                self.assertEqual(inside["woodlouse_sessions"], 1)
                self.assertEqual(inside["woodlouse_room_members", "volcano", "player"], 1)
                self.assertEqual(inside["woodlouse_room_members", "volcano", "bot"], 1)
                mara.socket.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
            after = server.wait_for(lambda s: s["woodlouse_session_ends_total", "lost"] == 1)
            self.assertEqual(after["woodlouse_refused_lines_total", "stale_seq"], 2)
            self.assertGreater(after["woodlouse_sent_frames_total"], 0)

    def test_a_room_that_closes_takes_its_series_along_and_one_that_is_paused_is_not_overdue(self):
        with Watched() as server:
            server.command({"type": "open", "file": map_file("hills"), "name": "second"})
            with server.player("eve", room="second"):
                server.wait_for(lambda s: s["woodlouse_room_ticks_total", "second"] >= 60)
                server.command({"type": "pause", "room": "second"})
                server.wait_for(lambda s: s["woodlouse_room_asleep", "second"] == 1)
                time.sleep(1)
                self.assertEqual(server.scrape()["woodlouse_room_tick_overdue_seconds", "second"], 0)
                self.assertEqual(server.ask("/readyz")[0], 200)
                server.command({"type": "resume", "room": "second"})
                server.wait_for(lambda s: s["woodlouse_room_asleep", "second"] == 0)
                server.command({"type": "close", "room": "second"})
                closed = server.wait_for(lambda s: ("woodlouse_room_asleep", "second") not in s.series)
            self.assertEqual({key for key in closed.series if "second" in key}, set())
            self.assertEqual(closed["woodlouse_room_asleep", "volcano"], 0)
            server.wait_for(lambda s: s["woodlouse_sessions"] == 0)

    def test_who_is_banned_is_counted_as_such(self):
        with Watched() as server:
            server.command({"type": "ban", "who": "127.0.0.9", "seconds": 60})
            with server.client(source="127.0.0.9") as banned:
                banned.until_end()
            refused = server.scrape().by_label("woodlouse_connections_refused_total")
            self.assertEqual({reason: count for reason, count in refused.items() if count}, {"banned": 1})

    def test_counters_only_grow_and_the_histograms_count_every_tick(self):
        with Watched("--bots", "2", "--bots-alone", "play") as server:
            before = server.wait_for(lambda s: s["woodlouse_room_ticks_total", "volcano"] >= 60)
            with server.player() as mara:
                mara.send({"type": "nonsense"})
                mara.expect("error")
            after = server.wait_for(lambda s: s["woodlouse_room_ticks_total", "volcano"] >= 180)
            self.assertEqual(before.series.keys(), after.series.keys())
            for series, value in before.series.items():
                if before.types[before.family(series[0])] != "gauge":
                    self.assertGreaterEqual(after.series[series], value, series)
            ticks = after["woodlouse_room_ticks_total", "volcano"]
            for name in ("lateness", "work"):
                name = f"woodlouse_room_tick_{name}_seconds"
                buckets = [after[name + "_bucket", "volcano", bound] for bound in (
                    "0.0001", "0.00025", "0.0005", "0.001", "0.0025", "0.005", "0.01", "0.025", "0.05", "0.1", "+Inf")]
                self.assertEqual(buckets, sorted(buckets))
                self.assertEqual((buckets[-1], after[name + "_count", "volcano"]), (ticks, ticks))

    def test_who_is_not_let_in_and_what_is_not_there_by_http_is_counted(self):
        with Watched("--web", "127.0.0.1:0", "--per-address", "2") as server:
            with server.client() as one, server.client() as two, server.client() as three:
                one.expect("hello")
                two.expect("hello")
                three.expect("bye", code="too_many_connections")
                server.wait_for(lambda s: s["woodlouse_connections_refused_total", "address_full"] == 1)
            server.wait_for(lambda s: s["woodlouse_sessions"] == 0)
            for path in ("/nowhere", "/rooms", "/nothing", "/ws"):
                server.ask_web(path)
            end, again = time.monotonic() + PATIENCE, 0
            while True:  # of this address two at a time: those before may be a moment in going
                wire = socket.create_connection(server.web_address, PATIENCE)
                wire.sendall(b"GET /ws HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
                             b"Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n\r\n")
                answer = wire.recv(4096)
                if b" 101 " in answer:
                    break
                wire.close()
                self.assertIn(b" 503 ", answer)
                again += 1
                self.assertLess(time.monotonic(), end)
                time.sleep(0.05)
            with wire:
                # Both at once: a scrape reads one number after the other, and may come between them.
                server.wait_for(lambda s: s["woodlouse_web_sessions"] == s["woodlouse_sessions"] == 1)
            after = server.wait_for(lambda s: s["woodlouse_web_sessions"] == s["woodlouse_sessions"] == 0)
            self.assertEqual(after["woodlouse_web_requests_total"], 5 + again)
            refused = after.by_label("woodlouse_web_refused_total")
            self.assertEqual({status: count for status, count in refused.items() if count}, {"404": 2, "426": 1} | ({"503": again} if again else {}))
            with socket.create_connection(server.web_address, PATIENCE) as wire:
                wire.sendall(b"\x16\x03\x01\x02\x00\x01")
                until_end(wire)
            self.assertEqual(server.scrape()["woodlouse_connections_refused_total", "no_tls"], 1)

    def test_a_recording_that_fails_is_told_with_what_is_lost(self):
        with Watched("--record", "/dev/full", "--bots", "1", "--bots-alone", "play", ends_with=1) as server:
            failed = server.wait_for(lambda s: (s["woodlouse_recording_failed", "volcano"] == 1 and
                                                s["woodlouse_recording_lost_bytes_total", "volcano"] > 0))
            self.assertEqual(failed["woodlouse_recording_written_bytes_total", "volcano"], 0)
            lost = failed["woodlouse_recording_lost_ticks_total", "volcano"]
            server.wait_for(lambda s: s["woodlouse_recording_lost_ticks_total", "volcano"] > lost)

    def test_what_is_written_of_a_recording_is_its_files_size(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "game.ndjson.zst")
            with Watched("--record", file) as server:  # nobody comes: after ten seconds nothing more is written
                server.wait_for(lambda s: (s["woodlouse_room_asleep", "volcano"] ==
                                           s["woodlouse_room_sleeps_total", "volcano"] == 1))
                server.wait_for(lambda s: s["woodlouse_recording_written_bytes_total", "volcano"] == os.path.getsize(file) > 0)

    def test_the_process_is_told_of_as_the_system_sees_it(self):
        with Watched() as server:
            scrape = server.scrape()
            proc = pathlib.Path("/proc", str(server.process.pid))
            self.assertAlmostEqual(scrape["process_open_fds"], len(list((proc / "fd").iterdir())), delta=3)
            limit = re.search(r"Max open files +(\d+)", (proc / "limits").read_text())[1]
            self.assertEqual(scrape["process_max_fds"], int(limit))
            resident = 1024 * int(re.search(r"VmRSS:\s+(\d+)", (proc / "status").read_text())[1])
            self.assertAlmostEqual(scrape["process_resident_memory_bytes"], resident, delta=0.2 * resident)
            version = re.search(r"\d+\.\d+\.\d+", run("--version")[1])[0]
            self.assertIn(version, next(s for s in scrape.series if s[0] == "woodlouse_build_info"))

    def test_every_line_of_the_log_is_a_documented_event_at_its_level(self):
        events = dict(re.findall(r"^\| `(\w+)` \| (debug|info|warning|error) \|", DOCUMENT.read_text(), re.M))
        for log_format in ("text", "json"):
            with Watched("--log-format", log_format, "--log-level", "debug") as server:
                with server.player('"\n info left: ') as mara:
                    mara.send({"type": "leave"})
                    mara.until_end()
                with server.client() as other:
                    other.send_bytes(b"x" * 70000)
                    other.expect("bye")
                server.wait_for_log("ended: line_too_long")
                lines = server.log().splitlines()
            if log_format == "json":
                told = [(entry["event"], entry["level"]) for entry in map(json.loads, lines)]
            else:
                found = [re.match(r"\d\d:\d\d:\d\d\.\d{3} (\w+) (\w+): ", line) for line in lines]
                self.assertNotIn(None, found, lines)
                told = [(line[2], line[1]) for line in found]
            self.assertEqual([level for _, level in told], [events.get(event) for event, _ in told], lines)
            self.assertEqual({event for event, _ in told}, {"room_opened", "connected", "joined", "left", "session_ended"})

    def test_it_is_ready_for_who_asks_at_the_operators_door(self):
        with Watched() as server:
            self.assertEqual(server.ask("/readyz"), (200, "text/plain; charset=utf-8", "ready\n"))
            status, kind, _ = server.ask("/metrics")
            self.assertEqual((status, kind), (200, "text/plain; version=0.0.4; charset=utf-8"))


if __name__ == "__main__":
    unittest.main()
