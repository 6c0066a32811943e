"""Two players, the house's bots and a spectator in one room."""

import math
import unittest

from wire import Server, PATIENCE


def position(client, louse):
    return client.rows[louse][1:3]


class Play(unittest.TestCase):
    def test_two_players_and_a_bot_see_each_other_move(self):
        # The seed: a spawn from which a push to the east moves; from the eastern one it is held on the slope.
        with Server("--bots", "1", "--seed", "1") as server, server.player("mara") as mara, server.player("timo") as timo:
            self.assertNotEqual(mara.id, timo.id)
            bot = next(p for p in timo.welcome["players"] if p["role"] == "bot")
            self.assertEqual([p["name"] for p in timo.welcome["players"] if p["role"] == "player"], ["mara"])
            mara.send({"type": "input", "seq": 1, "thrust": [1.0, 0.0]})
            timo.send({"type": "input", "seq": 1, "thrust": 1})
            for client in (mara, timo):
                while set(client.rows) != {mara.id, timo.id, bot["id"]}:
                    client.receive()
                start = dict(client.rows)
                deltas = 0
                while any(math.dist(start[i][1:3], position(client, i)) < 50 for i in start):
                    self.assertLess(deltas, 20 * PATIENCE, (start, client.rows))
                    deltas += client.receive()["type"] == "delta"

    def test_frames_come_at_the_state_rate_with_a_key_each_second(self):
        with Server("--tick-hz", "60", "--state-hz", "20") as server, server.player() as player:
            ticks = []
            player.expect("key")
            player.expect("key")
            while len(ticks) < 60:
                message = player.receive()
                if message["type"] in ("key", "delta"):
                    ticks.append((message["tick"], message["type"]))
            self.assertEqual([b - a for (a, _), (b, _) in zip(ticks, ticks[1:])], [3] * 59)
            self.assertEqual([t for t, kind in ticks if kind == "key"], [t for t, _ in ticks if t % 60 == 0])

    def test_a_client_gets_the_rate_columns_and_format_it_asked_for(self):
        with Server("--bots", "2") as server, server.player(
            state_hz=7, format="exact", fields=["z", "speed", "yaw"]
        ) as player:
            self.assertEqual(player.welcome["state_hz"], 5)
            self.assertEqual(player.welcome["fields"], ["id", "z", "speed", "yaw"])
            player.expect("key")
            player.expect("key")
            ticks = [player.expect("delta")["tick"] for _ in range(3)]
            self.assertEqual([b - a for a, b in zip(ticks, ticks[1:])], [12, 12])
            for row in player.rows.values():
                self.assertEqual(len(row), 4)
                self.assertIsInstance(row[1], float)

    def test_an_ack_tells_tick_margin_and_the_exact_state(self):
        with Server() as server, server.player(fields="all", format="exact") as player:
            player.send({"type": "input", "seq": 7, "thrust": [3.0, 4.0], "ticks": 200})
            ack = player.expect("ack", seq=7)
            self.assertTrue(ack["clamped"])
            self.assertFalse(ack["late"] or ack["dropped"])
            self.assertGreaterEqual(ack["margin_us"], 0)
            self.assertLess(ack["margin_us"], 2_000_000)
            you = ack["you"]
            self.assertEqual(you["tick"], ack["tick"] + 1)
            self.assertEqual(you["id"], player.id)
            self.assertLessEqual(math.hypot(*you["thrust"]), 1.0)
            self.assertAlmostEqual(you["thrust"][0], 0.6, delta=1 / 128)
            # A frame of that very tick shows the same bits.
            player.send({"type": "input", "seq": 8, "thrust": 1, "tick": ack["tick"] + 62 - ack["tick"] % 3})
            you = player.expect("ack", seq=8)["you"]
            while player.seen[-1].get("tick") != you["tick"]:
                player.receive()
                self.assertLessEqual(player.seen[-1].get("tick", 0), you["tick"])
            row = dict(zip(player.welcome["fields"], player.rows[player.id]))
            for name in ("x", "y", "vx", "vy", "distance"):
                self.assertEqual(row[name], you[name])

    def test_inputs_that_cannot_be_taken_are_answered_with_the_reason(self):
        with Server() as server, server.player() as player:
            player.expect("delta")  # tick 1 is past by then
            player.send({"type": "input", "seq": 5, "thrust": 1})
            tick = player.expect("ack", seq=5)["tick"]
            player.send({"type": "input", "seq": 5, "thrust": 1})
            player.expect("error", code="stale_seq")
            player.send({"type": "input", "seq": 6, "thrust": 1, "tick": tick + 100_000})
            player.expect("error", code="too_far")
            self.assertTrue(player.expect("ack", seq=6)["dropped"])
            self.assertEqual([m["dropped"] for m in player.seen if m["type"] == "ack" and m["seq"] == 5], [False])
            for seq, tick in ((7, 1), (8, 0)):
                player.send({"type": "input", "seq": seq, "thrust": 1, "tick": tick})
                self.assertTrue(player.expect("ack", seq=seq)["late"])

    def test_whoever_joins_asks_and_leaves_in_one_write_is_answered_to_the_end(self):
        with Server(maps=("volcano", "hills")) as server:
            for room, kinds in ((None, {"welcome", "map"}), ("nowhere", {"error"})):
                join = {"type": "join", "protocol": 1, "name": "x", **({"room": room} if room else {})}
                client = server.client()
                client.send(join, {"type": "get_map"}, {"type": "ping", "t": 1}, {"type": "leave"})
                client.until_end()
                seen = [message["type"] for message in client.seen]
                self.assertLessEqual(kinds | {"pong"}, set(seen))
                self.assertEqual(client.seen[-1]["type"], "bye")
                self.assertEqual(client.seen[-1]["code"], "left")

    def test_events_are_numbered_without_holes_and_reach_everyone(self):
        with Server() as server, server.player("watcher", role="spectator") as watcher:
            self.assertEqual(watcher.id, 0)
            with server.player("mara") as mara:
                mara.send({"type": "chat", "text": "hello\u001b[2J hill"}, {"type": "respawn"}, {"type": "leave"})
                bye = mara.until_end()[-1]
                self.assertEqual((bye["type"], bye["code"]), ("bye", "left"))
            with server.player("timo"):
                pass
            watcher.expect("event", kind="left", name="timo")  # of the watcher itself nobody hears
            events = [m for m in watcher.seen if m["type"] == "event"]
            self.assertEqual(
                [(e["kind"], e["name"]) for e in events],
                [("joined", "mara"), ("chat", "mara"), ("respawned", "mara"), ("left", "mara"),
                 ("joined", "timo"), ("left", "timo")],
            )
            self.assertEqual([e["n"] for e in events], list(range(1, 7)))
            chat = events[1]
            self.assertNotIn("\x1b", chat["text"])
            self.assertIn("hill", chat["text"])

    def test_a_louse_goes_with_its_connection(self):
        with Server() as server, server.player("watcher", role="spectator") as watcher:
            with server.player("mara") as mara:
                mara.send({"type": "input", "seq": 1, "thrust": 1})
                while mara.id not in watcher.rows:
                    watcher.receive()
            watcher.expect("event", kind="left", id=mara.id)
            while mara.id in watcher.rows:
                watcher.receive()

    def test_a_spectator_sees_everything_and_has_no_louse(self):
        with Server("--bots", "3") as server, server.player("eye", role="spectator") as eye:
            while len(eye.rows) < 3:
                eye.receive()
            eye.send({"type": "input", "seq": 1, "thrust": 1}, {"type": "respawn"})
            eye.expect("error", code="no_louse")
            eye.expect("error", code="no_louse")

    def test_list_map_resync_and_ping_are_answered(self):
        with Server("--bots", "2", maps=("volcano", "parabolic_pot")) as server, server.client() as client:
            self.assertEqual(client.expect("hello")["rooms"], ["volcano", "parabolic_pot"])
            client.send({"type": "ping", "t": 12})
            self.assertEqual(client.expect("pong")["t"], 12)
            client.join(room="parabolic_pot")
            client.send({"type": "list"})
            rooms = {r["name"]: r for r in client.expect("rooms")["rooms"]}
            self.assertEqual((rooms["volcano"]["players"], rooms["volcano"]["bots"]), (0, 2))
            self.assertEqual((rooms["parabolic_pot"]["players"], rooms["parabolic_pot"]["bots"]), (1, 2))
            key = client.expect("key")
            client.send({"type": "resync"})
            self.assertGreaterEqual(client.expect("key")["tick"], key["tick"])
            client.send({"type": "get_map"})
            map_message = client.expect("map")
            self.assertEqual(map_message["name"], "parabolic_pot")
            self.assertEqual(map_message["hash"], client.welcome["map"]["hash"])
            self.assertIn("terrain", map_message["definition"])

    def test_it_serves_ipv6_too(self):
        with Server(listen="[::1]:0") as server:
            self.assertTrue(server.address.startswith("[::1]:"))
            with server.player() as player:
                player.expect("delta")


if __name__ == "__main__":
    unittest.main()
