# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# canmatrix_judge.py FILE.dbc: what Debian's canmatrix says of the signals of frames, as a judge of
# the page.
"""stdin: JSON [{"id", "extended", "data"}], data as long as the message, in hexadecimal;
stdout: for each a JSON object of raw values as text by the signal's name; a signal that is not
there is not in it."""
import json
import pathlib
import struct
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "sim" / "python"))
import dbc_statements
import dbc_to_json


def raw_text(signal, decoded):
    """The bits of a float as an integer, others as they are."""
    raw = decoded.raw_value
    if not signal.is_float:
        return str(raw)
    pack, unpack = (">f", ">I") if signal.size == 32 else (">d", ">Q")
    return str(struct.unpack(unpack, struct.pack(pack, raw))[0])


def main():
    text, _ = dbc_statements.decoded(pathlib.Path(sys.argv[1]).read_bytes())
    places = dbc_statements.Places()
    given = [s for s in dbc_statements.relevant(dbc_statements.statements(text)) if places.keep(*s)]
    database = dbc_to_json.load(given)
    frames = {(f.arbitration_id.id, bool(f.arbitration_id.extended)): f for f in database.frames}
    answers = []
    for wanted in json.load(sys.stdin):
        frame = frames[wanted["id"], wanted["extended"]]
        signals = {signal.name: signal for signal in frame.signals}
        values = frame.decode(bytes.fromhex(wanted["data"]))
        answers.append({name: raw_text(signals[name], value) for name, value in values.items()})
    json.dump(answers, sys.stdout)


main()
