# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""`verican bridge --socketcand` as a process, and a client that speaks the protocol by hand."""

import json
import os
import re
import signal
import socket
import struct
import subprocess
import tempfile

# Longest wait for anything; only a hanging bridge ever takes so long.
PATIENCE = 120


class Bridge:
    """The process. Options are those of the command line; the port is chosen by the kernel."""

    def __init__(self, *options, scenario=None, nodes=None, buses=("can0",), clients=0):
        self._directory = tempfile.TemporaryDirectory(prefix="verican-socketcand-")
        self.log = self.path("bus.log")
        command = [os.environ["VERICAN_BINARY"], "bridge", "--socketcand", "127.0.0.1:0"]
        command += ["--json", "--candump", self.log, "--wait-for-clients", str(clients)]
        for bus in buses:
            command += ["--bus-name", bus]
        if scenario is not None:
            with open(self.path("bus.yaml"), "w", encoding="ascii") as file:
                file.write(scenario)
            command += ["--bus", self.path("bus.yaml")]
        if nodes is not None:
            command += ["--nodes", str(nodes)]
        # pylint: disable-next=consider-using-with
        self.process = subprocess.Popen(command + list(options), stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, text=True)
        self.warnings = []
        line = self.process.stderr.readline()
        while line.startswith("verican: warning: "):
            self.warnings.append(line)
            line = self.process.stderr.readline()
        found = re.fullmatch(r"verican bridge: socketcand (.*) at 127\.0\.0\.1:(\d+)\n", line)
        if not found:
            self.process.kill()
            raise AssertionError(f"the bridge says {line!r} {self.process.stderr.read()!r}")
        self.port = int(found[2])

    def path(self, name):
        """A file in the bridge's own directory."""
        return os.path.join(self._directory.name, name)

    def __enter__(self):
        return self

    def __exit__(self, *exception):
        if self.process.poll() is None:
            self.process.kill()
        self.process.communicate()
        self._directory.cleanup()

    def stop(self, sign=signal.SIGTERM):
        """Asks for the end; the report. The exit code is to be 0."""
        self.process.send_signal(sign)
        return self.end()

    def end(self, code=0):
        """Waits for the end; the report."""
        out, error = self.process.communicate(timeout=PATIENCE)
        if self.process.returncode != code:
            raise AssertionError(f"exit code {self.process.returncode}: {error}")
        return json.loads(out)

    def frames(self):
        """The bridge's own log of the bus, as (identifier as it is written, data or 'R<dlc>')."""
        with open(self.log, encoding="ascii") as file:
            return [tuple(line.split()[2].split("#")) for line in file]


def as_logged(message):
    """A "frame" or "rtr" message as Bridge.frames() has it."""
    if message[0] == "rtr":
        return message[1], "R" + (message[3] if message[3] != "0" else "")
    return message[1], message[3] if len(message) > 3 else ""


class Client:
    """A client by hand. Messages are lists of words."""

    def __init__(self, port, *commands):
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=PATIENCE)
        self._bytes = b""
        self.expect("hi")
        for command in commands:
            self.send(command)
            self.expect("ok")

    def __enter__(self):
        return self

    def __exit__(self, *exception):
        self.socket.close()

    def send(self, command):
        """`command` without its brackets."""
        self.socket.sendall(f"< {command} >".encode("ascii"))

    def next(self):
        """The next message; None at the end of the connection."""
        while b">" not in self._bytes:
            piece = self.socket.recv(65536)
            if not piece:
                return None
            self._bytes += piece
        message, self._bytes = self._bytes.split(b">", 1)
        return message.decode("ascii").strip().removeprefix("<").split()

    def expect(self, *words):
        """The next message has to be this."""
        message = self.next()
        if message != list(words):
            raise AssertionError(f"expected {words}, got {message}")

    def frames(self, count):
        """The next `count` frames as Bridge.frames() has them; other messages are passed over."""
        frames = []
        while len(frames) < count:
            if (message := self.next()) is None:
                raise AssertionError(f"the connection ended after {len(frames)} of {count} frames")
            if message[0] in ("frame", "rtr"):
                frames.append(as_logged(message))
        return frames

    def frames_to_end(self):
        """All frames until the bridge ends the connection."""
        frames = []
        while (message := self.next()) is not None:
            if message[0] in ("frame", "rtr"):
                frames.append(as_logged(message))
        return frames

    def settle(self):
        """Sends an echo; error messages may come before its answer, nothing else."""
        self.send("echo")
        while (message := self.next()) != ["echo"]:
            if message is None or message[0] != "error" or len(message) != 4:
                raise AssertionError(f"expected nothing more, got {message}")

    def last_words(self):
        """The last message before the bridge has ended the connection."""
        words = []
        while (message := self.next()) is not None:
            words = message
        return " ".join(words)

    def close(self, reset=False):
        """Leaves; with a reset of the connection, as a program that crashes with unread data."""
        if reset:
            self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        self.socket.close()
