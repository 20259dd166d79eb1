# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# dbc_checks: messages that a parser accepts and no frame can hold.
"""check_message(): DbcError for a signal that cannot be where or what the file says."""
import math

from dbc_statements import DbcError


def bits(signal):
    """First and last bit, counted in the order of the signal's bytes: bit 0 is the least
    significant of byte 0 in a little-endian signal, the most significant of byte 0 in a big-endian
    one."""
    start = signal["start"]
    if not signal["little_endian"]:
        start = start // 8 * 8 + 7 - start % 8
    return start, start + signal["length"] - 1


def signal_problem(signal, message):
    """What is wrong with a signal by itself; None: nothing."""
    if not 1 <= signal["length"] <= 64:
        return f"has {signal['length']} bits; allowed: 1 to 64"
    if signal["float"] and signal["length"] not in (32, 64):
        return f"is a floating-point number of {signal['length']} bits; allowed: 32, 64"
    if float(signal["factor"]) == 0:
        return "has the factor 0"
    for key in ("factor", "offset"):
        if not math.isfinite(float(signal[key])):
            return f"has the {key} {signal[key]}; allowed: a number that is not infinite"
    last = bits(signal)[1]
    if last >= 8 * message["length"]:
        return (f"does not fit the {message['length']} bytes of message {message['name']}: it "
                f"needs {last // 8 + 1}")
    return None


def multiplexer_problem(signal, by_name):
    """What is wrong with the multiplexing of a signal; None: nothing."""
    seen = set()
    while signal["multiplexed"]:
        if signal["name"] in seen:
            return "is multiplexed by itself"
        seen.add(signal["name"])
        name = signal["multiplexed"]["signal"]
        if name is None:
            return ("is multiplexed, but the message has no or more than one multiplexer (M); "
                    "allowed: one, or SG_MUL_VAL_ for each signal")
        signal = by_name.get(name)
        if signal is None or not signal["multiplexer"]:
            return f"is multiplexed by {name}, which is no multiplexer (M) of the message"
    return None


def check_message(message, places):
    """Throws if a signal of the message cannot be used."""
    by_name = {signal["name"]: signal for signal in message["signals"]}
    for signal in message["signals"]:
        problem = signal_problem(signal, message) or multiplexer_problem(signal, by_name)
        if by_name[signal["name"]] is not signal:
            problem = "is there twice"
        if problem:
            line = places.line_of(message["id"], message["extended"], signal["name"])
            raise DbcError(line, f"signal {signal['name']} {problem}")
