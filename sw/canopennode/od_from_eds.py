#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""od_from_eds.py DEVICE.eds OUT_DIR: writes OD.h and OD.c, the object dictionary of a device in the
form that CANopenNode 4 takes (its doc/objectDictionary.md and 301/CO_ODinterface.h), from an
electronic data sheet (CiA 306).

Variables below 0x2000 that a master may write are in the group PERSIST_COMM, which 1010:02 stores;
variables from 0x2000 on with ";Storage=PERSIST_APP" in PERSIST_APP; all others in RAM. $NODEID in
a default value is left out: CANopenNode adds the node-ID itself. Strings have as many bytes as
their default, or as ";Length" says.

What is not understood is refused with the section and what is allowed.
"""
import argparse
import configparser
import math
import pathlib
import re
import sys

VAR, ARRAY, RECORD = 7, 8, 9
# data type (CiA 301, 7.4.7): C type, bytes
TYPES = {0x01: ("bool_t", 1), 0x02: ("int8_t", 1), 0x03: ("int16_t", 2), 0x04: ("int32_t", 4),
         0x05: ("uint8_t", 1), 0x06: ("uint16_t", 2), 0x07: ("uint32_t", 4), 0x08: ("float32_t", 4),
         0x15: ("int64_t", 8), 0x1B: ("uint64_t", 8)}
VISIBLE_STRING, OCTET_STRING, DOMAIN = 0x09, 0x0A, 0x0F
LARGEST_REAL32 = (2 - 2**-23) * 2.0**127
ACCESS = {"ro": "ODA_SDO_R", "const": "ODA_SDO_R", "wo": "ODA_SDO_W", "rw": "ODA_SDO_RW",
          "rwr": "ODA_SDO_RW", "rww": "ODA_SDO_RW"}
# Counters that CANopen.c asks for: name, and the objects of which one means that there is one.
COUNTERS = (("NMT", ()), ("HB_PROD", (0x1017,)), ("HB_CONS", (0x1016,)), ("EM", ()),
            ("EM_PROD", (0x1014,)), ("SYNC", (0x1005,)), ("SYNC_PROD", (0x1006,)),
            ("TIME", (0x1012,)), ("STORAGE", (0x1010,)))
RANGES = (("SDO_SRV", 0x1200, 0x127F), ("SDO_CLI", 0x1280, 0x12FF), ("RPDO", 0x1400, 0x15FF),
          ("TPDO", 0x1800, 0x19FF))
ARRAYS = (0x1003, 0x1010, 0x1011, 0x1016)


class EdsError(Exception):
    """What is wrong with the data sheet, and where."""


class Variable:
    """One entry with data: a VAR, or a sub-object."""

    def __init__(self, section, values, sub):
        self.section, self.sub = section, sub
        self.name = identifier(values.get("ParameterName", ""), section)
        self.type = number(values, "DataType", section)
        self.access = values.get("AccessType", "").lower()
        if self.access not in ACCESS:
            raise EdsError(f"[{section}] AccessType={self.access}: ro, wo, rw, rwr, rww or const")
        self.mapping = number(values, "PDOMapping", section, 0) != 0
        self.default = values.get("DefaultValue", "").strip()
        self.storage = values.get(";Storage", "")
        if self.type in TYPES:
            self.ctype, self.size = TYPES[self.type]
        elif self.type in (VISIBLE_STRING, OCTET_STRING):
            longest = number(values, ";Length", section, len(self.default))
            if longest < 0:
                raise EdsError(f"[{section}] ;Length={longest}: 0 or more bytes")
            self.ctype, self.size = "char", max(longest, 1)
        elif self.type == DOMAIN:
            self.ctype, self.size = None, 0
        else:
            raise EdsError(f"[{section}] DataType=0x{self.type:04X}: integers, REAL32, BOOLEAN, "
                           "VISIBLE_STRING, OCTET_STRING and DOMAIN are known")

    def attribute(self):
        """ODA_*: who may read and write, whether a PDO may have it."""
        parts = [ACCESS[self.access]]
        if self.mapping:
            parts.append({"rwr": "ODA_TPDO", "ro": "ODA_TPDO", "const": "ODA_TPDO",
                          "rww": "ODA_RPDO", "wo": "ODA_RPDO"}.get(self.access, "ODA_TRPDO"))
        if self.type in TYPES and self.size > 1:
            parts.append("ODA_MB")
        if self.ctype == "char":
            parts.append("ODA_STR")
        return " | ".join(parts)

    def declaration(self):
        """The member of a group's struct."""
        if self.ctype == "char":
            return f"char {self.name}[{self.size + 1}]"
        return f"{self.ctype} {self.name}"

    def value(self):
        """The initial value in C."""
        if self.ctype == "char":
            if len(self.default) > self.size:
                raise EdsError(f"[{self.section}] DefaultValue is longer than ;Length={self.size}")
            return "{" + ", ".join(f"0x{ord(c):02X}" for c in self.default + "\0") + "}"
        if self.ctype == "float32_t":
            return f"{self._real()}f"
        text = re.sub(r"\$NODEID\s*\+?|\+\s*\$NODEID", "", self.default, flags=re.I).strip() or "0"
        try:
            value = int(text, 0)
        except ValueError as error:
            raise EdsError(f"[{self.section}] DefaultValue={self.default}: no number") from error
        low = -(1 << (8 * self.size - 1)) if self.ctype.startswith("int") else 0
        if not low <= value < 1 << (8 * self.size):
            raise EdsError(f"[{self.section}] DefaultValue={self.default}: no {self.ctype}")
        return f"0x{value:0{2 * self.size}X}" if value >= 0 else str(value)

    def _real(self):
        try:
            value = float(self.default or 0)
        except ValueError:
            value = math.nan
        if not abs(value) <= LARGEST_REAL32:
            raise EdsError(f"[{self.section}] DefaultValue={self.default}: no REAL32")
        return value


