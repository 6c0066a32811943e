"""What the client's tests share: a real terminal (tmux), a client in it, a server. Standard library only."""

import os
import re
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

BIN = os.environ["WOODLOUSE_BIN"]  # the folder of woodlouse and woodlouse-server
MAPS = os.environ["WOODLOUSE_MAPS"]
LOOK = "--color mono --glyphs ascii --view map --steer heading"
PATIENCE = 15.0  # seconds for anything to appear; the machine may be busy


def wait_for(what, predicate, patience=PATIENCE):
    """The first true value of predicate(), which is asked again and again."""
    end = time.monotonic() + patience
    while True:
        value = predicate()
        if value:
            return value
        if time.monotonic() > end:
            raise AssertionError(f"waited {patience} s in vain for {what}")
        time.sleep(0.03)


def children_of(pid):
    """Its children's names (the kernel's 15 characters) by pid."""
    children = {}
    for entry in os.listdir("/proc"):
        if not entry.isdigit():
            continue
        try:
            with open(f"/proc/{entry}/stat") as stat:
                name, rest = stat.read().split("(", 1)[1].rsplit(")", 1)
        except (FileNotFoundError, ProcessLookupError):
            continue  # ended while we looked
        if int(rest.split()[1]) == pid:
            children[int(entry)] = name
    return children


def alive(pid):
    try:
        with open(f"/proc/{pid}/stat") as stat:
            return stat.read().rsplit(")", 1)[1].split()[0] != "Z"
    except (FileNotFoundError, ProcessLookupError):
        return False


class Terminal:
    """A shell in a tmux of its own."""

    def __init__(self, columns=80, rows=24):
        self.folder = tempfile.mkdtemp(prefix="woodlouse-e2e-")
        self.socket = os.path.join(self.folder, "tmux")
        data = os.path.join(self.folder, ".local/share/woodlouse")
        os.makedirs(data)
        with open(os.path.join(data, "lesson"), "w") as mark:  # which would lie over the picture
            mark.write("done\n")
        environment = {k: v for k, v in os.environ.items()
                       if not k.startswith(("WOODLOUSE_", "TMUX", "XDG_CONFIG", "XDG_DATA")) and k != "NO_COLOR"}
        environment.update(TERM="xterm-256color", HOME=self.folder, PS1="$ ", LC_ALL="C.UTF-8")
        subprocess.run(["tmux", "-S", self.socket, "-f", "/dev/null", "new-session", "-d", "-x", str(columns),
                        "-y", str(rows), "sh"], env=environment, check=True, cwd=self.folder)
        self.shell = int(self.tmux("display", "-p", "#{pane_pid}"))

    def close(self):
        subprocess.run(["tmux", "-S", self.socket, "kill-server"], stderr=subprocess.DEVNULL)
        shutil.rmtree(self.folder, ignore_errors=True)

    def tmux(self, *arguments):
        return subprocess.run(["tmux", "-S", self.socket, *arguments], check=True, capture_output=True,
                              text=True).stdout.rstrip("\n")

    def keys(self, *keys):
        self.tmux("send-keys", *keys)

    def type(self, text):
        self.tmux("send-keys", "-l", text)

    def run(self, command):
        self.type(command)
        self.keys("Enter")

    def screen(self):
        return self.tmux("capture-pane", "-p")

    def shows(self, pattern, patience=PATIENCE):
        regex = re.compile(pattern)
        try:
            return wait_for(pattern, lambda: regex.search(self.screen()), patience)
        except AssertionError as error:
            raise AssertionError(f"{error}; the screen:\n{self.screen()}") from None

    def resize(self, columns, rows):
        self.tmux("resize-window", "-x", str(columns), "-y", str(rows))

    def state(self):
        """Alternate screen and cursor, as tmux sees them: '0 1' is a shell's."""
        return self.tmux("display", "-p", "#{alternate_on} #{cursor_flag}")

    def stty(self):
        """Every setting of the terminal, asked from inside it."""
        answer = os.path.join(self.folder, f"stty-{time.monotonic_ns()}")
        self.run(f"stty -a > {answer}.part; mv {answer}.part {answer}")
        wait_for("stty", lambda: os.path.exists(answer))
        with open(answer) as file:
            return re.sub(r"rows \d+; columns \d+", "", file.read())

    def process(self, name):
        """The pid of the shell's child of that name, or 0."""
        return next((pid for pid, comm in children_of(self.shell).items() if comm == name), 0)


class InATerminal(unittest.TestCase):
    def setUp(self):
        self.terminal = Terminal()
        self.addCleanup(self.terminal.close)

    def start(self, arguments="--name mara", look=LOOK):
        """Starts the client with a server of its own; waits until it plays. Returns (client, server) pids.
        The Space that ends the introduction is nothing to the game."""
        self.before = self.terminal.stty()
        self.terminal.run(f"{BIN}/woodlouse {look} {arguments}")
        self.terminal.shows(r"Any key starts")
        self.terminal.keys("Space")
        self.terminal.shows("(YOU|ROOM) [-\N{BOX DRAWINGS LIGHT HORIZONTAL}]")
        wait_for("the alternate screen", lambda: self.terminal.state().startswith("1"))
        client = wait_for("the client", lambda: self.terminal.process("woodlouse"))
        server = next(pid for pid, comm in children_of(client).items() if comm.startswith("woodlouse-serve"))
        return client, server

    def play(self):
        pids = self.start()
        self.terminal.shows(r"@")
        self.assertNotIn("cruise", self.line_of("push"))
        return pids

    def line_of(self, label):
        """The panel's line that begins with a label."""
        found = re.search(rf"\|\s+{label}\b.*", self.terminal.screen())
        return found.group(0) if found else ""

    def way(self):
        """How far the own louse has travelled, in metres, as the panel shows it."""
        found = re.search(r"way\s+([\d.]+) m", self.terminal.screen())
        return float(found.group(1)) if found else None

    def own_cell(self):
        """Column and row of the '@' on the map."""
        for row, line in enumerate(self.terminal.screen().splitlines()[1:22], 1):
            column = line[:46].find("@")
            if column >= 0:
                return column, row
        return None

    def assert_given_back(self, server):
        wait_for("the shell's screen", lambda: self.terminal.state() == "0 1")
        self.assertEqual(self.terminal.stty(), self.before)
        wait_for("the end of the local server", lambda: not alive(server))

    def exit_code(self):
        wait_for("the end of the client", lambda: not self.terminal.process("woodlouse"))
        self.terminal.run("echo code=$?.")
        return int(self.terminal.shows(r"code=(\d+)\.").group(1))


class Server:
    """A woodlouse-server of the test's own."""

    def __init__(self, port=0, options=()):
        self.process = subprocess.Popen(
            [f"{BIN}/woodlouse-server", "--map", f"{MAPS}/volcano.json", "--listen", f"127.0.0.1:{port}", "--bots", "2",
             *options],
            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.address = self.process.stdout.readline().split()[1]

    def stop(self, by=signal.SIGTERM):
        self.process.send_signal(by)
        self.process.wait(timeout=10)
        self.process.stdout.close()
