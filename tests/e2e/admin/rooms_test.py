"""What an operator does with rooms, and with the whole server."""

import os
import signal
import time
import unittest
import urllib.error
import urllib.request

from door import AdminServer, wait_until
from wire import PATIENCE, map_file, run


class Paused(unittest.TestCase):
    def test_no_tick_passes_and_all_are_told(self):
        with AdminServer() as server:
            ann = server.player("ann")
            tick = server.done("pause")["rooms"][0]["tick"]
            ann.expect("notice", code="paused")
            late = server.player("late")
            late.expect("notice", code="paused")
            ann.send({"type": "input", "seq": 1, "thrust": 1}, {"type": "chat", "text": "still?"})
            late.expect("event", kind="chat")
            time.sleep(0.3)
            self.assertIn("paused already", server.refused("pause", "not_now"))
            self.assertEqual(server.done("resume")["rooms"][0]["tick"], tick)
            ann.expect("notice", code="resumed")
            self.assertEqual(ann.expect("ack", seq=1)["tick"], tick)  # it waited for its step
            server.refused("resume", "not_now")
            self.assertEqual(server.done("rooms")["rooms"][0]["clock_moves"], 0)

    def test_steps_are_done_in_pace_and_it_stands_still_again(self):
        with AdminServer() as server:
            server.refused("step", "not_now", ticks=1)
            server.player("ann")
            tick = server.done("pause")["rooms"][0]["tick"]
            begun = time.monotonic()
            self.assertEqual(server.done("step", ticks=30)["rooms"][0]["tick"], tick + 30)
            self.assertGreater(time.monotonic() - begun, 0.4)
            self.assertEqual(server.done("step")["rooms"][0]["tick"], tick + 31)
            with server.door() as door:
                door.send("step", ticks=36000)
                time.sleep(0.3)
                server.refused("step", "not_now", ticks=1)
                server.done("pause")
                self.assertEqual(door.answer()["code"], "not_now")

    def test_as_often_and_as_fast_as_somebody_likes(self):
        with AdminServer() as server, server.door() as door:
            server.player("ann")
            end = time.monotonic() + 3
            while time.monotonic() < end:  # between, at and around ticks
                for _ in range(20):
                    door.send("pause")
                    door.send("resume")
                for _ in range(40):
                    self.assertEqual(door.answer()["type"], "done")
            self.assertEqual(server.done("rooms")["rooms"][0]["clock_moves"], 0)

    def test_a_paused_room_sleeps_no_more_than_it_stands_and_a_recording_of_it_verifies(self):
        with AdminServer("--record", "FOLDER/game.ndjson", "--bots", "2") as server:
            ann = server.player("ann")
            server.done("pause")
            late = server.player("late")
            server.done("step", ticks=5)
            server.done("step", ticks=5)
            late.send({"type": "leave"})
            server.done("resume")
            ann.expect("event", kind="left")
            self.assertEqual(server.stop()[0], 0)
            code, out, _ = run("verify", "--complete", server.path("game.ndjson"))
            self.assertEqual(code, 0, out)

    def test_of_several_rooms_one_alone_or_all(self):
        with AdminServer(maps=("volcano", "hills")) as server:
            server.done("pause", room="hills")
            rooms = {room["name"]: room["done"] for room in server.done("pause")["rooms"]}
            self.assertEqual(rooms, {"volcano": True, "hills": False})
            self.assertEqual(len([r for r in server.done("resume")["rooms"] if r["done"]]), 2)

    def test_what_waits_meanwhile_is_bounded(self):
        with AdminServer("--respawn-per-s", "1000", "--respawn-per-s-address", "10000", "--respawn-per-s-room", "10000",
                         "--messages-per-s", "10000", "--burst", "20000") as server:
            ann = server.player("ann")
            server.done("pause")
            ann.send_bytes(b'{"type":"respawn"}\n' * 4200)
            ann.expect("error", code="paused")
            server.done("resume")
            ann.send({"type": "input", "seq": 1, "thrust": 1})
            ann.expect("ack", seq=1)

    def test_who_stops_the_server_need_not_resume_first(self):
        with AdminServer() as server:
            ann = server.player("ann")
            server.done("pause")
            self.assertEqual(server.stop(signal.SIGTERM)[0], 0)
            self.assertEqual(ann.until_end()[-1]["code"], "shutdown")


