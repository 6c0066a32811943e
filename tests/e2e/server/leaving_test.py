"""Whoever sends its lines and ends its sending side (`printf ... | nc -N`), or leaves, is answered first."""

import json
import shutil
import socket
import subprocess
import unittest

from wire import PATIENCE, Server

JOIN = {"type": "join", "protocol": 1, "name": "ann"}
QUESTIONS = [
    ({"type": "input", "seq": 1, "thrust": 1}, {"type": "ack", "seq": 1, "dropped": False}),
    ({"type": "chat", "text": "hello"}, {"type": "event", "kind": "chat", "text": "hello"}),
    ({"type": "list"}, {"type": "rooms"}),
    ({"type": "get_map"}, {"type": "map"}),
    ({"type": "resync"}, {"type": "key"}),
    ({"type": "respawn"}, {"type": "event", "kind": "respawned"}),
    ({"type": "ping", "t": 5}, {"type": "pong", "t": 5}),
    ({"type": "dance"}, {"type": "error", "code": "unknown_type"}),
]
LEAVE = {"type": "leave"}


class Leaving(unittest.TestCase):
    def assert_answered(self, messages, answers):
        for answer in answers:
            self.assertTrue(any(answer.items() <= message.items() for message in messages), (answer, messages))
        self.assertEqual((messages[-1]["type"], messages[-1]["code"]), ("bye", "left"), messages)

    def test_each_question_is_answered_before_the_end_of_its_connection(self):
        with Server() as server, server.player("eye", role="spectator") as eye:
            for question, answer in QUESTIONS:
                for ends_by in ("leave", "end of input", "both"):
                    with self.subTest(question=question, ends_by=ends_by), server.client() as client:
                        client.send(JOIN, question, *([] if ends_by == "end of input" else [LEAVE]))
                        if ends_by != "leave":
                            client.socket.shutdown(socket.SHUT_WR)
                        messages = client.until_end()
                        self.assert_answered(messages, [{"type": "welcome"}, {"type": "key"}, answer])
                        eye.expect("event", kind="left", name="ann")

    def test_inputs_for_steps_to_come_are_taken_and_acknowledged_before_the_louse_leaves(self):
        with Server() as server, server.client() as client:
            client.send({"type": "list"}, JOIN)
            tick = client.expect("welcome")["tick"]
            client.send({"type": "input", "seq": 1, "thrust": 1, "tick": tick + 60})
            client.socket.shutdown(socket.SHUT_WR)
            self.assert_answered(client.until_end(), [{"type": "ack", "seq": 1, "tick": tick + 60, "dropped": False}])

    def test_many_lines_and_a_big_map_reach_a_client_that_reads_late(self):
        with Server(maps=("maunga_whau",)) as server, server.client(receive_buffer=4096) as client:
            client.send(JOIN, {"type": "get_map"}, *[{"type": "ping", "t": t} for t in range(150)])
            client.socket.shutdown(socket.SHUT_WR)
            server.wait_for_log(": connection ended")
            answers = [{"type": "map"}, *[{"type": "pong", "t": t} for t in range(150)]]
            self.assert_answered(client.until_end(), answers)

    def test_a_client_that_closes_altogether_is_gone_at_once(self):
        with Server() as server, server.player("eye", role="spectator") as eye:
            with server.player("ann") as ann:
                ann.send({"type": "input", "seq": 1, "thrust": 1})
            eye.expect("event", kind="left", name="ann", patience=2)

    @unittest.skipUnless(shutil.which("nc"), "needs nc")
    def test_nc_prints_the_answers_to_what_it_was_given_and_ends(self):
        with Server() as server:
            lines = b"".join(json.dumps(line).encode() + b"\n" for line in (JOIN, *(q for q, _ in QUESTIONS)))
            done = subprocess.run(["nc", "-N", server.host, str(server.port)], input=lines, capture_output=True,
                                  timeout=PATIENCE, check=True)
            messages = [json.loads(line) for line in done.stdout.splitlines()]
            self.assert_answered(messages, [answer for _, answer in QUESTIONS])


if __name__ == "__main__":
    unittest.main()
