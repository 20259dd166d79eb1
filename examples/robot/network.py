# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Programs on the nodes of a bus of RTL controllers, in simulated time: what happens next is either
a message of a node or an appointment of a program, and the bus runs exactly up to it."""
import heapq
import itertools


class Node:
    """The software of a node: on_message(id, data), on_error(message)."""

    def __init__(self, network, name):
        self.network, self.name = network, name

    @property
    def now(self):
        """Simulated time, s: of the event that is handled."""
        return self.network.now

    def send(self, identifier, data=b"", event=None):
        """Queues a frame. `event`: the moment that it belongs to, from which its response
        counts."""
        self.network.send(self.name, identifier, data, self.now if event is None else event)

    def at(self, when, act):
        """Calls act() at a time."""
        self.network.at(when, act)

    def after(self, delay, act):
        """Calls act() after a time."""
        self.network.at(self.now + delay, act)

    def on_message(self, identifier, data):
        """A frame of another node."""

    def on_error(self, message):
        """An error message in SocketCAN's form: message.id its class, message.data."""


class Network:
    """The bus and the programs. What was sent and when is in `sent`: (name, id, event, end)."""

    def __init__(self, bus, frame):
        self.bus, self._frame = bus, frame
        self.nodes, self.sent, self.now = {}, [], 0.0
        self._appointments, self._order = [], itertools.count()
        self._waiting = {}  # (name, id): events of the frames that have not left

    def add(self, node):
        self.nodes[node.name] = node
        return node

    def at(self, when, act):
        heapq.heappush(self._appointments, (when, next(self._order), act))

    def send(self, name, identifier, data, event):
        self._waiting.setdefault((name, identifier), []).append(event)
        self.bus.send(name, self._frame(identifier, bytes(data)))

    @property
    def waiting(self):
        """Frames that have not left."""
        return sum(map(len, self._waiting.values()))

    def run(self, until):
        """Runs bus and programs up to a time."""
        while True:
            due = min(until, self._appointments[0][0] if self._appointments else until)
            if due > self.bus.now:
                self.bus.run_until_message(due - self.bus.now)
            self._deliver()
            # A message may have come first; its answer may be due first.
            while self._appointments and self._appointments[0][0] <= self.bus.now + 1e-12:
                when, _, act = heapq.heappop(self._appointments)
                self.now = max(when, self.now)
                act()
            if self.bus.now >= until - 1e-12:
                return

    def _deliver(self):
        arrived = []
        for name, node in self.nodes.items():
            for message in self.bus.receive(name):
                when = (message.time_ps - self.bus.started_ps) / 1e12
                arrived.append((when, next(self._order), node, message))
        for when, _, node, message in sorted(arrived, key=lambda item: item[:2]):
            self.now = when
            if message.echo:
                self._left(node.name, message.id, when)
            elif message.error:
                node.on_error(message)
            else:
                node.on_message(message.id, message.data)

    def _left(self, name, identifier, when):
        event = self._waiting[name, identifier].pop(0)
        self.sent.append((name, identifier, event, when))
