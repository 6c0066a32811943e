"""The page's files, as they are served: named by a hash and kept, packed, and nothing of another folder."""

import os
import re
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "server"))
from web_test import WebServer  # noqa: E402


class Page(unittest.TestCase):
    def test_the_page_brings_its_files_along_and_is_asked_for_once(self):
        with WebServer() as server:
            status, headers, page = server.ask("GET", "/")
            script = re.search(r'src="(/[0-9a-f]{16}/page\.js)"', page)
            if script is None:
                self.skipTest("the server was built without the page")
            self.assertEqual((status, headers["Cache-Control"]), (200, "no-cache"))
            self.assertEqual(server.ask("GET", "/", **{"If-None-Match": headers["ETag"]})[::2], (304, ""))
            status, headers, text = server.ask("GET", script[1])
            self.assertEqual((status, headers["Content-Type"]), (200, "text/javascript; charset=utf-8"))
            self.assertIn("immutable", headers["Cache-Control"])
            names = set(re.findall(r'["`]\./([A-Za-z0-9_/-]+\.js)["`]', text))
            self.assertGreaterEqual(names, {"picture/bake.js", "core/recording_worker.js"})
            # Behind the first picture; what is wanted by few behind that.
            whole = [name for name in names if name.startswith("parts/whole-")]
            self.assertEqual(len(whole), 1, names)
            named = re.findall(r'["`]\./(later-[A-Za-z0-9_-]+\.js)["`]', server.ask("GET", script[1].replace("page.js", whole[0]))[2])
            self.assertTrue(named)
            names |= {"parts/" + name for name in named}
            for name in names | set(re.findall(r'modulepreload" href="/[0-9a-f]{16}/([^"]+)"', page)):
                self.assertEqual(server.ask("HEAD", script[1].replace("page.js", name))[0], 200, name)
            core = script[1].replace("page.js", "core.wasm")
            packed = server.ask("HEAD", core, **{"Accept-Encoding": "gzip"})[1]
            self.assertEqual((packed["Content-Encoding"], packed["Content-Type"]), ("gzip", "application/wasm"))
            self.assertLess(int(packed["Content-Length"]), 350_000)
            self.assertEqual(server.ask("GET", "/0123456789abcdef/page.js")[0], 404)

    def test_a_folder_is_served_and_nothing_outside_of_it(self):
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "index.html"), "w", encoding="utf-8") as file:
                file.write("<!doctype html>mine")
            os.symlink("/etc/passwd", os.path.join(folder, "users.txt"))
            with WebServer("--web-root", folder) as server:
                self.assertEqual(server.ask("GET", "/")[::2], (200, "<!doctype html>mine"))
                for path in ("/users.txt", "/../../etc/passwd", "/%2e%2e/etc/passwd", "//etc/passwd", "/.", "/index.html/"):
                    self.assertEqual(server.ask("GET", path)[0], 404, path)


if __name__ == "__main__":
    unittest.main()
