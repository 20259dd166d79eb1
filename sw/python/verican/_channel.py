# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""A bus of RTL nodes with a thread that runs it, for programs of several threads."""
import atexit
import collections
import concurrent.futures
import contextlib
import os
import threading
import time

from ._bus import Bus

STRETCH_BITS = 256  # simulated between two looks at the programs
LAST_FRAMES = 0.1   # s of simulated time for what waits when the last user leaves
IDLE_LOOK = 0.02    # s; an idle bus follows real time in such steps

SETTINGS = {"nodes": 2, "bitrate": 500_000, "restart_ms": 0, "vcd": ""}  # of a channel
RANGES = {"nodes": (1, 64), "bitrate": (1000, 1_000_000), "restart_ms": (0, 1_000_000_000)}


class ChannelError(RuntimeError):
    """The channel is closed, or its thread has failed."""


class Channel:
    """Frames go in by send(), messages come out by the `deliver` of each node's user.

    Frames of a user that has left stay in its node's queue; their echoes go to nobody. What the
    thread raises ends it: each user's `fail` is called, and whoever asks for anything later gets a
    ChannelError.

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
        self._users = {}  # by node: deliver and fail
        self._under_way = dict.fromkeys(self.nodes, 0)  # frames sent whose echo has not come
        self._former = dict.fromkeys(self.nodes, 0)     # of them: those of users that have left
        self._failure = None
        self._work = collections.deque()
        self._wake = threading.Event()
        self._closing = False
        self._epoch = time.time()
        self._offset = self._bus.started_ps / 1e12
        self._thread = threading.Thread(target=self._run, name=f"verican {name}", daemon=True)
        _living.add(self)
        self._thread.start()

    # ---- For the nodes' users

    def join(self, deliver, fail):
        """Takes a free node, whose messages go to deliver(message, time); None if all are taken.
        fail() is called when the thread ends by an exception."""
        free = [node for node in self.nodes if node not in self._users]
        if not free:
            return None

        def work(_):  # behind the last frames of the user before
            self._former[free[0]] = self._under_way[free[0]]
            self._users[free[0]] = deliver, fail
        self.call(work)
        return free[0]

    def leave(self, node):
        """The node stays on the bus and acknowledges."""
        del self._users[node]

    @property
    def used(self):
        return bool(self._users)

    def send(self, node, frame):
        def work(bus):
            bus.send(node, frame)
            self._under_way[node] += 1
        self._do(work)

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
                    raise self._gone() from self._failure

    def close(self):
        self._closing = True
        self._wake.set()
        self._thread.join()
        try:
            if self._failure is None:
                self._work_off()
                self._bus.run_until_quiet(LAST_FRAMES)
        finally:
            _living.discard(self)
            self._bus.finish()

    def leave_to_parent(self):
        """In a process that was forked: it has no copy of the thread."""
        self._fail(ChildProcessError("this process was forked from the one that runs the bus"))

    def _gone(self):
        """What to raise when the thread does no work any more."""
        why = "is closed" if self._failure is None else f"has failed: {self._failure!r}"
        return ChannelError(f"channel {self.name!r} {why}")

    # ---- The thread

    def _do(self, work):
        if self._failure is not None:
            raise self._gone() from self._failure
        self._work.append(work)
        self._wake.set()

    def _work_off(self):
        while self._work:
            self._work.popleft()(self._bus)

    def _run(self):
        try:
            self._serve()
        except BaseException as failure:
            self._fail(failure)
            raise  # threading.excepthook shows where it was

    def _fail(self, failure):
        self._failure = failure
        for _, fail in list(self._users.values()):
            fail()

    def _serve(self):
        while not self._closing:
            if self._bus.settled and not self._work:
                self._wake.wait(IDLE_LOOK)
                self._follow()
            self._wake.clear()
            self._work_off()
            if not self._bus.settled:
                self._bus.step(bits=STRETCH_BITS)
                self._give()

    def _follow(self):
        """In small steps: after `disturb` idle time costs CPU, and where it costs more than it
        lasts the way to the host's time grows while it is gone; whoever calls does not wait for
        its end. One step comes before any work: frames that come one by one have their times."""
        while not self._closing:
            behind = time.time() - self._epoch - self._bus.now
            if behind <= 0:
                return
            self._bus.pass_time(min(behind, IDLE_LOOK))
            self._give()
            if self._work:
                return

    def _give(self):
        self._bus.frames()  # nobody reads these here
        self._bus.events()
        for node in self.nodes:
            messages = self._bus.receive(node)
            deliver, _ = self._users.get(node, (None, None))
            for message in messages:
                if self._is_of_user(node, message) and deliver:
                    deliver(message, self._epoch + message.time_ps / 1e12 - self._offset)

    def _is_of_user(self, node, message):
        """False for the echo of a frame that a user before had sent: frames leave in the order in
        which they were queued."""
        if not message.echo:
            return True
        self._under_way[node] -= 1
        if self._former[node] == 0:
            return True
        self._former[node] -= 1
        return False


_channels = {}
_living = set()  # channels that have not ended, also those whose close() was interrupted
_lock = threading.Lock()


def open_channel(name, deliver, fail, **wanted):
    """(channel, node), see Channel.join(); the first to open it decides what the bus is like.
    `wanted`: some of SETTINGS; None is no wish."""
    wanted = {what: value for what, value in wanted.items() if value is not None}
    with _lock:
        channel = _channels.get(name)
        if channel is None:
            channel = Channel(name, SETTINGS | wanted)
        for what, value in wanted.items():
            there = channel.settings[what]
            if value != there:
                raise ValueError(f"channel {name!r} is open with {what}={there!r}, not {value!r}")
        node = channel.join(deliver, fail)
        if node is None:
            raise ValueError(f"all {len(channel.nodes)} nodes of channel {name!r} are taken; the "
                             "first to open it says how many there are: nodes=...")
        _channels[name] = channel
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
            for channel in list(_living):
                stack.callback(channel.close)
            _channels.clear()


def leave_all_to_parent():
    """In a process that was forked; what it opens is its own."""
    for channel in _living:
        channel.leave_to_parent()
    _living.clear()
    _channels.clear()
    _lock.release()


os.register_at_fork(before=_lock.acquire, after_in_parent=_lock.release,
                    after_in_child=leave_all_to_parent)


def open_names():
    with _lock:
        return list(_channels)