class Opened(unittest.TestCase):
    def test_a_room_opens_and_closes_while_others_play(self):
        with AdminServer("--web", "127.0.0.1:0", "--bots", "1", "--shadow", "--record", "FOLDER/{room}.ndjson") as server:
            ann = server.player("ann")
            self.assertEqual(server.done("open", file=map_file("hills"), name="evening")["rooms"], ["evening"])
            self.assertIn("evening", server.client().expect("hello")["rooms"])
            with urllib.request.urlopen(server.url + "rooms", timeout=PATIENCE) as answer:
                self.assertIn(b'"evening"', answer.read())
            bob = server.player("bob", room="evening")
            self.assertEqual(bob.welcome["map"]["name"], "hills")
            self.assertEqual([entry["role"] for entry in bob.welcome["players"]], ["bot"])  # one of the house's
            bob.expect("delta")
            self.assertIn("there is a room", server.refused("open", "not_now", file="hills", name="evening"))
            server.done("close", room="evening")
            bye = bob.until_end()[-1]
            self.assertEqual((bye["type"], bye["code"]), ("bye", "shutdown"))
            server.refused("close", "unknown_room", room="evening")
            self.assertEqual(server.client().expect("hello")["rooms"], ["volcano"])
            ann.send({"type": "ping", "t": 1})
            ann.expect("pong")
            code, out, _ = run("verify", "--complete", server.path("evening.ndjson"))
            self.assertEqual(code, 0, out)
            # Its name is free again; of a former game nothing is written over.
            server.done("open", file="hills", name="evening")
            self.assertTrue(os.path.exists(server.path("evening.1.ndjson")))

    def test_who_watches_the_rooms_hears_of_it(self):
        with AdminServer() as server:
            lobby = server.client()
            lobby.send({"type": "list", "watch": True})
            self.assertEqual(len(lobby.expect("rooms")["rooms"]), 1)
            server.done("open", file="hills")
            self.assertEqual([room["name"] for room in lobby.expect("rooms")["rooms"]], ["volcano", "hills"])
            server.done("close", room="volcano")
            self.assertEqual([room["name"] for room in lobby.expect("rooms")["rooms"]], ["hills"])

    def test_the_last_room_may_close_and_the_server_goes_on(self):
        with AdminServer() as server:
            server.done("close", room="volcano")
            client = server.client()
            self.assertEqual(client.expect("hello")["rooms"], [])
            client.send({"type": "join", "protocol": 1, "name": "ann"})
            client.expect("error", code="unknown_room")
            server.refused("pause", "unknown_room")
            server.done("open", file="volcano")
            server.player("ann")

    def test_what_is_no_map_is_said_and_nothing_opens(self):
        with AdminServer() as server:
            with open(server.path("bad.json"), "w", encoding="utf-8") as file:
                file.write('{"name":"bad"')
            self.assertIn("bad.json", server.refused("open", "failed", file=server.path("bad.json")))
            server.refused("open", "failed", file="/dev/zero")
            self.assertEqual(len(server.done("rooms")["rooms"]), 1)


class Recorded(unittest.TestCase):
    def test_a_recording_ends_and_begins_while_the_game_goes_on(self):
        with AdminServer("--record", "FOLDER/{room}.ndjson", "--bots", "2") as server:
            ann = server.player("ann")
            self.assertTrue(server.done("rooms")["rooms"][0]["recorded"])
            server.refused("record", "not_now", on=True)
            server.done("record", on=False)
            server.refused("record", "not_now", on=False)
            ann.send({"type": "input", "seq": 1, "thrust": 1})
            ann.expect("ack", seq=1)
            server.done("record", on=True, room="volcano")
            ann.send({"type": "input", "seq": 2, "thrust": [0, 1]})
            ann.expect("ack", seq=2)
            ann.send({"type": "leave"})
            ann.expect("bye")
            self.assertEqual(server.stop()[0], 0)
            for name in ("volcano.ndjson", "volcano.1.ndjson"):
                code, out, _ = run("verify", "--complete", server.path(name))
                self.assertEqual(code, 0, out)

    def test_it_may_begin_while_somebody_is_about_to_join(self):
        with AdminServer("--record", "FOLDER/{room}.ndjson") as server:
            server.done("record", on=False)
            server.done("close", room="volcano")
            server.done("open", file="volcano", name="volcano")
            wait_until(lambda: server.done("rooms")["rooms"][0]["recorded"])  # what was said held for the room that is closed
            server.done("record", on=False)
            server.done("pause")
            server.player("ann")
            server.done("record", on=True)
            server.done("step", ticks=3)
            server.done("record", on=False)
            server.done("record", on=True)
            server.done("resume")
            self.assertEqual(server.stop()[0], 0)
            for name in ("volcano.1.ndjson", "volcano.2.ndjson"):
                code, out, _ = run("verify", "--complete", server.path(name))
                self.assertEqual(code, 0, out)

    def test_where_nothing_is_recorded_it_says_so(self):
        with AdminServer() as server:
            self.assertIn("--record", server.refused("record", "not_now", on=True))


