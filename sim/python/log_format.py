# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# log_format: recordings in python-can's formats, to and from lines of a candump log with nine
# decimals ("-" is no interface). Times pass through python-can as short numbers of seconds since a
# whole millisecond, so that its floats cannot round them.
"""usage: log_format.py read|write asc|blf|csv|sqlite <IN >OUT"""
import base64
import collections
import decimal
import io
import logging
import pathlib
import re
import struct
import sys
import tempfile
import time

from verican_helper import BadInput, need, refusals, run

with refusals():
    can = need("can", "python3-can")
SECOND = 1_000_000_000
MILLISECOND = 1_000_000
ERROR_FLAG = 0x20000000  # SocketCAN's mark of an error message


class Kept(io.BytesIO):
    """A file whose bytes outlive the writer that closes it."""

    def close(self):
        self.seek(0)


# -- lines ------------------------------------------------------------------------------------

def stamp(nanoseconds):
    """(1436509052.249713000)"""
    return f"({nanoseconds // SECOND}.{nanoseconds % SECOND:09d})"


def frame_text(message, number, raw_dlc):
    """A message as candump writes it; `raw_dlc` is the DLC of the bus."""
    data = bytes(message.data)
    if message.is_error_frame:
        return f"{ERROR_FLAG | message.arbitration_id & 0x1FFFFFFF:08X}#{data[:8].hex().upper()}"
    if not 0 <= message.arbitration_id <= (0x1FFFFFFF if message.is_extended_id else 0x7FF):
        raise BadInput(f"message {number}: identifier {message.arbitration_id:X} is not allowed; "
                       f"allowed: 11 bits, extended 29 bits")
    head = f"{message.arbitration_id:0{8 if message.is_extended_id else 3}X}#"
    if message.is_fd or len(data) > 8 and len(data) == raw_dlc:  # CSV and SQLite mark no CAN FD
        flags = message.bitrate_switch | message.error_state_indicator << 1
        return f"{head}#{flags:X}{data.hex().upper()}"
    if not 0 <= raw_dlc <= 15 or len(data) != min(raw_dlc, 8) and not message.is_remote_frame:
        raise BadInput(f"message {number}: DLC {raw_dlc} with {len(data)} bytes; allowed: 0 to 15 "
                       f"and as many bytes, up to 8")
    body = f"R{min(raw_dlc, 8)}" if message.is_remote_frame else data.hex().upper()
    return head + body + (f"_{raw_dlc:X}" if raw_dlc > 8 else "")


def line_of(nanoseconds, message, number, raw_dlc, directed=True):
    """A message as a line of the log."""
    if nanoseconds < 0:
        raise BadInput(f"message {number}: time {decimal.Decimal(nanoseconds) / SECOND:f} s is not "
                       f"allowed; allowed: 0 s or later")
    known = isinstance(message.channel, int) and message.channel >= 0
    channel = f"can{message.channel}" if known else "-"
    way = (" R" if message.is_rx else " T") if directed and not message.is_error_frame else ""
    return f"{stamp(nanoseconds)} {channel} {frame_text(message, number, raw_dlc)}{way}\n"


def parse_line(line, base):
    """A line of the log as a message, its time in seconds since `base`."""
    when, channel, text, *way = line.split()
    head, _, tail = text.partition("#")
    number = int(head, 16)
    message = can.Message(
        timestamp=(nanoseconds_of(when) - base) / SECOND, arbitration_id=number & 0x1FFFFFFF,
        is_extended_id=len(head) == 8, is_rx=way != ["T"],
        channel=int(channel[3:]) if channel != "-" else None)
    if number & ERROR_FLAG:
        message.is_error_frame, message.is_extended_id = True, False
    elif tail.startswith("#"):
        message.is_fd = True
        message.bitrate_switch = bool(int(tail[1], 16) & 1)
        message.error_state_indicator = bool(int(tail[1], 16) & 2)
        tail = tail[2:]
    elif tail.startswith("R"):
        message.is_remote_frame = True
    body, _, raw_dlc = tail.partition("_")
    message.data = bytearray() if message.is_remote_frame else bytearray.fromhex(body)
    length = int(body[1:] or "0") if message.is_remote_frame else len(message.data)
    message.dlc = int(raw_dlc, 16) if raw_dlc else length
    return message


def nanoseconds_of(when):
    """The time of a line."""
    seconds, _, fraction = when.strip("()").partition(".")
    return int(seconds) * SECOND + int(fraction)


# -- readers: each yields (nanoseconds, message, DLC of the bus), None for what is passed over, and
# -- warnings

