# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Frames of the client of can_remote and the wait for their answers; what nodes say of themselves.

verican_remote.py is what to import.
"""
import errno
import time
from dataclasses import dataclass

import can

ALL = 1
OPERATE, SAFE, RESTART = 0x01, 0x02, 0x81
CODES = {0x01: "illegal function", 0x02: "illegal address", 0x03: "illegal value", 0x05: "open",
         0x06: "busy", 0x10: "protected", 0x11: "locked", 0x12: "sequence", 0x13: "time-out",
         0x14: "aborted"}
BUSY, OPEN, SEQUENCE, TIMEOUT, ABORTED = 0x06, 0x05, 0x12, 0x13, 0x14

READ, WRITE, BLOCK, DATA, SETUP, STATUS, IDENT = 0, 1, 2, 3, 4, 6, 7
STATEMENT, END = 0x400, 0x1000
ROW_STATUS, ROW_IDENT = 0xFF0, 0xFF8
SKIP = 0.01
SEND, RETRY = 1.0, 0.0002


class RemoteError(Exception):
    """Something went wrong between the client and a node."""


class Timeout(RemoteError):
    """No answer, after all tries."""


class Refused(RemoteError):
    """The node said no; `code` says why. `number` is the node's, `address` where the part of a
    read or write began that was refused (else None); what comes before has been done."""

    def __init__(self, code, number=None, address=None):
        at = "" if address is None else f" at 0x{address:03X}"
        who = "" if number is None else f"node {number} refuses{at}: "
        super().__init__(f"{who}code {code:02X}, {CODES.get(code, 'unknown')}")
        self.code, self.number, self.address = code, number, address


class NotTaken(RemoteError):
    """A node is there, but does not take the number that it is given."""


class InUse(RemoteError):
    """Another node has the number; nothing was assigned."""


class TooMany(RemoteError):
    """More nodes answer a scan than can be: something on the bus answers every SELECT."""


class Sequence(RemoteError):
    """A block transfer lost frames, in every try."""


class BusOff(RemoteError):
    """The host itself is off the bus, or its interface is gone."""


@dataclass
class Status:
    """What a node says of itself."""
    state: int  # 0 INIT, 1 LISTEN, 2 SAFE, 3 OPERATE
    unlocked: bool
    error_passive: bool
    duplicate: bool  # it has heard its number from another node since the last CLEAR
    stale: bool      # a statement it waits for is late
    watchdog: bool
    bus_off: bool    # since the last CLEAR
    tec: int
    rec: int
    code: int        # of the last request that was counted,
    a: int           # and its A
    accepted: int    # modulo 256
    refused: int     # modulo 256
    trigger: int     # count of the last TRIGGER

    @classmethod
    def of(cls, row):
        """From the eight bytes of the row."""
        return cls(row[0] & 3, *(bool(row[0] >> bit & 1) for bit in range(2, 8)), *row[1:])


@dataclass
class Identity:
    """What a node is. Of a node without a number (0), or one that shares its number with others
    (`doubled`; None: one of several such numbers), only the serial number is known."""
    number: int
    serial: int
    version: int = 0
    features: int = 0
    name_bits: int = 0
    memory: int = 0
    stage: int = 0
    doubled: bool = False

    @classmethod
    def of(cls, number, row):
        """From the eight bytes of the row."""
        return cls(number, int.from_bytes(row[4:8], "little"), row[0], row[1], row[2] >> 4,
                   1 << (row[2] & 15), row[3])


@dataclass
class Answer:
    """What answers a request: identifier, length, and the first bytes, which are the request's."""
    id: int
    dlc: int
    head: bytes = b""

    def fits(self, message):
        return (not message.is_remote_frame and message.arbitration_id == self.id
                and message.dlc == self.dlc and bytes(message.data).startswith(self.head))

    def bytes_of(self, message):
        return bytes(message.data)[len(self.head):]


HERE = Answer(0x402, 0)


