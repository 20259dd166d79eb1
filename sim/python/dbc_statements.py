# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# dbc_statements: the statements of a DBC file, each on one line, with the line where it begins.
"""canmatrix reads a file line by line and passes over what it does not know. So that nothing is
lost in silence, the file is cut into its statements first, and what is none is refused."""
import re


class DbcError(Exception):
    """Something in the file cannot be used; `line` counts from 1, 0: no line can be named."""

    def __init__(self, line, message):
        super().__init__(message)
        self.line = line
        self.message = message


# What messages and signals are made of, in the form that a refusal shows.
FORMS = {
    "BO_": "BO_ <id> <name>: <bytes> <sender>",
    "SG_": 'SG_ <name> [M, m<n> or m<n>M] : <start>|<length>@<0 or 1><+ or -> (<factor>,<offset>) '
           '[<minimum>|<maximum>] "<unit>" <receivers>',
    "VAL_": 'VAL_ <id> <signal> <value> "<text>" ... ;',
    "SIG_VALTYPE_": "SIG_VALTYPE_ <id> <signal> : <0, 1 or 2> ;",
    "SG_MUL_VAL_": "SG_MUL_VAL_ <id> <signal> <multiplexer> <first>-<last>, ... ;",
    "BA_DEF_": 'BA_DEF_ [BO_ or SG_] "<name>" <type> ... ;',
    "BA_DEF_DEF_": 'BA_DEF_DEF_ "<name>" <value> ;',
    "BA_": 'BA_ "<name>" [BO_ <id> or SG_ <id> <signal>] <value> ;',
}
# What says nothing about the content of frames.
IGNORED = frozenset(
    "VERSION NS_ NS_DESC_ BS_ BU_ BO_TX_BU_ CM_ VAL_TABLE_ EV_ EV_DATA_ ENVVAR_DATA_ SGTYPE_ "
    "SGTYPE_VAL_ SIGTYPE_VALTYPE_ SIG_TYPE_REF_ SIG_GROUP_ CAT_DEF_ CAT_ FILTER BA_DEF_REL_ "
    "BA_REL_ BA_DEF_DEF_REL_ BU_SG_REL_ BU_EV_REL_ BU_BO_REL_ BA_DEF_SGTYPE_ BA_SGTYPE_".split())
ENDED_BY_LINE = frozenset(["VERSION", "NS_", "BS_", "BO_", "SG_"])
KEYWORD = re.compile(r"\s*([A-Z][A-Z_]*)(?=[\s:\"])")
# The attributes that say something about the content of frames.
ATTRIBUTES = frozenset(["VFrameFormat", "ProtocolType", "GenSigStartValue",
                        "SystemMessageLongSymbol", "SystemSignalLongSymbol"])
EXTENDED = 1 << 31
WITH_ID = re.compile(
    r'^((?:BO_|VAL_|SIG_VALTYPE_|SG_MUL_VAL_|BA_\s+"[^"]*"\s+(?:BO_|SG_))\s+)(\d+)')
# What canmatrix passes over where it is not so; choices of a variable of the environment have no
# identifier.
SHAPES = {"SIG_VALTYPE_": re.compile(r"SIG_VALTYPE_ \d+ \w+ ?: ?-?\d+ ?;$"),
          "VAL_": re.compile(r"VAL_ (\D|\d+ \w+[ ;])")}
STRING = re.compile(r'"(?:\\.|[^"\\])*"')
WORD = re.compile(STRING.pattern + r'|[^\s:;"]+')


def decoded(data):
    """The text of a file, and whether it is UTF-8; else it is in the code page of Western Windows,
    which CANdb++ writes."""
    for encoding in ("utf-8-sig", "cp1252"):
        try:
            return data.decode(encoding), encoding != "cp1252"
        except UnicodeDecodeError:
            pass
    return data.decode("iso-8859-1"), False


def keyword_of(line):
    """The keyword that a line begins with, or None."""
    match = KEYWORD.match(line + " ")
    word = match and match.group(1)
    return word if word in FORMS or word in IGNORED else None


def outside_strings(text):
    """The text without the strings that end in it."""
    return STRING.sub("", text)


