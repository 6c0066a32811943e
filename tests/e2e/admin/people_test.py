"""What an operator does about people: kicked, muted, banned, told something."""

import json
import os
import resource
import signal
import time
import unittest
import urllib.error
import urllib.request

from door import AdminServer, wait_until
from wire import PATIENCE, map_file, run


class Kicked(unittest.TestCase):
    def test_a_player_is_told_and_his_louse_goes_at_once(self):
        with AdminServer() as server:
            ann = server.player("ann", resume=True)
            bob = server.player("bob")
            self.assertEqual(server.done("kick", who="Ann")["count"], 1)
            ends = ann.until_end()[-2:]
            self.assertEqual([(m["type"], m["code"]) for m in ends], [("error", "kicked"), ("bye", "kicked")])
            bob.expect("event", kind="left", name="ann")
            server.done("kick", who=str(bob.id))
            bob.until_end()

    def test_nobody_is_said_and_the_houses_bots_stay(self):
        with AdminServer("--bots", "1") as server:
            server.refused("kick", "nobody", who="ann")
            server.refused("kick", "unknown_room", who="ann", room="moon")
            bot = server.player("bob").welcome["players"][0]
            self.assertIn("house", server.refused("kick", "not_now", who=bot["name"]))

    def test_a_number_for_a_name_is_no_shield(self):
        with AdminServer() as server:
            ann, eve = server.player("ann"), server.player("bob")
            two = server.player(str(eve.id), role="spectator")
            one = server.player(str(ann.id))
            self.assertEqual(server.done("kick", who=str(eve.id))["count"], 1)
            self.assertEqual(two.until_end()[-1]["code"], "kicked")
            server.done("kick", who=str(one.id))  # nobody is called so: the louse is meant
            one.until_end()
            server.done("kick", who=str(eve.id), room="volcano")
            eve.until_end()
            server.refused("kick", "nobody", who="0" + str(ann.id))
            ann.send({"type": "ping", "t": 1})
            ann.expect("pong")

    def test_who_is_away_can_not_come_back_either(self):
        with AdminServer() as server:
            ann = server.player("ann", resume=True)
            bob = server.player("bob")
            ann.socket.close()
            wait_until(lambda: server.done("rooms")["rooms"][0]["spectators"] == 0)
            time.sleep(0.2)
            self.assertEqual(server.done("kick", who="ann")["count"], 1)
            bob.expect("event", kind="left", name="ann")


class Listed(unittest.TestCase):
    def test_who_is_in_a_room_and_from_where(self):
        with AdminServer("--bots", "1") as server:
            ann = server.player("ann", source="127.0.0.9", resume=True)
            eve = server.player("eve", role="spectator")
            members = {member["name"]: member for member in server.done("rooms", room="volcano")["members"]}
            self.assertEqual((members["ann"]["louse"], members["ann"]["address"]), (ann.id, "127.0.0.9"))
            self.assertEqual((members["eve"]["role"], members["eve"]["louse"]), ("spectator", eve.id))
            self.assertEqual([member["house"] for member in members.values()].count(True), 1)
            ann.socket.close()
            wait_until(lambda: any(member["away"] for member in server.done("rooms", room="volcano")["members"]))
            self.assertIn("(away)", server.typed("rooms", "volcano")[1])
            server.refused("rooms", "unknown_room", room="moon")


