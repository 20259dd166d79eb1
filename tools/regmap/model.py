# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""sw/registers.yaml, read and checked. Its head explains the keys."""
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

import yaml

NUM_MB = "NumMb"  # stands for the number of buffers where a number may stand
LAST_MB = "NumMb - 1"
MORE_THAN_32 = "NumMb > 32"  # the one condition that is no feature
ACCESSES = ("rw", "ro", "w1c", "rc", "w1s", "wo")
WRITES = ("any", "freeze", "disable", "wrn_en")


class MapError(Exception):
    """What is wrong with the map, where, and what is allowed."""


# What the value of a key is, wherever the key stands.
TEXT = ("name", "title", "doc", "config", "needs", "steps", "only_if", "read_effect", "access",
        "write", "soft_reset", "for")
NUMBERS = ("window", "offset", "stride", "value", "after_soft_reset", "per_buffer",
           "filter_offset", "depth", "default")
NUMBERS_OR = {"count": NUM_MB, "reset": NUM_MB, "without": LAST_MB}
TRUTHS = ("live", "in_ram")
LISTS = ("num_mb", "features", "registers", "recipes", "words", "formats", "fields", "overlay",
         "values")


@contextmanager
def mistakes_in(path: Path):
    """Mistakes that are found meanwhile are of this file, and say so."""
    try:
        yield
    except MapError as error:
        raise MapError(f"{'/'.join(path.parts[-2:])}: {error}") from None
    except yaml.YAMLError as error:
        raise MapError(f"{'/'.join(path.parts[-2:])}: {' '.join(str(error).split())}") from None


def is_number(value):
    """Of a word, or nearly: what is wider than 32 bits is a slip of the hand."""
    return isinstance(value, int) and not isinstance(value, bool) and 0 <= value < 1 << 32


def check_kind(key, value, where):
    """The value of a key is text, a number or a list, as all of that key are."""
    if key in TEXT:
        good, wanted = isinstance(value, str), "text"
    elif key in NUMBERS:
        good, wanted = is_number(value), "a whole number of at most 32 bits"
    elif key in NUMBERS_OR:
        word = NUMBERS_OR[key]
        good, wanted = is_number(value) or value == word, f"a whole number, or {word}"
    elif key in TRUTHS:
        good, wanted = isinstance(value, bool), "true or false"
    elif key in LISTS:
        good, wanted = isinstance(value, list) and value != [], "a list of at least one"
    else:
        return
    if not good:
        raise MapError(f"{where}: {key} is {value!r}; expected: {wanted}")


def take(entry, where, required, optional=()):
    """The dictionary `entry`, checked to have the `required` keys and no others but `optional`,
    and values of their kind."""
    if not isinstance(entry, dict):
        raise MapError(f"{where.rstrip(':')}: keys are expected here, not {entry!r}")
    where = f"{where} {entry['name']}" if isinstance(entry.get("name"), str) else where.rstrip(":")
    for key in required:
        if key not in entry:
            raise MapError(f"{where}: key '{key}' is missing")
    for key in entry:
        if key not in required and key not in optional:
            allowed = ", ".join((*required, *optional))
            raise MapError(f"{where}: unknown key '{key}'; allowed: {allowed}")
        check_kind(key, entry[key], where)
    return entry


def choose(value, where, allowed):
    if value not in allowed:
        raise MapError(f"{where}: '{value}' is not one of {', '.join(map(str, allowed))}")
    return value


def bit_range(value, where):
    """(high, low) of "31:24" or 7."""
    try:
        high, low = (int(part) for part in (str(value).split(":") * 2)[:2])
    except ValueError:
        raise MapError(f"{where}: bits '{value}' are not like \"31:24\" or 7") from None
    if not 0 <= low <= high <= 31:
        raise MapError(f"{where}: bits '{value}' are not within 31:0, high bit first")
    return high, low


@dataclass
class Value:
    """A named value of a field."""
    name: str
    value: int
    doc: str


@dataclass
class Field:
    """Some bits of a word."""
    name: str
    high: int
    low: int
    doc: str
    access: str = "rw"
    write: str = "any"
    reset: object = 0             # a number or NUM_MB
    live: bool = False
    kept: bool = True             # over a soft reset
    after_soft_reset: object = 0  # same as `reset` if nothing else is said
    values: list = field(default_factory=list)
    only_if: str = ""             # name of a feature
    without: object = 0           # what it reads if that is missing: a number or LAST_MB

    @property
    def width(self):
        return self.high - self.low + 1

    @property
    def mask(self):
        """The field's bits in the word."""
        return ((1 << self.width) - 1) << self.low

    @property
    def bits(self):
        return f"{self.high}:{self.low}" if self.width > 1 else f"{self.low}"

    @property
    def writable(self):
        """Whether software can give it a value."""
        return self.access == "rw"

    @property
    def volatile(self):
        """Whether the core changes it by itself. What can only be read and stays over a soft reset
        is a constant of the core."""
        return (self.live or self.access in ("w1c", "rc", "w1s")
                or (self.access == "ro" and not self.kept))


