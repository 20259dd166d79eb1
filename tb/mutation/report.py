# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Figures and tables of a mutation run.
"""Report.json() is what the campaign reads, Report.show() what the screen gets."""
import yaml

BAR = 97.0             # per cent


class Report:
    """Verdicts of all mutants of a run."""

    def __init__(self, design, known, run, results, seen, programs):
        self.run, self.results, self.seen, self.known = run, results, seen, known
        self.folder = {name: folder for folder, name in programs}
        self.design = design
        self.verdicts = {mutant.name: self.verdict(mutant) for mutant in run}

    def verdict(self, mutant):
        """killed, proven, argued or survivor; a killed one is killed whatever is known of it."""
        result = self.results[mutant.name]
        if result["killed"]:
            return "killed"
        if "proven" in result:
            return "proven"
        entry = self.known.find(mutant)
        return "argued" if entry and entry["verdict"] == "argued" else "survivor"

    def count(self, verdict, mutants=None):
        """Mutants with the verdict."""
        return sum(self.verdicts[m.name] == verdict for m in (mutants or self.run))

    def score(self, mutants=None):
        """Per cent of the mutants that are no equivalents."""
        mutants = mutants or self.run
        real = len(mutants) - self.count("proven", mutants) - self.count("argued", mutants)
        return 100.0 * self.count("killed", mutants) / real if real else 100.0

    def wrong_entries(self):
        """Mutants called equivalent that a test has killed."""
        return [m for m in self.run if self.verdicts[m.name] == "killed"
                and (self.known.find(m) or {}).get("verdict") in ("proven", "argued")]

    def modules(self):
        """Rows of the table by module."""
        rows = []
        for file in self.design.part:
            mine = [mutant for mutant in self.run if mutant.module == file.module]
            if mine:
                rows.append([file.module, len(file.mutants), len(mine),
                             *(self.count(v, mine) for v in ("killed", "proven", "argued",
                                                             "survivor")),
                             f"{self.score(mine):.1f} %"])
        return rows

    def grouped(self, key):
        """Killed mutants and their share, by what key(result) says."""
        counts = {}
        for result in self.results.values():
            if result["killed"]:
                counts[key(result)] = counts.get(key(result), 0) + 1
        return [[name, count] for name, count in sorted(counts.items(),
                                                         key=lambda item: (-item[1], item[0]))]

    def survivors(self):
        """Rows of mutants that live, with what is known of them."""
        rows = []
        for mutant in self.run:
            if self.verdicts[mutant.name] == "survivor":
                entry = self.known.find(mutant)
                reason = entry["reason"] if entry else "not looked at"
                if entry and entry["verdict"] == "proven":
                    reason = "called proven, but the proof fails now"
                rows.append([mutant.name, mutant.kind, mutant.shown(), " ".join(reason.split())])
        return rows

    def equivalents(self):
        """Rows of mutants that change nothing."""
        return [[m.name, m.kind, m.shown(), self.verdicts[m.name],
                 " ".join(self.known.find(m)["reason"].split())]
                for m in self.run if self.verdicts[m.name] in ("proven", "argued")]

    def json(self, options):
        """Result for the campaign."""
        score, wrong = self.score(), self.wrong_entries()
        full = options.scale == 1 and not options.module and not options.mutant
        # Of those that have anything to mutate: can_rn_params, can_time_params and
        # can_timing_params only refuse parameters.
        least, files = options.full // 11 * 10, sum(bool(f.mutants) for f in self.design.part)
        figures = [
            {"name": "mutants", "value": len(self.run), "bar": f"at least {least}",
             "ok": len(self.run) >= least if full else None},
            {"name": "files with mutants", "value": len(self.modules()), "bar": f"all {files}",
             "ok": len(self.modules()) == files if full else None},
            {"name": "killed", "value": self.count("killed"), "bar": None, "ok": None},
            {"name": "equivalent, proven", "value": self.count("proven"), "bar": None, "ok": None},
            {"name": "equivalent, argued", "value": self.count("argued"), "bar": None, "ok": None},
            {"name": "survivors", "value": self.count("survivor"), "bar": None, "ok": None},
            {"name": "mutation score", "value": round(score, 2), "text": f"{score:.2f} %",
             "bar": "at least 97 %", "ok": score >= BAR if full else None},
            {"name": "called equivalent, yet killed", "value": len(wrong), "bar": "0",
             "ok": not wrong}]
        tables = [
            {"title": "Mutants by file",
             "columns": ["file", "possible", "run", "killed", "proven", "argued", "survivors",
                         "score"], "rows": self.modules()},
            {"title": "Killed by tests of", "columns": ["folder", "mutants"],
             "rows": self.grouped(lambda r: "tb/" + self.folder[r["by"].split(":")[0]])},
            {"title": "How it showed", "columns": ["outcome", "mutants"],
             "rows": self.grouped(lambda r: r["reason"])},
            {"title": "Survivors", "columns": ["mutant", "kind", "change", "reason"],
             "rows": self.survivors()},
            {"title": "Equivalent mutants",
             "columns": ["mutant", "kind", "change", "how", "reason"],
             "rows": self.equivalents()}]
        return {"figures": figures, "tables": tables, "notes": self.notes(options)}

    def notes(self, options):
        """Seed, and what does not fit."""
        out = [f"seed {options.seed}, scale {options.scale}"]
        out += [f"called equivalent, yet killed: {m.name} by {self.results[m.name]['by']}"
                for m in self.wrong_entries()]
        out += [f"survivors.yaml: fits no mutant any more: {e['module']}: {e['line']}"
                for e in self.known.stale(self.design)]
        return out

    def show(self, each):
        """Summary; each: one line for every mutant."""
        for mutant in self.run if each else []:
            result = self.results[mutant.name]
            print(f"{mutant.name}  {mutant.kind}: {mutant.shown()}\n    "
                  f"{self.verdicts[mutant.name]}"
                  + (f" by {result['by']} ({result['reason']})" if result["killed"]
                     else f", {result['tests']} tests saw a difference inside")
                  + f", {result['seconds']} s")
        new = [m for m in self.run if self.verdicts[m.name] == "survivor"
               and not self.known.find(m)]
        if new:
            print("Not noticed and not yet in survivors.yaml:")
            print(yaml.safe_dump([{**self.known.entry_of(m), "name": m.name,
                                   "tests": self.results[m.name]["tests"]} for m in new],
                                 sort_keys=False, width=110))
        print(f"mutation: {len(self.run)} mutants, {self.count('killed')} killed, "
              f"{self.count('proven')} proven and {self.count('argued')} argued equivalent, "
              f"{self.count('survivor')} survivors: score {self.score():.2f} %")
