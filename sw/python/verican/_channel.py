# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""A bus of RTL nodes with a thread that runs it, for programs of several threads."""
import atexit
import collections
import concurrent.futures
import contextlib
import threading
import time

from ._bus import Bus

STRETCH_BITS = 256  # simulated between two looks at the programs
LAST_FRAMES = 0.1   # s of simulated time for what waits when the last user leaves
IDLE_LOOK = 0.02    # s; an idle bus follows real time in such steps

SETTINGS = {"nodes": 2, "bitrate": 500_000, "restart_ms": 0, "vcd": ""}  # of a channel
RANGES = {"nodes": (1, 64), "bitrate": (1000, 1_000_000)}


class Channel:
    """Frames go in by send(), messages come out by the `deliver` of each node's user.

    Only the thread touches the bus; others hand it work. While something is under way the bus runs
    as fast as it can; an idle one follows real time, so that it is never behind by more than
    a look.
    """

    def __init__(self, name, settings):
        """`settings`: all of SETTINGS; ValueError if the bus cannot be."""
        for what, (least, most) in RANGES.items():
            if not least <= settings[what] <= most:
                raise ValueError(f"{what} {settings[what]}: {least} to {most} are allowed")
        self.name, self.settings = name, settings
        self.nodes = [f"node{i}" for i in range(settings["nodes"])]
        self._bus = Bus(self.nodes, bitrate=settings["bitrate"],
                        restart=settings["restart_ms"] / 1e3, vcd=settings["vcd"])
        self._users = {}
        self._work = collections.deque()
        self._wake = threading.Event()
        self._closing = False
        self._epoch = time.time()
        self._offset = self._bus.started_ps / 1e12
        self._thread = threading.Thread(target=self._run, name=f"verican {name}", daemon=True)
        self._thread.start()

    # ---- For the nodes' users

    def join(self, deliver):
        """Takes a free node, whose messages go to deliver(message, time); None if all are taken."""
        free = [node for node in self.nodes if node not in self._users]
        if free:
            self._users[free[0]] = deliver
        return free[0] if free else None

    def leave(self, node):
        """The node stays on the bus and acknowledges."""
        del self._users[node]

    @property
    def used(self):
        return bool(self._users)

    def send(self, node, frame):
        self._do(lambda bus: bus.send(node, frame))

    def call(self, function):
        """The result of function(bus), run between two stretches of simulation."""
        future = concurrent.futures.Future()

        def work(bus):
            try:
                future.set_result(function(bus))
            except Exception as error:  # goes to the caller, whatever it is
                future.set_exception(error)
        self._do(work)
        while True:
            try:
                return future.result(timeout=1)
            except concurrent.futures.TimeoutError:
                if not self._thread.is_alive():
                    raise RuntimeError(f"channel {self.name!r} is closed") from None

    def close(self):
        self._closing = True
        self._wake.set()
        self._thread.join()
        while self._work:
            self._work.popleft()(self._bus)
        self._bus.run_until_quiet(LAST_FRAMES)
        self._bus.finish()

    # ---- The thread

    def _do(self, work):
        self._work.append(work)
        self._wake.set()

    def _run(self):
        while not self._closing:
            if self._bus.settled and not self._work:
                self._wake.wait(IDLE_LOOK)
                self._follow()
            self._wake.clear()
            while self._work:
                self._work.popleft()(self._bus)
            if not self._bus.settled:
                self._bus.step(bits=STRETCH_BITS)
                self._give()

    def _follow(self):
        """In small steps: after `disturb` idle time costs CPU, and where it costs more than it
        lasts the way to the host's time grows while it is gone; whoever calls does not wait for
        its end."""
        while not (self._work or self._closing):
            behind = time.time() - self._epoch - self._bus.now
            if behind <= 0:
                return
            self._bus.pass_time(min(behind, IDLE_LOOK))
            self._give()

    def _give(self):
        self._bus.frames()  # nobody reads these here
        self._bus.events()
        for node in self.nodes:
            messages = self._bus.receive(node)
            deliver = self._users.get(node)
            if deliver:
                for message in messages:
                    deliver(message, self._epoch + message.time_ps / 1e12 - self._offset)


_channels = {}
_lock = threading.Lock()


def open_channel(name, deliver, **wanted):
    """(channel, node); the first to open it decides what the bus is like. `wanted`: some of
    SETTINGS; None is no wish."""
    wanted = {what: value for what, value in wanted.items() if value is not None}
    with _lock:
        channel = _channels.get(name)
        if channel is None:
            channel = _channels[name] = Channel(name, SETTINGS | wanted)
        for what, value in wanted.items():
            there = channel.settings[what]
            if value != there:
                raise ValueError(f"channel {name!r} is open with {what}={there!r}, not {value!r}")
        node = channel.join(deliver)
        if node is None:
            raise ValueError(f"all {len(channel.nodes)} nodes of channel {name!r} are taken; the "
                             "first to open it says how many there are: nodes=...")
        return channel, node


def close_channel(channel, node):
    """The bus ends with its last user."""
    with _lock:
        channel.leave(node)
        if channel.used or _channels.get(channel.name) is not channel:
            return
        del _channels[channel.name]
    channel.close()


@atexit.register
def close_all():
    """For programs that end without shutdown(): a thread that is within the simulation when the
    interpreter ends would abort the process."""
    with contextlib.ExitStack() as stack:  # goes on behind a file that cannot be written
        with _lock:
            for channel in _channels.values():
                stack.callback(channel.close)
            _channels.clear()


def open_names():
    with _lock:
        return list(_channels)