@dataclass
class Register:
    """A word with an address; of a buffer: relative to the buffer."""
    name: str
    offset: int
    title: str
    fields: list
    overlay: list
    count: object = 1             # a number or NUM_MB
    stride: int = 4
    only_if: str = ""
    per_buffer: object = None     # number of the buffer of bit 0, if a bit is a buffer
    read_effect: str = ""         # what a read does besides reading
    in_ram: bool = False          # undefined after a hard reset without ClearRam

    def value(self, attribute, num_mb):
        """The fields' `attribute` ("reset", "after_soft_reset") put together."""
        word = 0
        for part in self.fields:
            number = getattr(part, attribute)
            word |= (num_mb if number == NUM_MB else number) << part.low
        return word

    def mask(self, wanted=lambda part: True):
        """The bits of the fields that are wanted."""
        return sum(part.mask for part in self.fields if wanted(part))

    @property
    def feature(self):
        """The feature that the whole register belongs to, or nothing."""
        return "" if self.only_if == MORE_THAN_32 else self.only_if

    def feature_mask(self, name, wanted=lambda part: True):
        """The bits, of fields that are wanted, that exist only with the feature."""
        return self.mask(lambda part: wanted(part) and name in (part.only_if, self.feature))

    def buffer_mask(self, num_mb):
        """The bits of a per-buffer register that stand for buffers of the core."""
        if self.per_buffer is None:
            return 0xFFFFFFFF
        return (1 << max(0, min(32, num_mb - self.per_buffer))) - 1


@dataclass
class Feature:
    """A parameter of the core, 0 or 1, that has bits or registers of its own."""
    name: str
    config: str                   # field of XCONFIG that tells of it
    doc: str
    default: int = 1
    needs: str = ""               # another feature, without which it cannot be there


@dataclass
class Recipe:
    title: str
    doc: str
    steps: str                    # lines of accesses, each with a comment


@dataclass
class RegisterMap:
    name: str
    title: str
    window: int
    num_mb: list
    features: list
    registers: list
    buffers: Register             # fields empty; `words` are its registers
    words: list
    filter_offset: int
    fifo_depth: int
    formats: list                 # Registers without an address
    recipes: list
    buffers_doc: str


FIELD_KEYS = ("access", "write", "reset", "soft_reset", "live", "after_soft_reset", "values",
              "only_if", "without")


def read_field(entry, where, soft_reset):
    take(entry, where, ("name", "bits", "doc"), FIELD_KEYS)
    where = f"{where} {entry['name']}"
    high, low = bit_range(entry["bits"], where)
    reset = entry.get("reset", 0)
    if reset != NUM_MB and not 0 <= reset < 1 << (high - low + 1):
        raise MapError(f"{where}: reset {reset:#x} does not fit into bits {entry['bits']}")
    own = choose(entry.get("soft_reset", soft_reset), f"{where}: soft_reset", ("kept", "reset"))
    values = [Value(**take(value, where, ("name", "value", "doc")))
              for value in entry.get("values", [])]
    return Field(entry["name"], high, low, entry["doc"],
                 choose(entry.get("access", "rw"), f"{where}: access", ACCESSES),
                 choose(entry.get("write", "any"), f"{where}: write", WRITES),
                 reset, entry.get("live", False), own == "kept",
                 entry.get("after_soft_reset", reset), values, entry.get("only_if", ""),
                 entry.get("without", 0))


def read_fields(entry, key, where, soft_reset):
    fields = [read_field(part, where, soft_reset) for part in entry.get(key, [])]
    for upper, lower in zip(fields, fields[1:]):
        if upper.low <= lower.high and key == "fields":
            raise MapError(f"{where}: {upper.name} and {lower.name} overlap, or are not listed "
                           "from the highest bit down")
    return fields


def read_register(entry, where, keys=("offset",)):
    take(entry, where, ("name", "title", "fields", *keys),
         ("soft_reset", "overlay", "array", "only_if", "per_buffer", "read_effect", "in_ram"))
    where = f"{where} {entry['name']}"
    soft_reset = entry.get("soft_reset", "kept")
    array = take(entry.get("array", {"count": 1, "stride": 4}), where, ("count", "stride"))
    return Register(entry["name"], entry.get("offset", 0), entry["title"],
                    read_fields(entry, "fields", where, soft_reset),
                    read_fields(entry, "overlay", where, soft_reset),
                    array["count"], array["stride"],
                    entry.get("only_if", ""), entry.get("per_buffer"),
                    entry.get("read_effect", ""), entry.get("in_ram", False))


