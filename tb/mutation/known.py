# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# survivors.yaml: mutants that no test can or does notice, each with its reason.
"""Known.verdict() tells what is known about a mutant: proven, argued, survivor, or nothing."""
import sys

import yaml

VERDICTS = ("proven", "argued", "survivor")
FIELDS = {"module", "line", "original", "mutated", "verdict", "reason"}
OPTIONAL = {"occurrence"}


class Known:
    """Entries of the file. Lines may move: an entry fits the mutant with its text and its line.

    The line is the text of the RTL's line, not its number, so that an entry goes stale only when
    that line changes.
    """

    def __init__(self, path):
        self.entries, self.used = {}, set()
        loaded = yaml.safe_load(path.read_text(encoding="utf-8")) or []
        for place, entry in enumerate(loaded, 1):
            if not isinstance(entry, dict) or set(entry) - OPTIONAL != FIELDS:
                sys.exit(f"{path}: entry {place} needs exactly {', '.join(sorted(FIELDS))}")
            if entry["verdict"] not in VERDICTS:
                sys.exit(f"{path}: entry {place}: verdict is one of {', '.join(VERDICTS)}")
            self.entries[self.key(entry)] = entry

    @staticmethod
    def key(entry):
        """What an entry is found by."""
        return tuple(" ".join(str(entry.get(field, 1)).split())
                     for field in ("module", "line", "original", "mutated", "occurrence"))

    def entry_of(self, mutant):
        """The fields that name a mutant."""
        entry = {"module": mutant.module, "line": mutant.line_text,
                 "original": mutant.original, "mutated": " ".join(mutant.mutated.split())}
        return entry if mutant.occurrence == 1 else {**entry, "occurrence": mutant.occurrence}

    def find(self, mutant):
        """Its entry, or None."""
        key = self.key(self.entry_of(mutant))
        if key in self.entries:
            self.used.add(key)
        return self.entries.get(key)

    def stale(self, design):
        """Entries that fit no mutant of the RTL, of the modules that are looked at."""
        there = {self.key(self.entry_of(mutant)) for mutant in design.candidates()}
        modules = {file.module for file in design.part}
        gone = {entry["module"] for entry in self.entries.values()} - {
            file.module for file in design.files}
        return [entry for key, entry in self.entries.items()
                if key not in there and entry["module"] in modules | gone]
