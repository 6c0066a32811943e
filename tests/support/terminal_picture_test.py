"""terminal_picture.py draws what a terminal shows: colours, block elements, and a text at its place.

usage: terminal_picture_test.py     with Debian's own Python, python3-pyte and python3-pil
"""
import os
import subprocess
import sys
import tempfile
import unittest

from PIL import Image

TOOL = os.path.join(os.path.dirname(os.path.abspath(__file__)), "terminal_picture.py")
# A red upper half over blue, a green cell by reverse video, a wide character, an X; then it waits for Ctrl-C.
SHOWN = r"\033[?25l\033[38;2;250;10;20;48;2;10;20;250m\342\226\200\033[0;32;7m \033[0m\346\274\242X; \033[6n"


class Picture(unittest.TestCase):
    def test_cells_are_painted_where_and_as_they_are(self):
        with tempfile.TemporaryDirectory() as folder:
            png, txt = os.path.join(folder, "a.png"), os.path.join(folder, "a.txt")
            subprocess.run([sys.executable, TOOL, "--size", "20x4", "--press", f"until=X; shot={png} shot={txt}", "--",
                            "sh", "-c", f"stty -echo; printf '{SHOWN}'; exec sleep 60"], check=True, timeout=30,
                           stdout=subprocess.DEVNULL)
            image = Image.open(png).convert("RGB")
            self.assertEqual(image.size, (160, 64))
            self.assertEqual(image.getpixel((3, 3)), (250, 10, 20))
            self.assertEqual(image.getpixel((3, 12)), (10, 20, 250))
            self.assertEqual(image.getpixel((12, 8)), (0, 205, 0))
            ink = [(x, y) for x in range(32, 40) for y in range(16) if sum(image.getpixel((x, y))) > 450]
            self.assertTrue(ink, "no X in its cell")
            with open(txt, encoding="utf-8") as file:
                self.assertEqual(file.readline(), "\u2580 \u6f22X;\n")

    def test_a_program_that_ends_is_told_with_its_screen(self):
        done = subprocess.run([sys.executable, TOOL, "--press", "wait=20", "--", "sh", "-c", "echo no such map"],
                              capture_output=True, text=True, timeout=30)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("no such map", done.stderr)


if __name__ == "__main__":
    unittest.main()
