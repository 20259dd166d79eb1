#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""core_check.py [FOLDER]: reads FOLDER/can.core as FuseSoC does, without FuseSoC: the keys of the
CAPI2 schema that are used, flags, file sets, parameters, and whether each file is there.

Prints what is wrong, a line each; status 1 if there is anything. The commands that its targets lead
to are run by tb/integration/core_description.py.
"""
import os
import re
import sys
from pathlib import Path

import yaml

# What CAPI2 allows of what is used here: key -> kind of its value.
CORE = {"name": str, "description": str, "license": str, "filesets": dict, "parameters": dict,
        "targets": dict}
FILESET = {"file_type": str, "files": list, "depend": list}
FILE = {"file_type": str, "is_include_file": bool}
PARAMETER = {"datatype": str, "description": str, "paramtype": str}
TARGET = {"description": str, "filesets": list, "toplevel": (str, list), "parameters": list,
          "flow": str, "flow_options": dict}
FLOWS = {"lint": ("verilator",), "sim": ("verilator", "icarus"), "icestorm": (), "trellis": ()}
FILE_TYPES = ("systemVerilogSource", "verilogSource-2005", "vlt", "PCF", "user")
VLNV = re.compile(r"[\w.-]*:[\w.-]+:[\w.-]+:\d+\.\d+\.\d+")
FLAGGED = re.compile(r"(?:(!?)(\w+)\? \(([^()]+)\)|([\w.-]+))")


def expand(entry, flags):
    """The names that an entry gives under `flags`; None: not an expression of FuseSoC's."""
    match = FLAGGED.fullmatch(entry)
    if not match:
        return None
    negated, flag, inner, plain = match.groups()
    if plain:
        return [plain]
    return inner.split() if (flag in flags) != bool(negated) else []


class Check:
    """What is wrong with a core."""

    def __init__(self, root):
        self.root, self.wrong = root, []
        text = (root / "can.core").read_text(encoding="utf-8")
        first, _, rest = text.partition("\n")
        self.expect(first == "CAPI=2:", "the first line is not CAPI=2:")
        try:
            self.core = yaml.safe_load(rest)
        except yaml.YAMLError as error:
            self.core = None
            self.wrong.append(" ".join(str(error).split()))
        self.keys(self.core, CORE, "core")
        needed = ("name", "filesets", "parameters", "targets")
        self.whole = isinstance(self.core, dict) and all(
            isinstance(self.core.get(key), CORE[key]) for key in needed)
        self.expect(self.whole, f"core: it needs {', '.join(needed)}")

    def expect(self, good, message):
        if not good:
            self.wrong.append(message)

    def keys(self, entry, allowed, where):
        if not isinstance(entry, dict):
            self.wrong.append(f"{where}: there are no keys")
            return
        for key, value in entry.items():
            if key not in allowed:
                self.wrong.append(f"{where}: {key} is no key of CAPI2's that is used here")
            elif not isinstance(value, allowed[key]):
                self.wrong.append(f"{where}: {key} has a wrong kind of value")

    def filesets(self):
        for name, fileset in self.core["filesets"].items():
            where = f"filesets.{name}"
            self.keys(fileset, FILESET, where)
            self.expect(fileset.get("file_type") in FILE_TYPES, f"{where}: unknown file_type")
            for entry in fileset["files"]:
                path, options = next(iter(entry.items())) if isinstance(entry, dict) \
                    else (entry, {})
                self.keys(options, FILE, f"{where}: {path}")
                self.expect(options.get("file_type", "user") in FILE_TYPES,
                            f"{where}: {path}: unknown file_type")
                self.expect((self.root / path).is_file(), f"{where}: {path}: no such file")

    def parameters(self):
        for name, parameter in self.core["parameters"].items():
            where = f"parameters.{name}"
            self.keys(parameter, PARAMETER, where)
            self.expect(parameter.get("paramtype") == "vlogparam", f"{where}: not a vlogparam")
            self.expect("default" not in parameter, f"{where}: the RTL has the defaults")

    def targets(self):
        for name, target in self.core["targets"].items():
            where = f"targets.{name}"
            self.keys(target, TARGET, where)
            self.expect(target.get("description"), f"{where}: no description")
            for fileset in target["filesets"]:
                self.expect(fileset in self.core["filesets"], f"{where}: no file set {fileset}")
            tops = target["toplevel"]
            for entry in [tops] if isinstance(tops, str) else tops:
                self.expect(expand(entry, {"is_toplevel"}), f"{where}: toplevel {entry}")
            for entry in target.get("parameters", []):
                parameter, is_set, value = entry.partition("=")
                self.expect(not is_set or value.isdecimal(), f"{where}: {entry}: no number")
                for used in expand(parameter, {"is_toplevel"}) or [f"? {entry}"]:
                    self.expect(used in self.core["parameters"], f"{where}: no parameter {used}")
            flow = target.get("flow")
            if flow is None:
                self.expect(name == "default", f"{where}: no flow")
            elif flow not in FLOWS:
                self.wrong.append(f"{where}: unknown flow {flow}")
            elif FLOWS[flow]:
                tool = target.get("flow_options", {}).get("tool")
                self.expect(tool in FLOWS[flow], f"{where}: {flow} has no tool {tool}")

    def dependants(self):
        """What a design that depends on the core gets from it."""
        default = self.core["targets"]["default"]
        tops = default["toplevel"]
        for entry in ([tops] if isinstance(tops, str) else tops) + default["parameters"]:
            self.expect(expand(entry, set()) == [],
                        f"targets.default: {entry} holds in designs that depend on it, too")

    def run(self):
        if not self.whole:
            return self.wrong
        self.expect(VLNV.fullmatch(self.core["name"]), f"name: {self.core['name']}")
        self.filesets()
        self.parameters()
        self.targets()
        self.dependants()
        return self.wrong


def main():
    if len(sys.argv) > 2 or sys.argv[1:2] in (["-h"], ["--help"]):
        sys.exit(__doc__)
    root = Path(sys.argv[1] if len(sys.argv) == 2 else Path(__file__).resolve().parent.parent)
    if not (root / "can.core").is_file():
        sys.exit(f"core_check: {root}/can.core: no such file")
    wrong = Check(root).run()
    for line in wrong:
        print(f"can.core: {line}", file=sys.stderr)
    try:
        print(f"can.core: {len(wrong)} problems", flush=True)
    except OSError as error:  # the script stands alone in an archive
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(f"core_check.py: {error.strerror}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
