# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""python-can's interface "verican": each can.Bus is a node of a bus of RTL nodes in process."""
import contextlib
import queue
import threading
import time

import can

from ._channel import ChannelError, close_channel, open_channel, open_names
from ._core import Frame

ALLOWED = "bitrate, can_filters, error_frames, nodes, receive_own_messages, restart_ms, vcd"
QUEUED = 4096        # frames of a can.Bus that may wait for the bus
INBOX = 65_536       # messages that may wait for its program
LOOK = 0.05          # s between two looks whether a full queue will ever empty
FLUSH_BITS = 20_000  # of the bus in which a frame has to leave, or flush_tx_buffer() gives up

STATES = {"active": can.BusState.ACTIVE, "passive": can.BusState.PASSIVE,
          "bus-off": can.BusState.ERROR}


def number(what, value):
    """Configuration files have texts."""
    try:
        whole = None if value is None else int(value)
    except (TypeError, ValueError, OverflowError) as error:
        raise ValueError(f"{what} {value!r}: a whole number is allowed") from error
    if isinstance(value, float) and whole != value:
        raise ValueError(f"{what} {value!r}: a whole number is allowed")
    return whole


def flag(what, value):
    """The same for what is on or off, of which any text would count as on."""
    words = {"true": True, "yes": True, "on": True, "1": True,
             "false": False, "no": False, "off": False, "0": False}
    if isinstance(value, str):
        value = words.get(value.lower(), value)
    if value not in (True, False):
        raise ValueError(f"{what} {value!r}: true or false is allowed")
    return bool(value)