class AscLines:
    """The lines of an ASC file for python-can, which loses the first line of a file that says
    nothing of internal events, takes any line that it does not know for the end of the header, does
    not count what it passes over, and takes times since the event before ("timestamps relative")
    for times since the start."""
    HEADER = re.compile(r"(date|base)\b")
    NO_EVENT = re.compile(r"$|//|(date|base|begin|end)\b|(no\s+)?internal\s+events\b|"
                          r".*start of measurement$")

    def __init__(self, data):
        self.lines = as_text(data).splitlines(keepends=True)
        self.date = ""
        self.date_line = ""
        self.number = 0
        self.events = 0
        self.relative = False
        self.now = decimal.Decimal(0)

    def __iter__(self):
        body = False
        for self.number, line in enumerate(self.lines, 1):
            text = line.strip().lower()
            if text.startswith(("date ", "begin triggerblock ")):
                self.date_line = f"line {self.number}: '{line.strip():.60}'"
                self.date = line.split(None, 3 if text.startswith("begin") else 2)[-1].strip()
            if not body and re.match(r"\d|begin", text):
                body = True
                yield "no internal events logged\n"
            if not self.NO_EVENT.match(text):
                self.events += 1
            if text.startswith("base") and not re.match(r"base\s+(hex|dec)\b", text):
                raise BadInput(f"line {self.number}: '{line.strip():.60}'; allowed: base hex, "
                               f"base dec")
            if body or self.HEADER.match(text):
                yield self.absolute(line)

    def absolute(self, line):
        """The line with the time since the start."""
        if header := re.match(r"(\s*base\s+\w+\s+timestamps\s+)relative\b", line, re.IGNORECASE):
            self.relative = True
            return header[1] + "absolute" + line[header.end():]
        event = re.match(r"\s*(-?\d+(\.\d*)?)(?=\s)", line)
        if not self.relative or not event:
            return line
        self.now += decimal.Decimal(event[1])
        return f"{self.now}{line[event.end():]}"

    def read(self):
        """Only says that this is a file."""

    write = read

    def close(self):
        """Nothing to close."""


class AscReader(can.io.ASCReader):
    """python-can's reader, which takes half a byte, as a file that is cut short has it, for a byte
    and leaves out what is more than the length; here both are refused. It takes a request to send
    for the frame, whatever is not "Rx" for a direction and whatever is not "r" for data, and knows
    no DLC of a remote frame that is a letter."""

    def _process_classic_can_frame(self, line, msg_kwargs):
        words = line.split()
        if line.strip()[:10].lower() == "errorframe":
            return super()._process_classic_can_frame(line, msg_kwargs)
        if not is_frame(words) or len(words) > 2 and words[2].lower() not in ("d", "r"):
            return None
        message = super()._process_classic_can_frame(line, msg_kwargs)
        message.is_rx = words[1].lower() == "rx"
        if message.is_remote_frame:
            message.dlc = self._remote_dlc(words[3:])
        return message

    def _process_fd_can_frame(self, line, msg_kwargs):
        words = line.split()
        if not is_frame(words):
            return None
        message = super()._process_fd_can_frame(line, msg_kwargs)
        message.is_rx = words[1].lower() == "rx"
        return message

    def _remote_dlc(self, words):
        """The DLC behind "r", where other words may follow or stand instead."""
        digits = "[0-9A-Fa-f]+" if self.base == "hex" else "[0-9]+"
        if not words or not re.fullmatch(digits, words[0]):
            return 0
        return int(words[0], 16 if self.base == "hex" else 10)

    def _process_data_string(self, data_str, data_length, msg_kwargs):
        hexadecimal = self.base == "hex"
        byte = re.compile("[0-9A-Fa-f]{2}" if hexadecimal else "[0-9]{1,3}")
        words = data_str.split()
        for word in words[:data_length]:
            if not byte.fullmatch(word):
                raise BadInput(f"line {self.file.number}: data byte '{word:.40}'; allowed: "
                               f"{'two hexadecimal digits' if hexadecimal else '0 to 255'}")
        # Behind the data of CAN FD there are other numbers.
        if "is_fd" not in msg_kwargs and any(map(byte.fullmatch, words[data_length:][:1])):
            raise BadInput(f"line {self.file.number}: more data than length {data_length}; "
                           f"allowed: as many bytes")
        super()._process_data_string(data_str, data_length, msg_kwargs)


def is_frame(words):
    """Whether an event of ASC is a frame, or one that is cut short: of a request to send (TxRq)
    another one tells when it is sent."""
    return len(words) < 3 or words[1].lower() in ("rx", "tx")