class Whole(unittest.TestCase):
    def test_reload_reads_what_hup_reads(self):
        with AdminServer() as server:
            self.assertIn("read again", server.done("reload")["text"])
            server.wait_for_log("admin: limits and log level are read again")

    def test_drained_it_takes_nobody_tells_all_and_stops(self):
        with AdminServer("--web", "127.0.0.1:0") as server:
            ann = server.player("ann", resume=True)
            begun = time.monotonic()
            server.done("drain", seconds=3)
            self.assertIn("3 s", ann.expect("notice", code="draining")["text"])
            late = server.client()
            late.send({"type": "join", "protocol": 1, "name": "late"})
            self.assertFalse(late.expect("error", code="draining")["fatal"])
            late.send({"type": "join", "protocol": 1, "name": "late", "resume": "0" * 32})
            self.assertFalse(late.expect("error", code="draining")["fatal"])
            with self.assertRaises(urllib.error.HTTPError) as not_ready:
                urllib.request.urlopen(server.url + "readyz", timeout=PATIENCE)
            self.assertEqual(not_ready.exception.code, 503)
            ann.socket.close()
            back = server.client()
            back.join("ann", resume=ann.welcome["resume_token"])
            self.assertEqual(back.until_end()[-1]["code"], "shutdown")
            self.assertEqual(server.finish()[0], 0)
            self.assertGreater(time.monotonic() - begun, 2.5)

    def test_a_drain_may_be_put_off_and_shutdown_is_at_once(self):
        with AdminServer() as server:
            server.done("drain", seconds=1)
            server.done("drain", seconds=600)
            time.sleep(1.3)
            self.assertEqual(server.done("status")["rooms"], 1)
            server.done("shutdown")
            self.assertEqual(server.finish()[0], 0)


class Typed(unittest.TestCase):
    """`woodlouse-server admin` itself."""

    def test_each_command_by_its_words(self):
        with AdminServer("--record", "FOLDER/{room}.ndjson", "--ban-file", "FOLDER/bans") as server:
            players = [server.player("ann"), server.player("bob")]
            self.assertEqual(len(players), 2)
            for words, says in ((["status"], "2 players"), (["rooms"], "volcano"), (["say", "good", "evening"], "said"),
                                (["mute", "ann", "--for", "10m"], "until"), (["unmute", "ann"], "no more"),
                                (["pause"], "paused"), (["step", "3", "volcano"], "stands still"), (["resume"], "goes on"),
                                (["record", "off"], "no longer"), (["record", "on", "volcano"], "is recorded"),
                                (["open", "hills", "--name", "evening"], "room evening is open"),
                                (["close", "evening"], "is closed"), (["kick", "ann"], "kicked"),
                                (["ban", "bob", "--for", "1h"], "1 connections ended"), (["bans"], "bob"),
                                (["unban", "bob"], "no more"), (["reload"], "read again"), (["drain", "1h"], "3600 s"),
                                (["shutdown"], "stops")):
                code, out, err = server.typed(*words)
                self.assertEqual((words, code, err), (words, 0, ""))
                self.assertIn(says, out)
            self.assertEqual(server.finish()[0], 0)

    def test_exit_codes_and_what_to_do(self):
        with AdminServer() as server:
            code, out, err = server.typed("kick", "nobody")
            self.assertEqual((code, out), (1, ""))
            self.assertIn("nobody here", err)
            code, out, _ = server.typed("rooms", "--json")
            self.assertEqual(code, 0)
            self.assertTrue(out.startswith('{"type":"done"'))
            self.assertEqual(server.typed("ban", "ann", "--for", "soon")[0], 2)
            self.assertEqual(server.typed("record", "maybe")[0], 2)
            self.assertEqual(server.typed()[0], 2)
            server.stop(signal.SIGKILL)
            code, _, err = server.typed("status")
            self.assertEqual(code, 3)
            self.assertIn("gone", err)
        code, _, err = run("admin", "--socket", "/nonexistent/admin.sock", "status")
        self.assertEqual(code, 3)
        self.assertIn("--admin", err)
        code, out, _ = run("admin", "ban", "--help")
        self.assertEqual(code, 0)
        self.assertIn("--for", out)


if __name__ == "__main__":
    unittest.main()