def words_of(text):
    """The words and strings of a statement behind its keyword."""
    return WORD.findall(text)[1:]


def one_blank(text):
    """With one blank where there are several outside strings."""
    return re.sub(STRING.pattern + r"|\s+",
                  lambda match: match.group() if match.group()[0] == '"' else " ", text)


class Splitter:
    """Cuts a text into statements: (line, keyword, text on one line)."""

    def __init__(self):
        self.statements = []
        self.keyword, self.parts, self.line = None, [], 0
        self.open = False      # a string has begun and not ended
        self.quoted = False    # there was a string
        self.in_names = False  # within the list of NS_

    def split(self, text):
        for number, line in enumerate(text.splitlines(), 1):
            self.take(number, line.strip())
        self.end()
        return self.statements

    def take(self, number, line):
        if self.keyword and not self.open and self.begins(line):
            self.end()  # without its semicolon, as many files have it
        if self.keyword is None:
            if not self.begins(line):
                self.pass_over(number, line)
                return
            self.keyword, self.parts, self.line = keyword_of(line), [], number
            self.quoted = False
            self.in_names = self.keyword == "NS_"
        self.parts.append(line)
        rest = outside_strings(('"' if self.open else "") + line)
        self.quoted = self.quoted or '"' in line
        self.open = '"' in rest
        if not self.open and self.is_complete(rest):
            self.end()

    def is_complete(self, rest):
        """True if the statement needs no further line; `rest`: the last one, without strings."""
        if self.keyword == "SG_":
            return self.quoted  # its unit
        return self.keyword in ENDED_BY_LINE or rest.rstrip().endswith(";")

    def begins(self, line):
        """True if a statement begins with this line."""
        return keyword_of(line) and not (self.in_names and re.fullmatch("[A-Z_]+", line))

    def pass_over(self, number, line):
        """A line between statements."""
        if line and not line.startswith("//") and not self.in_names:
            raise DbcError(number, f"unknown statement: {line}")

    def end(self):
        if self.keyword is None:
            return
        if self.open:
            raise DbcError(self.line, "a string that begins here has no end")
        text = " ".join(self.parts)
        if self.keyword not in ENDED_BY_LINE and not text.endswith(";"):
            text += " ;"
        self.statements.append((self.line, self.keyword, one_blank(text)))
        self.keyword = None


def statements(text):
    """All statements of `text` in their order. DbcError: something is none, or has no end."""
    return Splitter().split(text)


def attribute_name(text):
    match = STRING.search(text)
    return match.group()[1:-1] if match else ""


def with_extended_flag(text):
    """The statement with an identifier as it should be: bit 31 marks an extended one. Many files
    leave it out; above 7FF nothing else can be meant."""
    match = WITH_ID.match(text)
    if not match or not 0x7FF < int(match.group(2)) <= 0x1FFFFFFF:
        return text
    return f"{match.group(1)}{int(match.group(2)) | EXTENDED}{text[match.end():]}"


def follower_of(keyword, text):
    """The keyword of a statement that matters and stands in the line of another one, or None."""
    rest = outside_strings(text)
    words = words_of(rest) if keyword in ENDED_BY_LINE else map(keyword_of, rest.split(";")[1:])
    return next((word for word in words if word in FORMS), None)


def refuse_identifier(line, text, name):
    """DbcError for the identifier `text` of message `name` if no frame has it."""
    if text in Places.INDEPENDENT or int(text) & ~EXTENDED <= 0x1FFFFFFF:
        return
    raise DbcError(line, f"message {name} has the identifier {text}; allowed: 0 to {0x1FFFFFFF}, "
                         f"with {EXTENDED} added for an extended one")