def read_asc(data):
    """ASC: times since the date of the header, or of the trigger block."""
    lines = AscLines(data)
    reader = AscReader(lines)
    count = 0
    for message in reader:
        count += 1
        # For classical data frames python-can makes a length of CAN FD of a DLC above 8.
        length = not message.is_fd and not message.is_remote_frame
        dlc = can.util.len2dlc(message.dlc) if length else message.dlc
        yield (asc_origin(lines.date) or 0) + round(message.timestamp * SECOND), message, dlc
    yield from [None] * (lines.events - count)
    if lines.date and asc_origin(lines.date) is None:
        yield (f"{lines.date_line} has no date that can be read, so times count from 1970; "
               f"allowed: date Fri Mar 8 09:41:17.123 am 2024")


def asc_origin(date):
    """A date of ASC in nanoseconds; None if it cannot be read."""
    seconds_of = can.io.ASCReader._datetime_to_timestamp  # pylint: disable=protected-access
    try:
        try:
            seconds = seconds_of(date)
        except TypeError:  # newer python-can asks for a time zone; None is that of the computer
            seconds = seconds_of(date, None)
        return round(seconds * 1000) * MILLISECOND
    except (ValueError, OverflowError):
        return None


def check_size(data, size):
    """BadInput if a file has fewer bytes than its header says."""
    if size > len(data):
        raise BadInput(f"cut short: {len(data)} bytes where its header says {size}")


class BlfReader(can.io.BLFReader):
    """python-can's reader, which takes a request to send for a frame that was received, and the
    length of a CAN FD frame for the DLC of a classical one in objects 100 and 101. Here requests
    are passed over and counted, and `dlcs` has the DLC of each message that the reader yields."""
    OBJECT = struct.Struct("<4sHHLL")  # "LOBJ", size of the header, its version, size, type
    HEADERS = {1: 32, 2: 40}           # bytes of both headers by version
    # Where a direction lies behind the header; in the byte of flags it is the lower half.
    DIRECTIONS = {1: 2, 86: 2, 100: 2, 101: 34}
    # Where a DLC lies; that of an error message (73) is not looked at.
    DLCS = {1: 3, 73: 0, 86: 3, 100: 3, 101: 1}
    REQUEST = 2

    def __init__(self, file):
        super().__init__(file)
        self.requests = 0
        self.dlcs = collections.deque()

    def _parse_data(self, data):
        return super()._parse_data(self.without_requests(bytearray(data)))

    def without_requests(self, data):
        """`data` with requests as objects of a type that nobody knows. An object that goes on in
        the next container comes again with it."""
        at = data.find(b"LOBJ", 0, 8)
        while at >= 0 and at + self.OBJECT.size <= len(data):
            _, _, version, size, kind = self.OBJECT.unpack_from(data, at)
            if size < self.OBJECT.size:
                raise BadInput(f"object of {size} bytes; allowed: {self.OBJECT.size} or more")
            if at + size <= len(data) and version in self.HEADERS:
                body = bytes(data[at + self.HEADERS[version]:at + size]).ljust(40, b"\0")
                if kind in self.DIRECTIONS and \
                        body[self.DIRECTIONS[kind]] & 0x0F == self.REQUEST:
                    self.requests += 1
                    data[at + 12:at + 16] = bytes(4)
                elif kind in self.DLCS:
                    self.dlcs.append(body[self.DLCS[kind]])
            at = data.find(b"LOBJ", at + size, at + size + 8)
        return data


def read_blf(data):
    """BLF: nanoseconds since the millisecond of the header."""
    reader = BlfReader(io.BytesIO(data))
    check_size(data, reader.file_size)
    origin = round(reader.start_timestamp * 1000) * MILLISECOND
    reader.start_timestamp = 0.0
    for message in reader:
        yield origin + round(message.timestamp * SECOND), message, reader.dlcs.popleft()
    yield from [None] * reader.requests


def read_csv(data):
    """python-can's own CSV."""
    text = as_text(data)
    for number, line in enumerate(io.StringIO(text), 1):
        if number > 1:
            check_row(number, line)
    return read_floats(can.io.CSVReader(io.StringIO(text)))


def check_row(number, line):
    """BadInput for what python-can takes for something else in line `number` of a CSV file: flags
    that are neither 0 nor 1, and data that is not all base64."""
    columns = line.strip().split(",")
    if len(columns) != 7:
        return  # python-can refuses it
    for name, value in zip(("extended", "remote", "error"), columns[2:5]):
        if value not in ("0", "1"):
            raise BadInput(f"line {number}: {name} is '{value:.40}'; allowed: 0 or 1")
    try:
        base64.b64decode(columns[6], validate=True)
    except ValueError as error:
        raise BadInput(f"line {number}: data '{columns[6]:.40}'; allowed: base64") from error