class Link:
    """Frames, identifiers, and the wait for answers."""

    def __init__(self, bus, name_bits=3, rtr="auto", timeout=0.15, select_wait=0.05, tries=3,
                 on_statement=None):
        """`rtr`: "always", "never" (all is read by the port READ), or "auto": where the interface
        can send remote frames. Times in seconds. `on_statement` gets what nobody waits for."""
        if name_bits not in (3, 5):
            raise ValueError(f"name_bits {name_bits}: allowed are 3 and 5")
        if rtr not in ("auto", "always", "never"):
            raise ValueError(f"rtr {rtr!r}: allowed are auto, always, never")
        for name, value in (("timeout", timeout), ("select_wait", select_wait)):
            if not value > 0:
                raise ValueError(f"{name} {value}: allowed are seconds above 0")
        if not isinstance(tries, int) or tries < 1:
            raise ValueError(f"tries {tries}: allowed are 1 and more")
        self.bus, self.name_bits, self.timeout = bus, name_bits, timeout
        self.select_wait, self.tries, self.on_statement = select_wait, tries, on_statement
        # python-can's socketcand writes every frame as a data frame, and takes, up to its
        # version 4.1, every one for an extended one.
        self._plain = type(bus).__module__.startswith("can.interfaces.socketcand")
        self.remote_frames = rtr == "always" or (rtr == "auto" and not self._plain)
        self.window = (1 << (10 - name_bits)) - 8
        self._refusals = {}
        self.here = False  # HERE has come

    def id(self, name, a):
        return name << (10 - self.name_bits) | a

    def port(self, number, port):
        return self.id(number, self.window + port)

    def require_node(self, number, *others):
        """`others` are numbers with a meaning of their own."""
        if number not in others and not 2 <= number < 1 << self.name_bits:
            also = "".join(f"{other}, " for other in others)
            raise ValueError(f"number {number}: allowed are {also}2 to "
                             f"{(1 << self.name_bits) - 1}")

    @staticmethod
    def require_serial(value):
        if not 0 <= value <= 0xFFFFFFFF:
            raise ValueError(f"serial number or mask {value}: allowed are 0 to 0xFFFFFFFF")

    @staticmethod
    def require_range(address, length):
        if not 0 <= address < END:
            raise ValueError(f"address {address}: allowed are 0 to 0xFFF")
        if not 1 <= length <= END - address:
            raise ValueError(f"{length} bytes from 0x{address:03X} on: allowed are 1 to "
                             f"{END - address}")

    @staticmethod
    def require_bytes(data):
        """`data` as bytes; of a number Python would make so many zeros."""
        if isinstance(data, int):
            raise ValueError(f"data {data}: allowed are bytes, as in b'\\x05'")
        return bytes(data)

    def send(self, identifier, data=b"", remote=None):
        message = can.Message(arbitration_id=identifier, is_extended_id=False, data=data)
        if remote is not None:
            message = can.Message(arbitration_id=identifier, is_extended_id=False,
                                  is_remote_frame=True, dlc=remote)
        until = time.monotonic() + SEND
        while not self._sent(message):
            if time.monotonic() >= until:
                raise Timeout("the interface has no room for a frame")
            time.sleep(RETRY)
        return message

    def _sent(self, message):
        """Whether the interface has taken it. python-can waits for room in the socket, not in the
        queue behind it, which may hold no more than ten frames."""
        try:
            self.bus.send(message, timeout=SEND)
        except (can.CanError, OSError) as error:
            if getattr(error, "error_code", None) == errno.ENOBUFS:
                return False
            raise BusOff(str(error)) from error
        return True

    def _receive(self, until):
        """The next base frame, or None if none comes until then. Others are passed over, for SKIP
        at least: what waits behind them is found."""
        patience = max(until, time.monotonic() + SKIP)
        while True:
            try:
                message = self.bus.recv(max(0.0, until - time.monotonic()))
            except (can.CanError, OSError) as error:  # OSError: socketcand's, of a server gone
                raise BusOff(str(error)) from error
            if message is None:
                return None
            if message.is_error_frame and message.arbitration_id & 0x40:
                raise BusOff("the interface says bus-off")
            base = not message.is_extended_id or (self._plain and message.arbitration_id < 0x800)
            if base and not message.is_error_frame:
                return message
            if time.monotonic() >= patience:
                return None

    def frames(self, seconds, look=False):
        """Base frames as they come, for so long (`look`: those that have come already). The first
        one is taken however late the client comes to look for it; behind it the time ends the wait
        on a bus on which a frame always waits, too."""
        until = time.monotonic() + seconds
        while (message := self._receive(0.0 if look else until)) is not None:
            yield message
            if time.monotonic() >= until:
                return

    def pass_on(self, message):
        """Nobody waits for this frame; what it tells of refusals is kept, and that it is HERE."""
        if HERE.fits(message):
            self.here = True
            return
        status = self._status_of(message)
        if status:
            self._refusals[status[0]] = message.data[6]
        if self.on_statement:
            self.on_statement(message)

    def flush(self):
        """What has come before answers nothing that is asked from now on."""
        for message in self.frames(self.timeout, look=True):
            self.pass_on(message)

    def _status_of(self, message):
        """(number, row) if it is STATUS as it follows a result."""
        number = (message.arbitration_id & 0x3FF) >> (10 - self.name_bits)
        if (message.is_remote_frame or message.dlc != 8
                or message.arbitration_id != self.port(number, STATUS) | STATEMENT):
            return None
        return number, bytes(message.data)

    def _refusal(self, number, request, message):
        """(code, certain) if this STATUS refuses the request. A heartbeat repeats the last code for
        ever: only the count of refused requests tells what is new."""
        status = self._status_of(message)
        if not status or status[0] != number:
            return 0, False
        row = status[1]
        a = request.arbitration_id & ((1 << (10 - self.name_bits)) - 1)
        known = number in self._refusals
        certain = known and self._refusals[number] != row[6]
        return (row[3], certain) if row[3] not in (0, OPEN) and row[4] == a and (
            certain or not known) else (0, False)

    def wait(self, number, request, frames, wanted, patient=()):
        """The first of `frames` that `wanted` says is one; Refused at once unless the code is in
        `patient`, then only after all of them; None."""
        suspected = 0
        for message in frames:
            if wanted(message):
                return message
            code, certain = self._refusal(number, request, message)
            suspected = code or suspected
            self.pass_on(message)
            if code and certain and code not in patient:
                break
        if suspected:
            raise Refused(suspected, number)
        return None

    def ask_once(self, number, answer, identifier, data=b"", remote=None):
        """Sends a request; the bytes of its answer, or None."""
        self.flush()
        request = self.send(identifier, data, remote)
        message = self.wait(number, request, self.frames(self.timeout), answer.fits)
        return None if message is None else answer.bytes_of(message)

    def ask(self, number, *request):
        """As ask_once(), several times if there is no answer or the node is busy; then Timeout."""
        for left in range(self.tries - 1, -1, -1):
            try:
                data = self.ask_once(number, *request)
            except Refused as refused:
                if refused.code != BUSY or left == 0:
                    raise
                continue
            if data is not None:
                return data
        raise Timeout(f"node {number} does not answer")

    def read_request(self, number, address, length):
        """How many bytes one frame brings; identifier, data and DLC of the request; its answer."""
        node = 0 if number == ALL else number
        if self.remote_frames and address < self.window:
            length = min(length, 8, self.window - address)
            identifier = self.id(number, address)
            answer = Answer(self.id(node, address) | STATEMENT, length)
            return length, (identifier, b"", length), answer
        length = min(length, 6)
        head = address.to_bytes(2, "little")
        answer = Answer(self.port(node, READ) | STATEMENT, length + 2, head)
        return length, (self.port(number, READ), head + bytes([length]), None), answer