class Muted(unittest.TestCase):
    def test_chat_is_refused_and_the_game_goes_on(self):
        with AdminServer() as server:
            ann, bob = server.player("ann"), server.player("bob")
            server.done("mute", who="ann")
            ann.send({"type": "chat", "text": "hello"}, {"type": "input", "seq": 1, "thrust": 1})
            self.assertFalse(ann.expect("error", code="muted")["fatal"])
            ann.expect("ack", seq=1)
            bob.send({"type": "chat", "text": "and I"})
            ann.expect("event", kind="chat", name="bob")
            server.done("unmute", who="ann")
            ann.send({"type": "chat", "text": "again"})
            bob.expect("event", kind="chat", name="ann", text="again")
            self.assertFalse([m for m in bob.seen if m.get("text") == "hello"])
            server.refused("unmute", "nobody", who="ann")

    def test_who_comes_back_to_his_louse_is_muted_still(self):
        with AdminServer() as server:
            ann, bob = server.player("ann", resume=True), server.player("bob")
            server.done("mute", who="ann")
            ann.socket.close()
            back = server.client()
            back.join("ann", resume=ann.welcome["resume_token"])
            back.send({"type": "chat", "text": "hello"})
            back.expect("error", code="muted")
            self.assertIn("muted", server.typed("rooms", "volcano")[1])
            server.done("unmute", who="ann")
            server.refused("unmute", "nobody", who="ann")
            back.send({"type": "chat", "text": "again"})
            self.assertEqual(bob.expect("event", kind="chat")["text"], "again")

    def test_an_address_is_for_a_while(self):
        with AdminServer() as server:
            ann, far = server.player("ann"), server.player("far", source="127.0.0.9")
            server.done("mute", who="127.0.0.9", seconds=1)
            far.send({"type": "chat", "text": "hello"})
            far.expect("error", code="muted")
            ann.send({"type": "chat", "text": "I may"})
            far.expect("event", kind="chat", name="ann")
            time.sleep(2.1)
            far.send({"type": "chat", "text": "I may, too"})
            ann.expect("event", kind="chat", name="far")


class Told(unittest.TestCase):
    def test_all_hear_it_or_one_room_alone(self):
        with AdminServer(maps=("volcano", "hills")) as server:
            here, there = server.player("ann", room="volcano"), server.player("bob", room="hills")
            server.done("say", text="to the hills", room="hills")
            server.done("say", text="to all")
            self.assertEqual(there.expect("notice", code="operator")["text"], "to the hills")
            self.assertEqual(there.expect("notice", code="operator")["text"], "to all")
            self.assertEqual(here.expect("notice", code="operator")["text"], "to all")