def refuse_odd(line, keyword, text):
    """DbcError for what canmatrix takes for something else: any byte order but 1 for big-endian,
    the last of two texts of a value, an identifier below 0 or of more than 29 bits; or passes
    over: value types and choices of nothing."""
    words = words_of(text)
    if keyword == "BO_" and words:
        if not re.fullmatch(r"[0-9]+", words[0]):
            raise DbcError(line, f"not understood: {text}; allowed: {FORMS['BO_']}")
        refuse_identifier(line, words[0], " ".join(words[1:2]))
    if keyword == "SG_":
        order = re.search(r"@\s*(\d+)", outside_strings(text))
        if order and order.group(1) not in ("0", "1"):
            raise DbcError(line, f"signal {words[0]} has the byte order {order.group(1)}; allowed: "
                                 "0 (big-endian), 1 (little-endian)")
    if keyword in SHAPES and not SHAPES[keyword].match(text):
        raise DbcError(line, f"not understood: {text}; allowed: {FORMS[keyword]}")
    if keyword == "VAL_":
        values = words[2::2]
        for number, value in enumerate(values):
            if value in values[:number]:
                raise DbcError(line, f"value {value} of signal {words[1]} is there twice")


def refuse_place(line, keyword, text, before):
    """DbcError for a signal that does not stand behind its message: canmatrix gives it to the one
    that the statement `before` is about."""
    if keyword == "SG_" and before not in ("BO_", "SG_"):
        name = " ".join(words_of(text)[:1])
        place = f"behind {before}" if before else "before any message"
        raise DbcError(line, f"signal {name} stands {place}; allowed: behind its message and the "
                             "signals of that")


def relevant(given):
    """Without what is of no use here, whose mistakes do not matter either."""
    before = None
    for line, keyword, text in given:
        if follower := keyword != "NS_" and follower_of(keyword, text):
            raise DbcError(line, f"{follower} follows {keyword} in one line; allowed: one "
                                 "statement in a line")
        if keyword not in FORMS:
            continue
        refuse_place(line, keyword, text, before)
        before = keyword
        if keyword.startswith("BA_") and attribute_name(text) not in ATTRIBUTES:
            continue
        if keyword == "SIG_VALTYPE_" and re.search(r":\s*0\s*;", text):
            continue  # an integer; canmatrix would take it for a float
        refuse_odd(line, keyword, text)
        yield line, keyword, with_extended_flag(text)


class Places:
    """Where messages and signals are defined; tells statements about those that are not."""

    INDEPENDENT = ("1073741824", "3221225472")  # the message that holds the signals of no message

    def __init__(self):
        self.messages = {}  # identifier in the file: line
        self.signals = {}   # (identifier, name): line
        self.nested = {}    # the same, for multiplexed multiplexers whose SG_MUL_VAL_ is to come
        self.id = None

    def keep(self, line, keyword, text):
        """Notes a definition. False for a statement about what is not there."""
        words = words_of(text)
        if keyword == "BO_" and words:
            self.id = words[0]
            return self.id not in self.INDEPENDENT and self.define(
                self.messages, self.id, line, f"message {self.id}")
        if keyword == "SG_" and words:
            if re.fullmatch(r"m\d+M", "".join(words[1:2])):
                self.nested[self.id, words[0]] = line
            return self.id not in self.INDEPENDENT and self.define(
                self.signals, (self.id, words[0]), line, f"signal {words[0]}")
        if keyword == "BA_" and words[1:2] in (["BO_"], ["SG_"]):
            return self.knows(words[1] == "SG_", words[2:])
        if keyword in ("VAL_", "SIG_VALTYPE_", "SG_MUL_VAL_"):
            if keyword == "SG_MUL_VAL_":
                self.nested.pop(tuple(words[:2]), None)
            return self.knows(True, words)
        return True

    def finish(self):
        """Call behind the last statement."""
        for (_, name), line in self.nested.items():
            raise DbcError(line, f"signal {name} is multiplexed and a multiplexer, which needs a "
                                 "statement SG_MUL_VAL_")

    @staticmethod
    def define(known, key, line, what):
        if key in known:
            raise DbcError(line, f"{what} is there twice; first in line {known[key]}")
        known[key] = line
        return True

    def knows(self, is_signal, words):
        """True if the first words name something, or nothing that could be looked for."""
        if len(words) < 2 if is_signal else not words:
            return True
        return (words[0], words[1]) in self.signals if is_signal else words[0] in self.messages

    def line_of(self, identifier, extended, signal=None):
        """Line of a message or, if the name is that of the file, of its signal."""
        key = str(identifier | EXTENDED if extended else identifier)
        return self.signals.get((key, signal), self.messages.get(key, 0))
