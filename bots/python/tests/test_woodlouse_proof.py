"""The hash of a key, recomputed: python3 -m unittest test_woodlouse_proof"""

import os
import struct
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import woodlouse
from scripted_server import BYE, HELLO, Scripted, WELCOME, expect


class Verifying(unittest.TestCase):
    ROWS = [[1, 0, 0.1, -0.0, 1e-300, 2, 1, 0, 0.5, 0, 0, 0, 3.25, 1, 4294967295],
            [2, 1, -7.5, 1 / 3, 0, 0, 0, -1, 0, 0, 0, 0, 12, 0, 0]]

    def key(self):
        # Of the rows above by the server's own code, as the other hashes here.
        return {"type": "key", "tick": 62, "louse": self.ROWS, "hash": "baf2b847673003c5", "previous": "%016x" % 1,
                "inputs": "%016x" % 2, "roster": "%016x" % 4, "rules": "%016x" % 0, "link": 60,
                "generator": "%016x" % 3}

    def verified(self, key):
        welcome = dict(WELCOME, fields=woodlouse.ALL_FIELDS, quantum=[1] * 15, format="exact")

        def script(send, receive):
            send(HELLO)
            expect(receive, type="join", fields="all", format="exact")
            send(welcome, key, BYE)

        with Scripted(script) as server:
            with woodlouse.connect(server.address, verify=True) as game:
                for _ in game.states():
                    pass
        return game.verified

    def test_xxh64_is_that_of_the_c_library_for_every_length_of_rest(self):
        data = bytes((7 * i + 3) & 255 for i in range(100))
        hashes = [woodlouse.xxh64(data[:size]) for size in range(101)]
        self.assertEqual(hashes[0], 0xef46db3751d8e999)
        self.assertEqual(woodlouse.xxh64(b"abc"), 0x44bc2cf5ad770999)
        self.assertEqual(woodlouse.xxh64(struct.pack("<101Q", *hashes)), 0x69278944434abcf6)

    def test_a_key_whose_rows_give_its_hash_is_counted(self):
        self.assertEqual(self.verified(self.key()), 1)

    def test_a_flipped_bit_in_any_number_of_a_row_raises(self):
        for louse in range(2):
            for column in range(15):
                key = self.key()
                key["louse"] = [list(row) for row in self.ROWS]
                value = key["louse"][louse][column]
                if column in (0, 1, 13, 14):
                    key["louse"][louse][column] = value ^ 1
                else:
                    bits, = struct.unpack("<Q", struct.pack("<d", value))
                    key["louse"][louse][column], = struct.unpack("<d", struct.pack("<Q", bits ^ 1))
                with self.assertRaises(woodlouse.WoodlouseError) as caught:
                    self.verified(key)
                self.assertEqual(caught.exception.code, "differs")
                self.assertIn("tick 62", caught.exception.text)

    def test_what_else_went_into_the_hash_counts_too(self):
        for field in ("hash", "previous", "inputs", "roster", "rules", "generator"):
            with self.assertRaises(woodlouse.WoodlouseError) as caught:
                self.verified(dict(self.key(), **{field: "%016x" % 9}))
            self.assertEqual(caught.exception.code, "differs")
        with self.assertRaises(woodlouse.WoodlouseError) as caught:
            self.verified(dict(self.key(), link=61))
        self.assertEqual(caught.exception.code, "differs")

    def test_lice_are_hashed_in_blocks_of_64(self):
        rows = [[louse + 1] + self.ROWS[louse % 2][1:] for louse in range(130)]
        self.assertEqual(self.verified(dict(self.key(), louse=rows, hash="00da3f79a97fc6d8")), 1)

    def test_before_anything_was_done_the_hash_is_0_and_nobody_is_there(self):
        nothing = "%016x" % 0
        beginning = dict(self.key(), louse=[], link=0, hash=nothing, previous=nothing, inputs=nothing, roster=nothing)
        self.assertEqual(self.verified(beginning), 1)
        for change in ({"hash": "%016x" % 1}, {"louse": self.ROWS}, {"previous": "%016x" % 1}, {"inputs": "%016x" % 1},
                       {"roster": "%016x" % 1}, {"rules": "%016x" % 1}):
            with self.assertRaises(woodlouse.WoodlouseError) as caught:
                self.verified(dict(beginning, **change))
            self.assertEqual(caught.exception.code, "differs")

    def test_a_key_can_not_be_proven_by_a_later_tick(self):
        with self.assertRaises(woodlouse.WoodlouseError) as caught:
            self.verified(dict(self.key(), tick=59))
        self.assertEqual(caught.exception.code, "protocol")

    def test_a_key_without_its_proof_or_with_rows_out_of_shape_is_no_key(self):
        for key in ({k: v for k, v in self.key().items() if k != "inputs"}, dict(self.key(), louse=[[1, 0, 2]]),
                    dict(self.key(), louse=[["1"] + self.ROWS[0][1:]])):
            with self.assertRaises(woodlouse.WoodlouseError) as caught:
                self.verified(key)
            self.assertEqual(caught.exception.code, "protocol")

    def test_fields_of_ones_own_cannot_be_verified(self):
        with self.assertRaises(ValueError):
            woodlouse.connect("127.0.0.1:1", fields=["x"], verify=True)


if __name__ == "__main__":
    unittest.main()