class Banned(unittest.TestCase):
    def test_an_address_is_kept_out_at_every_port_and_says_until_when(self):
        with AdminServer("--web", "127.0.0.1:0", "--ban-file", "FOLDER/bans") as server:
            ann, far = server.player("ann"), server.player("far", source="127.0.0.9")
            answer = server.done("ban", who="127.0.0.8/30", seconds=3600)
            self.assertEqual(answer["ended"], 1)
            self.assertEqual(far.until_end()[-1]["code"], "banned")
            again = server.client(source="127.0.0.10")
            first = again.receive()
            self.assertEqual((first["type"], first["code"], first["fatal"]), ("error", "banned", True))
            self.assertIn("UTC", first["text"])
            again.until_end()
            web = server.client(source="127.0.0.9")
            web.socket.close()
            self.assertEqual(server.player("bob", source="127.0.0.12").welcome["type"], "welcome")
            ann.send({"type": "ping", "t": 1})
            ann.expect("pong")
            server.done("unban", who="127.0.0.8/30")
            server.player("far", source="127.0.0.9")

    def test_an_address_is_kept_out_of_the_web_port(self):
        with AdminServer("--web", "127.0.0.1:0") as server:
            server.done("ban", who="127.0.0.1")
            with self.assertRaises(urllib.error.HTTPError) as refusal:
                urllib.request.urlopen(server.url + "rooms", timeout=PATIENCE)
            self.assertIn(b"banned", refusal.exception.read())
            server.done("unban", who="127.0.0.1")
            with urllib.request.urlopen(server.url + "rooms", timeout=PATIENCE) as answer:
                self.assertEqual(json.load(answer)[0]["name"], "volcano")

    def test_a_name_is_kept_out_in_any_case_and_its_second_one(self):
        with AdminServer() as server:
            first, second, other = server.player("ann"), server.player("ann"), server.player("anna")
            self.assertEqual(second.welcome["name"], "ann#2")
            self.assertIn("without the number", server.done("ban", who="bob#2")["text"])
            self.assertIn("--ban-file", server.done("ban", who="ANN")["text"])
            self.assertEqual(first.until_end()[-1]["code"], "banned")
            self.assertEqual(second.until_end()[-1]["code"], "banned")
            client = server.client()
            client.send({"type": "join", "protocol": 1, "name": "Ann"})
            self.assertEqual(client.until_end()[-1]["code"], "banned")
            other.send({"type": "ping", "t": 1})
            other.expect("pong")

    def test_ends_when_it_is_over(self):
        with AdminServer("--ban-file", "FOLDER/bans") as server:
            server.done("ban", who="ann", seconds=1)
            time.sleep(2.1)
            server.player("ann")
            self.assertEqual(server.done("bans")["bans"], [])

    def test_survives_the_server_and_is_read_again_at_hup(self):
        with AdminServer("--ban-file", "FOLDER/bans") as server:
            server.done("ban", who="192.0.2.0/24", seconds=3600)
            server.done("ban", who="ann")
            server.stop(signal.SIGKILL)
            with AdminServer("--ban-file", server.path("bans")) as again:
                bans = again.done("bans")["bans"]
                self.assertEqual([ban.get("address", ban.get("name")) for ban in bans], ["192.0.2.0/24", "ann"])
                with open(server.path("bans"), "w", encoding="utf-8") as file:
                    file.write('{"name":"bob"}\n')
                again.process.send_signal(signal.SIGHUP)
                wait_until(lambda: [ban.get("name") for ban in again.done("bans")["bans"]] == ["bob"])
                ann, far = again.player("ann"), again.player("far", source="127.0.0.9")
                with open(server.path("bans"), "w", encoding="utf-8") as file:
                    file.write('{"name":"bob"}\n{"name":"ANN"}\n{"address":"127.0.0.9"}\n')
                self.assertIn("2 of whom are put out", again.done("reload")["text"])
                self.assertEqual([who.until_end()[-1]["code"] for who in (ann, far)], ["banned", "banned"])
                with open(server.path("bans"), "w", encoding="utf-8") as file:
                    file.write('{"name":"bob"}\n{"address":"192.0.2.')
                self.assertIn("bans:2", again.refused("reload", "failed"))
                self.assertEqual(len(again.done("bans")["bans"]), 3)

    def test_a_torn_file_is_no_reason_to_let_everybody_in(self):
        with AdminServer() as server:
            with open(server.path("bans"), "w", encoding="utf-8") as file:
                file.write('{"address":"192.0.2.7"}\n{"address":"192.0.')
            code, _, err = run("--map", map_file("volcano"), "--listen", "127.0.0.1:0", "--ban-file",
                               server.path("bans"))
            self.assertEqual(code, 1)
            self.assertIn("bans:2", err)

    def test_what_can_not_be_written_is_not_in_force_and_the_old_file_stays(self):
        with AdminServer("--ban-file", "FOLDER/bans") as server:
            server.done("ban", who="192.0.2.1")
            with open(server.path("bans"), encoding="utf-8") as file:
                before = file.read()
            os.mkdir(server.path("bans.new"))
            self.assertIn("bans.new", server.refused("ban", "failed", who="192.0.2.2"))
            os.rmdir(server.path("bans.new"))
            # As a full disk does, it takes a part.
            resource.prlimit(server.process.pid, resource.RLIMIT_FSIZE, (len(before) + 8, len(before) + 8))
            server.refused("ban", "failed", who="192.0.2.2")
            with open(server.path("bans"), encoding="utf-8") as file:
                self.assertEqual(file.read(), before)
            self.assertFalse(os.path.exists(server.path("bans.new")))
            self.assertEqual(len(server.done("bans")["bans"]), 1)

    def test_nonsense_is_no_address(self):
        with AdminServer() as server:
            for who in ("192.0.2.0/33", "0.0.0.0/0", "::/0", "192.0.2.0/x"):
                server.refused("ban", "bad_field", who=who)
            server.refused("unban", "failed", who="192.0.2.1")


if __name__ == "__main__":
    unittest.main()
