"""A program that plays on until it is ended: it pushes, five times a second, and answers each ping.

    steady_player.py HOST PORT      prints its louse's id once it has answered a ping
"""
import json
import socket
import sys
import time


def main(host, port):
    connection = socket.create_connection((host, port), 20.0)
    lines = connection.makefile("rb")

    def send(**message):
        connection.sendall(json.dumps(message).encode() + b"\n")

    send(type="join", protocol=1, name="steady", state_hz=20)
    louse, seq, due, is_told = 0, 0, 0.0, False
    for line in lines:
        message = json.loads(line)
        if message["type"] == "welcome":
            louse = message["id"]
        if message["type"] == "ping":
            send(type="pong", t=message["t"])
            if not is_told:
                print(louse, flush=True)
                is_told = True
        if louse and time.monotonic() >= due:
            due = time.monotonic() + 0.2
            seq += 1
            send(type="input", seq=seq, thrust=[0.5, 0])


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]))
