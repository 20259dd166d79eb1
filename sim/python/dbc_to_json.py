# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# dbc_to_json: a DBC file on stdin to JSON on stdout, for sim/signals/database_json.cpp.
"""Debian's canmatrix parses. What it cannot read is refused, and so is what no frame can hold:
{"error": {"line": 12, "message": "..."}}."""
import contextlib
import io
import json
import logging
import re
import sys

from dbc_checks import StatementChecks, check_message
from dbc_statements import DbcError, FORMS, Places, decoded, relevant, statements
from verican_helper import need, run


J1939_CODE = "3"  # of VFrameFormat, where the file does not name its values


class Complaints(logging.Handler):
    """Whether canmatrix has found a mistake: it says so on stdout or in its log, and goes on."""

    def __init__(self):
        super().__init__(logging.ERROR)
        self.printed = io.StringIO()
        self.logged = False

    def emit(self, record):
        self.logged = True

    def any(self):
        return self.logged or bool(self.printed.getvalue())


class Lines:
    """The statements for canmatrix, which is asked about each before it gets the next."""

    def __init__(self, given, complaints):
        self.given = given
        self.complaints = complaints

    def __iter__(self):
        for line, keyword, text in self.given:
            yield text.encode()
            if self.complaints.any():
                raise DbcError(line, f"not understood: {text}; allowed: {FORMS[keyword]}")


def load(given):
    """The database of the statements `given`, as canmatrix sees it."""
    complaints = Complaints()
    logger = logging.getLogger()
    logger.handlers = [complaints]
    logger.setLevel(logging.CRITICAL)  # it warns of formats that it could not load
    dbc = need("canmatrix.formats.dbc", "python3-canmatrix")
    logger.setLevel(logging.ERROR)
    with contextlib.redirect_stdout(complaints.printed):
        try:
            return dbc.load(Lines(given, complaints), dbcImportEncoding="utf-8")
        except DbcError:
            raise
        except Exception as error:  # canmatrix fails with whatever Python makes of a bad value
            raise DbcError(0, f"not understood by canmatrix: {error!r}") from error


def is_j1939(frame, database):
    """A message that stands for its parameter group, whatever priority and addresses."""
    if not frame.arbitration_id.extended:
        return False
    kind = frame.attribute("VFrameFormat", db=database)
    if kind is not None:
        return kind in ("J1939PG", J1939_CODE)
    return "J1939" in (database.attribute("ProtocolType") or "")


def multiplexing(signal, frame):
    """What must be in which other signal for this one to be there; None: it always is."""
    if signal.mux_val_grp:
        return {"signal": signal.muxer_for_signal, "ranges": signal.mux_val_grp}
    if signal.mux_val is None:
        return None
    names = [other.name for other in frame.signals if other.is_multiplexer]
    return {"signal": names[0] if len(names) == 1 else None,
            "ranges": [[signal.mux_val, signal.mux_val]]}


def unescaped(text):
    """The text of a string of the file, in which a backslash stands before a quotation mark and
    before another backslash. Of choices canmatrix has taken the former away already."""
    return re.sub(r'\\(["\\])', r"\1", text)


def signal_json(signal, frame, database):
    return {"name": signal.name,
            "start": signal.get_startbit(bit_numbering=1),
            "length": signal.size,
            "little_endian": signal.is_little_endian,
            "signed": signal.is_signed,
            "float": signal.is_float,
            "factor": str(signal.factor),
            "offset": str(signal.offset),
            "minimum": str(signal.min),
            "maximum": str(signal.max),
            "unit": unescaped(signal.unit),
            "start_value": str(signal.attribute("GenSigStartValue", db=database, default="0")),
            "choices": sorted((raw, unescaped(text)) for raw, text in signal.values.items()),
            "multiplexer": signal.is_multiplexer,
            "multiplexed": multiplexing(signal, frame)}


def message_json(frame, database):
    return {"name": frame.name,
            "id": frame.arbitration_id.id,
            "extended": frame.arbitration_id.extended,
            "length": frame.size,
            "j1939": is_j1939(frame, database),
            "signals": [signal_json(signal, frame, database) for signal in frame.signals]}


def to_json(data):
    places = Places()
    text, is_utf8 = decoded(data)
    given = [s for s in relevant(statements(text)) if places.keep(*s)]
    places.finish()
    StatementChecks().check(given)
    if not places.messages:
        raise DbcError(0, "no message in it; allowed: a DBC file with BO_ and SG_")
    database = load(given)
    messages = []
    for frame in database.frames:
        message = message_json(frame, database)
        check_message(message, places)
        messages.append(message)
    return {"messages": messages} if is_utf8 else {"messages": messages, "text": text}


def work(_):
    try:
        result = to_json(sys.stdin.buffer.read())
    except DbcError as error:
        result = {"error": {"line": error.line, "message": error.message}}
    return json.dumps(result)


if __name__ == "__main__":
    run(work)
