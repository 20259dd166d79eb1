# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""CANopen as far as the robot needs it, on both sides: NMT, heartbeat, SYNC, PDO, EMCY, SDO upload
(CiA 301). The devices of sw/canopennode do the same with CANopenNode."""
import struct

from network import Node

NMT, SYNC, EMCY, TPDO, HEARTBEAT = 0x000, 0x080, 0x080, 0x180, 0x700
SDO_ANSWER, SDO_REQUEST = 0x580, 0x600
BOOT, STOPPED, OPERATIONAL, PRE_OPERATIONAL = 0, 4, 5, 127
COMMANDS = {1: OPERATIONAL, 2: STOPPED, 128: PRE_OPERATIONAL}
BUS_OFF, RESTARTED = 0x40, 0x100           # classes of error messages
RECOVERED = 0x8140                         # EMCY: recovered from bus-off
TOGGLE_ERROR, UNKNOWN, NO_OBJECT = 0x05030000, 0x05040001, 0x06020000


class Device(Node):
    """A slave: on_sync(event) when OPERATIONAL, rpdo: {id: function(data)}, objects:
    {(i, s): bytes}."""

    def __init__(self, network, name, number, reaction, heartbeat):
        super().__init__(network, name)
        self.number, self.reaction, self.period = number, reaction, heartbeat
        self.state, self.objects, self.rpdo = BOOT, {}, {}
        self.late = 0  # SYNCs that found the TPDO before still waiting
        self._upload, self._toggle = None, 0
        self.after(1e-3 + number * 1e-5, self._boot)

    def _boot(self):
        self.send(HEARTBEAT + self.number, bytes([BOOT]))
        self.state = PRE_OPERATIONAL
        self.after(self.period, self._beat)

    def _beat(self):
        self.send(HEARTBEAT + self.number, bytes([self.state]))
        self.after(self.period, self._beat)

    def on_message(self, identifier, data):
        if identifier == NMT:
            if data[1] in (0, self.number):
                self.state = COMMANDS.get(data[0], self.state)
        elif identifier == SDO_REQUEST + self.number and self.state != STOPPED:
            answer = self._serve(data)
            self.after(self.reaction(), lambda: self.send(SDO_ANSWER + self.number, answer))
        elif self.state == OPERATIONAL:
            if identifier == SYNC:
                sync = self.now
                self.after(self.reaction(), lambda: self.on_sync(sync))
            elif identifier in self.rpdo:
                self.rpdo[identifier](data)

    def on_sync(self, event):
        """A SYNC was received at `event`."""

    def on_error(self, message):
        if message.id & BUS_OFF:
            self.state = STOPPED  # cannot be heard; what it does after that is the application's
        if message.id & RESTARTED:
            self.state = PRE_OPERATIONAL
            self.send(EMCY + self.number, struct.pack("<HB5x", RECOVERED, 0x11))

    # ---- SDO server: uploads

    def _serve(self, request):
        command, index, sub = struct.unpack_from("<BHB", request)
        if command == 0x40:
            data = self.objects.get((index, sub))
            if data is None:
                return self._abort(index, sub, NO_OBJECT)
            self._upload, self._toggle = data, 0
            return struct.pack("<BHBI", 0x41, index, sub, len(data))
        if command & 0xE0 != 0x60 or self._upload is None:
            return self._abort(0, 0, UNKNOWN)
        if (command >> 4) & 1 != self._toggle:
            self._upload = None
            return self._abort(0, 0, TOGGLE_ERROR)
        part, self._upload = self._upload[:7], self._upload[7:]
        head = self._toggle << 4 | (7 - len(part)) << 1 | (not self._upload)
        self._toggle ^= 1
        if not self._upload:
            self._upload = None
        return bytes([head]) + part.ljust(7, b"\0")

    @staticmethod
    def _abort(index, sub, code):
        return struct.pack("<BHBI", 0x80, index, sub, code)


class Uploader:
    """SDO client: uploads an object again and again, a request each `period`."""

    def __init__(self, host, number, index, period, expected):
        self.host, self.number, self.index, self.period = host, number, index, period
        self.expected, self.completed, self.wrong = expected, 0, 0
        self._data, self._toggle, self._size = b"", 0, None

    def start(self):
        self._size = None
        self.host.send(SDO_REQUEST + self.number, struct.pack("<BHB4x", 0x40, self.index, 0))

    def on_answer(self, data):
        if self._size is None:
            command, _, _, size = struct.unpack("<BHBI", data)
            self.wrong += command != 0x41
            self._data, self._toggle, self._size = b"", 0, size
        else:
            self.wrong += (data[0] >> 4) & 1 != self._toggle
            self._toggle ^= 1
            self._data += data[1:8 - (data[0] >> 1 & 7)]
            if data[0] & 1:
                self.completed += 1
                self.wrong += self._data != self.expected or len(self._data) != self._size
                self.host.after(self.period, self.start)
                return
        request = bytes([0x60 | self._toggle << 4]).ljust(8, b"\0")
        self.host.after(self.period, lambda: self.host.send(SDO_REQUEST + self.number, request))