class Object:
    """An object of the dictionary."""

    def __init__(self, index, eds):
        self.section = f"{index:04X}"
        values = eds[self.section]
        self.index = index
        self.name = f"x{index:04X}_{identifier(values.get('ParameterName', ''), self.section)}"
        self.kind = number(values, "ObjectType", self.section, VAR)
        if self.kind == VAR:
            self.subs = [Variable(self.section, values, 0)]
            self.subs[0].name = self.name
        elif self.kind in (ARRAY, RECORD):
            self.subs = [Variable(s, eds[s], sub) for sub in range(256)
                         if (s := f"{index:04X}sub{sub:X}") in eds]
            if len(self.subs) != number(values, "SubNumber", self.section):
                raise EdsError(f"[{self.section}] SubNumber={values['SubNumber']}, but there are "
                               f"{len(self.subs)} sections [{self.section}sub0] to ...")
            self._check()
        else:
            raise EdsError(f"[{self.section}] ObjectType={self.kind}: "
                           "7 (VAR), 8 (ARRAY), 9 (RECORD)")

    def _check(self):
        if not self.subs or self.subs[0].sub != 0 or self.subs[0].ctype != "uint8_t":
            raise EdsError(f"[{self.section}]: sub-index 0 is missing, or no UNSIGNED8")
        names = [sub.name for sub in self.subs]
        if self.kind == RECORD and len(set(names)) != len(names):
            raise EdsError(f"[{self.section}]: two sub-objects have one ParameterName")
        if self.kind == ARRAY:
            self._check_elements()

    def _check_elements(self):
        """They lie one behind the other, each as long as the first."""
        if len({(s.ctype, s.attribute()) for s in self.subs[1:]}) != 1:
            raise EdsError(f"[{self.section}]: elements of an ARRAY have one type and one access")
        if any(s.type not in TYPES for s in self.subs[1:]):
            raise EdsError(f"[{self.section}]: elements of an ARRAY are numbers; others go into a "
                           "RECORD")
        if self.subs[-1].sub != len(self.subs) - 1:
            raise EdsError(f"[{self.section}]: sub-indices of an ARRAY follow each other, 0 to "
                           f"{len(self.subs) - 1}; here the last one is {self.subs[-1].sub}")

    @property
    def group(self):
        """The struct its variables are in."""
        if any(sub.storage == "PERSIST_APP" for sub in self.subs):
            return "PERSIST_APP"
        writable = any(sub.access not in ("ro", "const") for sub in self.subs)
        if self.index < 0x2000 and writable and self.index not in (0x1003, 0x1010, 0x1011):
            return "PERSIST_COMM"
        return "RAM"

    def members(self):
        """Lines of the struct."""
        if self.kind == VAR:
            return [f"  {self.subs[0].declaration()};"] if self.subs[0].ctype else []
        if self.kind == ARRAY:
            return [f"  uint8_t {self.name}_sub0;",
                    f"  {self.subs[1].ctype} {self.name}[{len(self.subs) - 1}];"]
        return ["  struct {", *(f"    {sub.declaration()};" for sub in self.subs if sub.ctype),
                f"  }} {self.name};"]

    def values(self):
        """Initial values of these."""
        if self.kind == VAR:
            return [f"  .{self.name} = {self.subs[0].value()},"] if self.subs[0].ctype else []
        if self.kind == ARRAY:
            elements = ", ".join(sub.value() for sub in self.subs[1:])
            return [f"  .{self.name}_sub0 = {self.subs[0].value()},",
                    f"  .{self.name} = {{{elements}}},"]
        return [f"  .{self.name} = {{",
                *(f"    .{sub.name} = {sub.value()}," for sub in self.subs if sub.ctype), "  },"]

    def declaration(self):
        """The member of the struct of objects."""
        kind = {VAR: "var", ARRAY: "array", RECORD: "record"}[self.kind]
        length = f"[{len(self.subs)}]" if self.kind == RECORD else ""
        return f"  OD_obj_{kind}_t o{self.name[1:]}{length};"

    def _place(self, member):
        return f"&OD_{self.group}.{member}"

    def definition(self):
        """Its value."""
        first = self.subs[0]
        if self.kind == ARRAY:
            of = self.subs[1]
            return [f"  .o{self.name[1:]} = {{",
                    f"    .dataOrig0 = {self._place(self.name + '_sub0')},",
                    f"    .dataOrig = {self._place(self.name + '[0]')},",
                    f"    .attribute0 = {first.attribute()},",
                    f"    .attribute = {of.attribute()},",
                    f"    .dataElementLength = {of.size},",
                    f"    .dataElementSizeof = sizeof({of.ctype}),", "  },"]
        if self.kind == VAR:
            return [f"  .o{self.name[1:]} = {{", *self._fields(first, first.name, "    "), "  },"]
        lines = [f"  .o{self.name[1:]} = {{"]
        for sub in self.subs:
            lines += ["    {", f"      .subIndex = {sub.sub},",
                      *self._fields(sub, f"{self.name}.{sub.name}", "      "), "    },"]
        return [*lines, "  },"]

    def _fields(self, variable, member, indent):
        at = "NULL" if variable.ctype is None else self._place(member)
        if variable.ctype == "char":
            at += "[0]"
        return [f"{indent}.dataOrig = {at},", f"{indent}.attribute = {variable.attribute()},",
                f"{indent}.dataLength = {variable.size},"]


