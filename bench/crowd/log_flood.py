"""One hostile client, as fast as it can: what makes a server write to its log."""
import itertools
import socket
import struct
import time

JOIN = b'{"type":"join","protocol":1,"name":"hostile"}\n'
VISITS = (
    b"",                                          # comes and goes
    b"]\n]\n]\n]\n",                              # three lines running that are not JSON
    JOIN,                                         # joins and breaks
    b"x" * 5000 + b"\n",                          # a line that is too long
    b'{"type":"join","protocol":99,"name":"a"}\n',
    JOIN + b'{"type":"chat","text":"a"}\n' * 600,  # a flood
    JOIN + b'{"type":"leave"}\n',
)


def visit(host, port, lines):
    client = socket.create_connection((host, port), 2.0)
    try:
        client.sendall(lines)
        client.settimeout(0.02)
        client.recv(1 << 12)
        if len(lines) > 100:
            time.sleep(0.005)
    except OSError:
        pass
    finally:
        client.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        client.close()


def log_bytes_per_second(server, seconds):
    """How fast the log grows, and how many visits a second did that."""
    before = server.log.stat().st_size
    begin = time.monotonic()
    visits = 0
    for lines in itertools.cycle(VISITS):
        if time.monotonic() >= begin + seconds:
            break
        try:
            visit(server.host, server.port, lines)
        except OSError:
            time.sleep(0.001)
        visits += 1
    took = time.monotonic() - begin
    time.sleep(0.5)  # the log is written behind
    return (server.log.stat().st_size - before) / took, visits / took