def check_addresses(registers, buffers, window):
    """No two registers at one address; arrays may be interleaved."""
    owners = {}
    for register in [*registers, buffers]:
        size = buffers.stride if register is buffers else 4
        for entry in range(64 if register.count == NUM_MB else register.count):
            first = register.offset + entry * register.stride
            for offset in range(first, first + size, 4):
                if offset % 4 or not 0 <= offset < window:
                    raise MapError(f"{register.name}: offset {offset:#x} is not a multiple of 4, "
                                   f"or outside the window of {window:#x}")
                if offset in owners:
                    raise MapError(f"{register.name}: offset {offset:#x} is that of "
                                   f"{owners[offset]}")
                owners[offset] = register.name


def check_features(registers, features):
    """Every condition is a feature, and XCONFIG tells of each."""
    names = [one.name for one in features]
    config = next((one for one in registers if one.name == "XCONFIG"), None)
    if config is None:
        raise MapError("registers: XCONFIG is missing, which tells of the features")
    told = {part.name: part.only_if for part in config.fields}
    for one in features:
        choose(one.needs, f"{one.name}: needs", ("", *names))
        if told.get(one.config) != one.name:
            raise MapError(f"XCONFIG {one.config}: only_if: {one.name} is missing")
    for register in registers:
        choose(register.only_if, f"{register.name}: only_if", ("", MORE_THAN_32, *names))
        for part in register.fields:
            choose(part.only_if, f"{register.name} {part.name}: only_if", ("", *names))


def load(path: Path):
    """The map in `path`; raises MapError."""
    with mistakes_in(path):
        return read_map(yaml.safe_load(path.read_text()))


def read_map(data):
    """The map of what its file holds."""
    take(data, "map", ("name", "title", "window", "num_mb", "features", "registers", "recipes",
                       "buffers", "fifo"))
    features = [Feature(**take(entry, "features", ("name", "config", "doc"),
                                 ("default", "needs")))
                for entry in data["features"]]
    registers = [read_register(entry, "registers:") for entry in data["registers"]]
    check_features(registers, features)
    recipes = [Recipe(**take(entry, "recipes", ("title", "doc", "steps")))
               for entry in data["recipes"]]
    part = take(data["buffers"], "buffers",
                ("name", "offset", "stride", "count", "title", "doc", "words"))
    buffers = Register(part["name"], part["offset"], part["title"], [], [], part["count"],
                       part["stride"])
    words = [read_register(entry, "buffers:") for entry in part["words"]]
    check_addresses(registers, buffers, data["window"])
    fifo = take(data["fifo"], "fifo", ("filter_offset", "depth", "formats"))
    formats = [read_register(entry, "fifo:", ()) for entry in fifo["formats"]]
    return RegisterMap(data["name"], data["title"], data["window"], data["num_mb"], features,
                       registers, buffers, words, fifo["filter_offset"], fifo["depth"], formats,
                       recipes, part["doc"])


def camel_to_snake(name):
    """OwnMasks -> own_masks, a member of struct Features of the tests."""
    return "".join("_" + c.lower() if c.isupper() else c for c in name).lstrip("_")


def single_builds(regmap):
    """Cores with all buffers that lack one of the features that are there by default: {name:
    parameters}."""
    return {f"no_{camel_to_snake(feature.name)}": {NUM_MB: 64, feature.name: 0}
            for feature in regmap.features if feature.default}


def load_profiles(path: Path, regmap):
    """name -> {parameter: value} of the profiles in `path`; raises MapError."""
    with mistakes_in(path):
        return read_profiles(yaml.safe_load(path.read_text()), regmap)


def read_profiles(data, regmap):
    """The profiles of what their file holds."""
    take(data, "file", ("profiles",))
    if not isinstance(data["profiles"], dict):
        raise MapError(f"profiles: keys are expected here, not {data['profiles']!r}")
    features = [one.name for one in regmap.features]
    profiles = {}
    for name, entry in data["profiles"].items():
        parameters = take(entry, name, ("for", "parameters"))["parameters"]
        take(parameters, name, (NUM_MB,), features)
        choose(parameters[NUM_MB], f"{name}: {NUM_MB}", regmap.num_mb)
        for feature in features:
            choose(parameters.get(feature, 1), f"{name}: {feature}", (0, 1))
        profiles[name] = {key: int(value) for key, value in parameters.items()}
    return profiles