def read_sqlite(data):
    """python-can's database; SQLite opens files by name only, and reads what is missing at the end
    as zeros."""
    page = int.from_bytes(data[16:18], "big")
    check_size(data, (65536 if page == 1 else page) * int.from_bytes(data[28:32], "big"))
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "log.db"
        path.write_bytes(data)
        yield from read_floats(can.io.SqliteReader(str(path)))


def read_floats(reader):
    """Seconds as floating-point numbers: what they hold is microseconds since the epoch, or
    nanoseconds since a start that is weeks away."""
    for message in reader:
        digits = 9 if abs(message.timestamp) < 1e6 else 6
        exact = round(round(message.timestamp, digits) * 10 ** digits) * 10 ** (9 - digits)
        yield exact, message, message.dlc


# -- writers ------------------------------------------------------------------------------------

def write_asc(lines, base):
    """ASC, whose header is made here: python-can's has the time of writing, and takes the first
    frame's time for the smallest."""
    file = io.StringIO()
    file.close = lambda: None
    writer = can.io.ASCWriter(file)
    local = time.strftime("%a %b %d %I:%M:%S.{:03d} %p %Y", time.localtime(base // SECOND))
    date = local.format(base // MILLISECOND % 1000)
    file.write(f"Begin Triggerblock {date}\n")
    writer.header_written = True
    writer.log_event("Start of measurement", 0.0)
    for line in lines:
        message = parse_line(line, base)
        writer.channel = (message.channel or 0) + 1  # of error frames
        writer.on_message_received(message)
    writer.stop()
    return re.sub(r"\Adate .*", f"date {date}", file.getvalue()).encode()


def write_blf(lines, base):
    """BLF; the writer cuts its times to nanoseconds, so they get half of one more."""
    file = Kept()
    writer = can.io.BLFWriter(file)
    writer.start_timestamp = 0.0
    last = 0.0
    for line in lines:
        message = parse_line(line, base)
        message.timestamp += 0.5 / SECOND
        last = max(last, message.timestamp)
        writer.on_message_received(message)
    writer.start_timestamp = base / SECOND
    writer.stop_timestamp = base / SECOND + last
    writer.stop()
    return file.getvalue()


def write_csv(lines, _base):
    """python-can's own CSV."""
    file = io.StringIO()
    file.close = lambda: None
    writer = can.io.CSVWriter(file)
    for line in lines:
        writer.on_message_received(parse_line(line, 0))
    writer.stop()
    return file.getvalue().encode()


def write_sqlite(lines, _base):
    """python-can's database."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "log.db"
        writer = can.io.SqliteWriter(str(path))
        for line in lines:
            writer.on_message_received(parse_line(line, 0))
        # stop() drops what its thread has not yet taken from the buffer.
        thread = writer._writer_thread  # pylint: disable=protected-access
        while thread.is_alive() and not writer.buffer.empty():
            time.sleep(0.001)
        writer.stop()
        return path.read_bytes()


# -- the program --------------------------------------------------------------------------------

def as_text(data):
    """Text files of other systems: UTF-8, else Latin-1."""
    try:
        return data.decode()
    except UnicodeDecodeError:
        return data.decode("latin-1")


def read(name, data):
    """All messages as lines. Whatever python-can raises means that the file is damaged."""
    reader = {"asc": read_asc, "blf": read_blf, "csv": read_csv, "sqlite": read_sqlite}[name]
    lines, warnings, skipped = [], [], 0
    try:
        for item in reader(data):
            if item is None:
                skipped += 1
            elif isinstance(item, str):
                text = "".join(c if c.isprintable() else "?" for c in item)
                warnings.append(f"# warning {text}\n")
            else:
                lines.append(line_of(*item[:2], len(lines) + 1, item[2], name in ("asc", "blf")))
    except BadInput:
        raise
    except Exception as error:  # pylint: disable=broad-except
        raise BadInput(f"damaged behind message {len(lines)}: {type(error).__name__} {error} "
                       f"(python-can)") from error
    return f"# skipped {skipped}\n" + "".join(warnings + lines)


def write(name, data):
    """The file that holds the lines."""
    writer = {"asc": write_asc, "blf": write_blf, "csv": write_csv, "sqlite": write_sqlite}[name]
    lines = data.decode().splitlines()
    earliest = min((nanoseconds_of(line.split(None, 1)[0]) for line in lines), default=0)
    return writer(lines, earliest // MILLISECOND * MILLISECOND)


def main(arguments):
    """`read` or `write`."""
    logging.disable()  # python-can's own remarks
    way, name = arguments
    return {"read": read, "write": write}[way](name, sys.stdin.buffer.read())


run(main)
