# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# dbc_checks: what a parser accepts, or fails at without naming a line, and no frame can hold.
"""check_message(): DbcError for a signal that cannot be where or what the file says.
StatementChecks: DbcError for a statement with a value that cannot be."""
import math
import re

from dbc_statements import DbcError, STRING, attribute_name, words_of

LONGEST_MESSAGE = 117440505  # bytes of J1939's extended transport protocol
NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?")
FLOAT_BITS = {"1": 32, "2": 64}  # of SIG_VALTYPE_
MOST_RAW = (1 << 64) - 1
LEAST_RAW = -(1 << 63)


class StatementChecks:
    """Checks the statements of a file in their order; definitions go before what refers to them."""

    def __init__(self):
        self.id = None
        self.lengths = {}        # (identifier, signal): bits
        self.texts = {}          # (identifier, signal, value): its text
        self.multiplexers = {}   # (identifier, signal): what SG_MUL_VAL_ names
        self.frame_formats = []  # what the file allows for VFrameFormat, if it is an enumeration
        self.checks = {"BO_": self.message, "SG_": self.signal, "VAL_": self.choices,
                       "SIG_VALTYPE_": self.value_type, "SG_MUL_VAL_": self.selection,
                       "BA_DEF_": self.definition, "BA_DEF_DEF_": self.default,
                       "BA_": self.attribute}

    def check(self, given):
        """Throws at the first statement that cannot be."""
        for line, keyword, text in given:
            words = words_of(text)
            problem = self.checks[keyword](text, words) if words else None
            if problem:
                raise DbcError(line, problem)

    def message(self, _, words):
        """BO_ <id> <name>: <bytes> <sender>"""
        self.id = words[0]
        if len(words) > 2 and words[2].isdecimal() and int(words[2]) > LONGEST_MESSAGE:
            return f"message {words[1]} has {words[2]} bytes; allowed: 0 to {LONGEST_MESSAGE}"
        return None

    def signal(self, text, words):
        """SG_ <name> [m<n>] : <start>|<length>@..."""
        length = re.search(r"\|\s*(\d+)\s*@", STRING.sub("", text))
        if length:
            self.lengths[self.id, words[0]] = int(length.group(1))
        selection = re.fullmatch(r"m(\d+)M?", words[1]) if len(words) > 1 else None
        if selection and int(selection.group(1)) > MOST_RAW:
            return f"signal {words[0]} has the selection {words[1]}; allowed: m0 to m{MOST_RAW}"
        return None

    def choices(self, _, words):
        """VAL_ <id> <signal> <value> "<text>" ..."""
        for value in words[2::2]:
            if re.fullmatch(r"[+-]?\d+", value) and not LEAST_RAW <= int(value) <= MOST_RAW:
                return (f"value {value} of signal {words[1]} is none of 64 bits; allowed: "
                        f"{LEAST_RAW} to {MOST_RAW}")
        for value, text in zip(words[2::2], words[3::2]):
            if self.texts.setdefault((*words[:2], value), text) != text:
                return f"value {value} of signal {words[1]} has another text already"
        return None

    def value_type(self, _, words):
        """SIG_VALTYPE_ <id> <signal> : <1 or 2>; 0 is not handed on."""
        if len(words) < 3:
            return None
        if words[2] not in FLOAT_BITS:
            return (f"signal {words[1]} has the value type {words[2]}; allowed: 0 (integer), "
                    "1 (float of 32 bits), 2 (float of 64 bits)")
        length = self.lengths.get((words[0], words[1]))
        if length != FLOAT_BITS[words[2]]:
            return (f"signal {words[1]} is a floating-point number of {length} bits; allowed with "
                    f"value type {words[2]}: {FLOAT_BITS[words[2]]}")
        return None

    def selection(self, _, words):
        """SG_MUL_VAL_ <id> <signal> <multiplexer> <first>-<last>, ..."""
        first = self.multiplexers.setdefault(tuple(words[:2]), words[2:3])
        if first != words[2:3]:
            return (f"signal {words[1]} is multiplexed by {' '.join(first)} already; allowed: one "
                    "multiplexer for a signal")
        for first, last in re.findall(r"(\d+)\s*-\s*(\d+)", " ".join(words[3:])):
            if int(first) > int(last) or int(last) > MOST_RAW:
                return (f"signal {words[1]} has the range {first}-{last}; allowed: from the "
                        f"smaller to the larger value, up to {MOST_RAW}")
        return None

    def definition(self, text, _):
        """BA_DEF_ BO_ "VFrameFormat" ENUM "<text>", ..."""
        if attribute_name(text) == "VFrameFormat" and re.search(r'"\s*ENUM\b', text):
            self.frame_formats = [string[1:-1] for string in STRING.findall(text)[1:]]

    @staticmethod
    def default(text, words):
        """BA_DEF_DEF_ "<name>" <value>; an empty string is none."""
        if attribute_name(text) == "GenSigStartValue" and words[1:] != ['""']:
            return start_value_problem(words[-1].strip('"'))
        return None

    def attribute(self, text, words):
        """BA_ "<name>" [SG_ <id> <signal> or BO_ <id>] <value>"""
        name = attribute_name(text)
        if name == "GenSigStartValue":
            return start_value_problem(words[-1])
        return self.frame_format_problem(words[-1]) if name == "VFrameFormat" else None

    def frame_format_problem(self, value):
        """Values are numbers, also where the file gives them names."""
        if value.isdecimal() and (not self.frame_formats or int(value) < len(self.frame_formats)):
            return None
        allowed = f"0 to {len(self.frame_formats) - 1}" if self.frame_formats else "0 or larger"
        return f"VFrameFormat {value} is not allowed; allowed: the numbers {allowed}"


def start_value_problem(value):
    """What is wrong with a start value; None: nothing."""
    if NUMBER.fullmatch(value):
        return None
    return f"GenSigStartValue {value} is not allowed; allowed: a number such as 5 or -0.5"


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
