"""How a server ends: told to everyone, written down, in time."""

import fcntl
import os
import re
import signal
import subprocess
import tempfile
import time
import unittest

from wire import PATIENCE, PROGRAM, Client, Reader, Server, map_file, run, share_missed


def wait_until_caught(pid, number):
    """Until the process has set a handler for that signal."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        with open(f"/proc/{pid}/status", encoding="ascii") as status:
            caught = int(re.search(r"^SigCgt:\s*([0-9a-f]+)", status.read(), re.MULTILINE)[1], 16)
        if caught >> (number - 1) & 1:
            return
        time.sleep(0.005)
    raise AssertionError("no handler was set")


class Shutdown(unittest.TestCase):
    def test_a_signal_says_bye_to_all_finishes_the_recording_and_exits_zero_within_a_second(self):
        for by in (signal.SIGTERM, signal.SIGINT, signal.SIGQUIT, signal.SIGUSR2, signal.SIGALRM):
            with tempfile.TemporaryDirectory() as folder:
                file = os.path.join(folder, "game.ndjson")
                with Server("--record", file, "--bots", "2") as server:
                    players = [server.player(f"p{i}") for i in range(5)]
                    watcher = server.player("eye", role="spectator")
                    greeted = server.client()
                    greeted.expect("hello")
                    watcher.expect("delta")
                    code, seconds, printed = server.stop(by)
                    self.assertEqual(code, 0, server.log())
                    self.assertLess(seconds, 1.0)
                    for client in [*players, watcher, greeted]:
                        bye = client.until_end()[-1]
                        self.assertEqual((bye["type"], bye["code"], bye["resumable"]), ("bye", "shutdown", False))
                        client.socket.close()
                code, verdict, errors = run("verify", file)
                self.assertEqual((code, verdict.split()[0]), (0, "ok"), verdict + errors)

    def test_a_signal_that_its_starter_ignores_ends_nothing(self):
        before = signal.signal(signal.SIGHUP, signal.SIG_IGN)  # as nohup does; a child inherits it
        try:
            with Server() as server, server.player() as player:
                server.process.send_signal(signal.SIGHUP)
                for _ in range(20):
                    player.expect("delta")
                self.assertEqual(server.stop()[0], 0)
        finally:
            signal.signal(signal.SIGHUP, before)

    def test_a_log_that_nobody_reads_holds_up_neither_frames_nor_the_end(self):
        unread, log = os.pipe()
        fcntl.fcntl(log, fcntl.F_SETPIPE_SZ, 4096)
        process = subprocess.Popen([PROGRAM, "--map", map_file("volcano"), "--listen", "127.0.0.1:0", "--log-level", "debug",
                                    "--join-per-s-address", "1000"],
                                   stdout=subprocess.PIPE, stderr=log, text=True)
        os.close(log)
        try:
            address = process.stdout.readline().split()[1]
            host, port = address.rsplit(":", 1)
            with Client(host, int(port)) as watcher:
                watcher.join("eye", role="spectator")
                reader = Reader(watcher)
                # The pipe holds 4 KB; each of these is a line of some 80 bytes when it comes.
                for number in range(300):
                    with Client(host, int(port)) as guest:
                        guest.join(f"guest {number}")
                time.sleep(1.0)  # some frames
                process.terminate()
                begun = time.monotonic()
                self.assertEqual(process.wait(PATIENCE), 0)
                self.assertLess(time.monotonic() - begun, 1.0)
                self.assertLess(share_missed(reader.messages("key", "delta"), 3), 0.05)
        finally:
            process.kill()
            process.stdout.close()
            os.close(unread)

    def test_a_signal_while_a_big_map_is_loaded_ends_it_at_once_and_leaves_no_recording(self):
        for by in (signal.SIGTERM, signal.SIGINT):
            with tempfile.TemporaryDirectory() as folder:
                big = os.path.join(folder, "big.json")
                with open(big, "w") as out:
                    out.write('{"name":"big","terrain":{"function":"hills","grid":999}}')
                process = subprocess.Popen([PROGRAM, "--map", map_file("volcano"), big, "--listen", "127.0.0.1:0",
                                            "--record", os.path.join(folder, "game")], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
                try:
                    wait_until_caught(process.pid, by)
                    begun = time.monotonic()
                    process.send_signal(by)
                    printed, errors = process.communicate(timeout=PATIENCE)
                    self.assertLess(time.monotonic() - begun, 1.0)
                    self.assertEqual((process.returncode, printed, errors), (0, b"", b""))
                    self.assertEqual(os.listdir(folder), ["big.json"])
                finally:
                    process.kill()

    def test_a_client_that_does_not_read_cannot_hold_up_the_exit(self):
        with Server("--bots", "40") as server, server.client(receive_buffer=4096) as stuck:
            stuck.join(fields="all", format="exact")
            server.client().socket.close()
            with server.player("steady") as steady:
                for _ in range(60):
                    steady.expect("delta")
            code, seconds, _ = server.stop()
            self.assertEqual(code, 0)
            self.assertLess(seconds, 1.0)

    def test_it_stops_after_ticks_and_prints_what_it_did(self):
        with Server("--ticks", "120", "--bots", "1", maps=("volcano", "hills")) as server, server.player() as player:
            self.assertEqual(player.until_end()[-1]["code"], "shutdown")
            code, _, printed = server.finish()
        self.assertEqual(code, 0)
        figures = r"ticks 120, lateness p50 [0-9.]+ ms p99 [0-9.]+ ms max [0-9.]+ ms, .*clock moves \d+, frames encoded \d+"
        for room in ("volcano", "hills"):
            self.assertRegex(printed, room + ": " + figures)
        self.assertGreater(int(re.search(r"volcano: .*frames encoded (\d+)", printed)[1]), 10)
        self.assertRegex(printed, r"hills: .*frames encoded 0\n")
        self.assertGreater(int(re.search(r"frames sent (\d+)", printed)[1]), 10)

    def test_the_port_is_free_again_at_once(self):
        with Server() as server, server.player() as player:
            address = server.address
            player.expect("delta")
            server.stop()
            with Server(listen=address) as again:
                self.assertEqual(again.address, address)


if __name__ == "__main__":
    unittest.main()