class VericanBus(can.BusABC):
    """can.Bus(interface="verican", channel="name", bitrate=..., nodes=...).

    `dropped` counts messages that came while INBOX others waited for recv().
    """

    def __init__(self, channel="verican0", can_filters=None, bitrate=None, nodes=None,
                 receive_own_messages=False, error_frames=True, restart_ms=None, vcd=None, fd=False,
                 single_handle=True, **unknown):
        """`channel`: any name; buses with the same name in this process share the wire.

        `nodes` (2) and `bitrate` (500000) are decided by the first to open the channel, and so are
        `restart_ms`, simulated time from bus-off to the begin of recovery (0: by `state`), and
        `vcd`, a waveform; who names another value later is refused. Nodes that no can.Bus uses
        acknowledge. `single_handle`, which python-can's tools give to every interface, means
        nothing here. can.CanInitializationError: settings that do not exist or cannot be.
        """
        if unknown:
            raise can.CanInitializationError(
                f"{', '.join(unknown)}: no setting of this interface; allowed: {ALLOWED}")
        if fd:
            raise can.CanInitializationError(
                "fd: the nodes are CAN 2.0 cores, which know no CAN FD; allowed: fd=False")
        self._inbox = queue.SimpleQueue()
        self._room = threading.BoundedSemaphore(QUEUED)
        self.dropped = 0
        self.channel, self._open = channel, False
        try:
            self._own = flag("receive_own_messages", receive_own_messages)
            self._errors = flag("error_frames", error_frames)
            self._channel, self.node = open_channel(
                channel, self._deliver, self._wake, nodes=number("nodes", nodes),
                bitrate=number("bitrate", bitrate), restart_ms=number("restart_ms", restart_ms),
                vcd=None if vcd is None else str(vcd))
        except (TypeError, ValueError, RuntimeError) as error:
            raise can.CanInitializationError(str(error)) from error
        self._open = True
        self.channel_info = f"verican {channel}: {self.node}"
        super().__init__(channel=channel, can_filters=can_filters)

    def send(self, msg, timeout=None):
        """Queues the frame; waits for room in the queue for at most `timeout` s (None: for ever).

        can.CanOperationError: no room, bus-off, no frame of classical CAN, or the channel has
        failed.
        """
        self._check_open()
        if msg.is_fd or msg.is_error_frame:
            raise can.CanOperationError("the nodes send data and remote frames of classical CAN")
        try:
            frame = Frame(msg.arbitration_id, b"" if msg.is_remote_frame else bytes(msg.data),
                          msg.is_extended_id, msg.is_remote_frame, msg.dlc)
        except (TypeError, ValueError) as error:
            raise can.CanOperationError(str(error)) from error
        self._wait_for_room(timeout)
        with self._errors_of_channel():
            self._channel.send(self.node, frame)

    def _wait_for_room(self, timeout):
        end = None if timeout is None else time.monotonic() + timeout
        while True:
            left = LOOK if end is None else min(LOOK, end - time.monotonic())
            if self._room.acquire(timeout=max(left, 0)):
                return
            if self.state == can.BusState.ERROR:
                raise can.CanOperationError(f"{self.channel_info} is bus-off, its queue is full")
            if end is not None and time.monotonic() >= end:
                raise can.CanOperationError(f"no room in the queue for {timeout} s")

    def _recv_internal(self, timeout):
        self._check_open()
        try:
            if timeout is not None and timeout <= 0:
                message = self._inbox.get_nowait()
            else:
                message = self._inbox.get(timeout=timeout)
        except queue.Empty:
            return None, False
        if message is None:  # stays there, for whoever asks again or waits too
            self._wake()
            self._check_open()
            self._call(lambda bus: None)  # raises what has happened
        return message, False

    def _wake(self):
        """Whoever waits in recv() looks what has happened."""
        self._inbox.put(None)

    def _deliver(self, message, when):
        if message.echo:
            self._room.release()
        if (message.echo and not self._own) or (message.error and not self._errors):
            return
        if self._inbox.qsize() >= INBOX:  # the newest is lost, as in a socket of the kernel
            self.dropped += 1
            return
        self._inbox.put(can.Message(  # has no DLC above 8; nor has it from a socket
            timestamp=when, arbitration_id=message.id, is_extended_id=message.extended,
            is_remote_frame=message.remote, is_error_frame=message.error, dlc=min(message.dlc, 8),
            data=message.data, channel=self.channel, is_rx=not message.echo))

    @contextlib.contextmanager
    def _errors_of_channel(self):
        try:
            yield
        except ChannelError as error:
            raise can.CanOperationError(str(error)) from error

    def _call(self, function):
        with self._errors_of_channel():
            return self._channel.call(function)

    @property
    def state(self):
        """Error active, passive, or ERROR for bus-off. Setting ACTIVE begins the recovery."""
        return STATES[self.node_state.state]

    @state.setter
    def state(self, new_state):
        if new_state != can.BusState.ACTIVE:
            raise NotImplementedError("BusState.ACTIVE alone can be set; errors lead to the others")
        self._check_open()
        self._call(lambda bus: bus.restart(self.node))

    @property
    def node_state(self):
        """State with the error counters, `tec` and `rec`."""
        self._check_open()
        return self._call(lambda bus: bus.state(self.node))

    def disturb(self, effect, bits, after=0, everybody=False):
        """From `after` bits on this node's receiver, or everybody's, sees another level for `bits`:
        flip, dominant or recessive."""
        self._check_open()
        node = "" if everybody else self.node
        self._call(lambda bus: bus.disturb(
            effect, bus.now + after * bus.bit_time, bits * bus.bit_time, node))

    def flush_tx_buffer(self):
        """Waits until all frames have left; no longer if the node is bus-off. None is discarded.

        can.CanTimeoutError: FLUSH_BITS have passed on the bus and none has left, as happens where
        nobody acknowledges.
        """
        self._check_open()
        waited_for, since = None, 0
        while True:
            pending, bits = self._call(
                lambda bus: (bus.pending(self.node), bus.now / bus.bit_time))
            if pending == 0 or self.state == can.BusState.ERROR:
                return
            if pending != waited_for:
                waited_for, since = pending, bits
            elif bits - since > FLUSH_BITS:
                raise can.CanTimeoutError(
                    f"{self.channel_info}: none of {pending} that wait has left for "
                    f"{FLUSH_BITS} bits")
            time.sleep(1e-3)

    def shutdown(self):
        super().shutdown()
        if self._open:
            self._open = False
            self._wake()
            close_channel(self._channel, self.node)

    def _check_open(self):
        if not self._open:
            raise can.CanOperationError("this bus has been shut down")

    @staticmethod
    def _detect_available_configs():
        return [{"interface": "verican", "channel": name} for name in open_names()]