def number(values, key, section, default=None):
    """A number of a section."""
    text = values.get(key, "").strip()
    if not text and default is not None:
        return default
    try:
        return int(text, 0)
    except ValueError as error:
        raise EdsError(f"[{section}] {key}={text}: a number is needed") from error


def identifier(text, section):
    """ParameterName as a name of C: words joined, the first in lower case unless an acronym."""
    words = re.findall(r"[A-Za-z0-9]+", text)
    if not words:
        raise EdsError(f"[{section}]: ParameterName is missing")
    first = words[0] if len(words[0]) > 1 and words[0][1].isupper() else \
        words[0][0].lower() + words[0][1:]
    name = first + "".join(word[0].upper() + word[1:] for word in words[1:])
    return f"n{name}" if name[0].isdigit() else name


def read_objects(path):
    """All objects of an EDS, in order of their index."""
    eds = configparser.RawConfigParser(comment_prefixes=("#",), strict=True)
    eds.optionxform = str
    with open(path, encoding="ascii") as file:
        eds.read_file(file)
    indices = []
    for section in ("MandatoryObjects", "OptionalObjects", "ManufacturerObjects"):
        count = number(eds[section], "SupportedObjects", section) if section in eds else 0
        indices += [number(eds[section], str(i + 1), section) for i in range(count)]
    for index in indices:
        if indices.count(index) > 1:
            raise EdsError(f"object 0x{index:04X} is listed twice")
        if f"{index:04X}" not in eds:
            raise EdsError(f"object 0x{index:04X} is listed, but has no section [{index:04X}]")
    return [Object(index, eds) for index in sorted(indices)]


def header(objects, source):
    """OD.h."""
    has = {o.index for o in objects}
    lines = [f"/* Made by od_from_eds.py from {source}: do not edit. */", "#ifndef OD_H",
             "#define OD_H", "", '#include "301/CO_ODinterface.h"', ""]
    lines += [f"#define OD_CNT_{name} 1" for name, of in COUNTERS if has.issuperset(of)]
    for name, first, last in RANGES:
        count = sum(first <= index <= last for index in has)
        lines += [f"#define OD_CNT_{name} {count}"] if count else []
    lines += [f"#define OD_CNT_ARR_{o.index:04X} {len(o.subs) - 1}" for o in objects
              if o.index in ARRAYS]
    for group in groups(objects):
        members = [m for o in objects if o.group == group for m in o.members()]
        lines += ["", "typedef struct {", *members, f"}} OD_{group}_t;",
                  f"extern OD_{group}_t OD_{group};"]
    lines += ["", "extern OD_t *OD;", ""]
    for place, o in enumerate(objects):
        lines += [f"#define OD_ENTRY_H{o.index:04X} &OD->list[{place}]",
                  f"#define OD_ENTRY_H{o.name[1:]} &OD->list[{place}]"]
    return "\n".join([*lines, "", "#endif /* OD_H */", ""])


def groups(objects):
    """Groups in use."""
    return sorted({o.group for o in objects if o.members()})


def source_file(objects, source):
    """OD.c."""
    lines = [f"/* Made by od_from_eds.py from {source}: do not edit. */", "#define OD_DEFINITION",
             '#include "301/CO_ODinterface.h"', '#include "OD.h"', "", "#if CO_VERSION_MAJOR < 4",
             "#error CANopenNode 4 is needed", "#endif"]
    for group in groups(objects):
        values = [v for o in objects if o.group == group for v in o.values()]
        lines += ["", f"OD_{group}_t OD_{group} = {{", *values, "};"]
    lines += ["", "typedef struct {", *(o.declaration() for o in objects), "} ODObjs_t;", "",
              "static CO_PROGMEM ODObjs_t ODObjs = {",
              *(line for o in objects for line in o.definition()), "};", "",
              "static OD_entry_t ODList[] = {"]
    kinds = {VAR: "ODT_VAR", ARRAY: "ODT_ARR", RECORD: "ODT_REC"}
    lines += [f"  {{0x{o.index:04X}, 0x{len(o.subs):02X}, {kinds[o.kind]}, &ODObjs.o{o.name[1:]}, "
              "NULL}," for o in objects]
    lines += ["  {0x0000, 0x00, 0, NULL, NULL},", "};", "",
              "static OD_t ODInstance = {(sizeof(ODList) / sizeof(ODList[0])) - 1, &ODList[0]};",
              "OD_t *OD = &ODInstance;", ""]
    return "\n".join(lines)


def main():
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("eds", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path, help="directory for OD.h and OD.c")
    arguments = parser.parse_args()
    try:
        objects = read_objects(arguments.eds)
        texts = {"OD.h": header(objects, arguments.eds.name),
                 "OD.c": source_file(objects, arguments.eds.name)}
    except (EdsError, OSError, configparser.Error, UnicodeDecodeError) as error:
        print(f"od_from_eds.py: {arguments.eds}: {error}", file=sys.stderr)
        return 2
    try:
        arguments.out.mkdir(parents=True, exist_ok=True)
        for name, text in texts.items():
            (arguments.out / name).write_text(text, encoding="ascii")
    except OSError as error:
        print(f"od_from_eds.py: {error.filename or arguments.out}: {error.strerror}",
              file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
