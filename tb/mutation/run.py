#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Mutation score: does the regression notice when the RTL is wrong? docs/mutation.md.
"""Makes mutants of the RTL, runs the tests against each, and reports those that nobody noticed."""
import argparse
import collections
import fnmatch
import json
import os
import pathlib
import sys
import time
import zlib

sys.path.insert(1, str(pathlib.Path(__file__).resolve().parents[1]))
# pylint: disable=wrong-import-position
import campaign_settings
import models
from equivalence import proof_of
from known import Known
from mutants import Design, choose
from regression import Regression, in_parallel, programs, target
from report import Report
from shards import Shard

FULL = {"core": 1100, "remote": 330, "time": 250, "buses": 150}   # mutants at scale 1
PROOF_SECONDS = 120    # limit of one proof
RECORD_SECONDS = 60    # of one test that records; what takes five times as long hangs
# Of the tests of one program so many seconds are run for one mutant at first: of long sweeps a
# part. What survives that, and is not known from survivors.yaml, meets the others, too, at the end.
PROGRAM_SECONDS = 5
# Programs that compare everything with a model notice more in a second: they come early, with more.
JUDGES = {"buffer_random_test", "random_lockstep_test", "random_buses_test",
          "port_every_frame_test", "port_random_test", "rtl_random_test", "bus_wrappers_test"}
JUDGE_SECONDS = 10


def arguments():
    """Options; the campaign's environment gives the defaults."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scale", type=campaign_settings.SCALES.option,
                        default=campaign_settings.scale(),
                        help="part of 1,100 mutants (330 of remote, 250 of time, 150 of buses), "
                             "above 0 up to 1")
    parser.add_argument("--part", choices=sorted(FULL), default="core",
                        help="core: all but rtl/remote, the node without a processor, the time "
                             "unit, and buses, the wrappers but can_ahb (core)")
    parser.add_argument("--seed", type=campaign_settings.SEEDS.option,
                        default=campaign_settings.seed())
    parser.add_argument("--module", action="append", default=[], help="only mutants in it")
    parser.add_argument("--mutant", action="append", default=[],
                        help="only this one, such as can_fault:57.12:a")
    parser.add_argument("--all", action="store_true", help="every mutant, not a sample")
    parser.add_argument("--list", action="store_true", help="name the mutants and stop")
    parser.add_argument("--budget", type=float, default=float("inf"),
                        help="seconds of tests for one mutant; survivors then mean less")
    parser.add_argument("--programs", default="*", metavar="PATTERN",
                        help="only these test programs, such as 'can_*_test'")
    parser.add_argument("--resume", action="store_true",
                        default=os.environ.get("CAMPAIGN_RESUME", "0") not in ("", "0"),
                        help="take what an interrupted run of the same builds has killed as killed")
    parser.add_argument("--no-build", action="store_true", help="take the builds as they are")
    parser.add_argument("--jobs", type=campaign_settings.JOBS.option,
                        default=campaign_settings.jobs())
    parser.add_argument("--build", type=pathlib.Path,
                        help="directory for the test programs (build/mutants, or with the part "
                             "behind it)")
    parser.add_argument("--dir", type=pathlib.Path, help="directory for results",
                        default=os.environ.get("CAMPAIGN_DIR"))
    parser.add_argument("--out", default=os.environ.get("CAMPAIGN_OUT"), help="JSON of the results")
    options = parser.parse_args()
    options.full = FULL[options.part]
    options.build = (options.build or models.ROOT / "build" / (
        "mutants" if options.part == "core" else f"mutants-{options.part}")).resolve()
    options.dir = pathlib.Path(options.dir or options.build / "results").resolve()
    try:
        options.dir.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        parser.error(f"--dir {options.dir}: {error.strerror}")
    return options


def wanted(options, design):
    """(in the models, to run): the sample is in the models whatever is asked for of it."""
    modules = {file.module for file in design.part}
    for module in options.module:
        if module not in modules:
            sys.exit(f"run.py: --module {module}: there is {', '.join(sorted(modules))}")
    if options.all:
        chosen = design.candidates()
        for number, mutant in enumerate(chosen, 1):
            mutant.number = number
    else:
        chosen = choose(design, max(1, round(options.full * options.scale)), options.seed)
    everything = {mutant.name: mutant for mutant in design.candidates()}
    run = [m for m in chosen if not options.module or m.module in options.module]
    if options.mutant:
        missing = [name for name in options.mutant if name not in everything]
        if missing:
            sys.exit(f"run.py: --mutant {missing[0]}: no such mutant; --list --all names all")
        run = [everything[name] for name in options.mutant]
        for mutant in run:
            if not mutant.number:
                mutant.number = len(chosen) + 1
                chosen.append(mutant)
    return chosen, run


def programs_of(options):
    """(folder, name) of the test programs that are asked for; with --no-build they are there."""
    found = [(folder, name) for folder, name in programs(models.ROOT, options.part)
             if fnmatch.fnmatch(name, options.programs)]
    if not found:
        sys.exit(f"run.py: --programs {options.programs}: no test program has such a name")
    regression = Regression(models.ROOT, options.build)
    try:
        for _, name in found if options.no_build else ():
            regression.path(name)
    except FileNotFoundError as error:
        sys.exit(f"run.py: --no-build: {error}")
    return found


def part_of(tests, most):
    """All of a program's (test, seconds), or evenly spaced ones that take `most` seconds."""
    total = sum(seconds for _, seconds in tests)
    if total <= most:
        return tests
    share = most / total
    return [test for n, test in enumerate(tests)
            if int((n + 1) * share) > int(n * share)] or tests[:1]


class Campaign:
    """One run: builds, what each test can see, and the verdict on each mutant."""

    def __init__(self, options, design, known, chosen):
        self.options, self.design, self.known, self.chosen = options, design, known, chosen
        self.programs = programs_of(options)
        numbers = {mutant.name: mutant.number for mutant in chosen}
        targets = sorted({target(name) for _, name in self.programs})
        if not options.no_build and Shard().kind in ("whole", "prepare"):
            self.say(f"building {len(targets)} test programs with {len(chosen)} mutants")
            models.build(options.build, numbers, targets, options.jobs)
        self.regression = Regression(models.ROOT, options.build)
        self.seen = {}                       # mutant number -> [(program, test, seconds)]
        self.stamp = []                      # what the programs are
        self.same_builds = False             # as in the run before
        self.sound = False                   # all programs pass without a mutant
        self.noticed = collections.Counter()  # (module, program): its mutants that it has killed

    @staticmethod
    def say(text):
        """One line of progress."""
        print(f"mutation: {text}", flush=True)

    def record(self):
        """What each test can see; known from before while the programs are the same."""
        self.stamp = [[name, stat.st_size, stat.st_mtime_ns] for _, name in self.programs
                      for stat in [self.regression.path(name).stat()]]
        path = self.options.dir / "seen.json"
        if path.exists():
            before = json.loads(path.read_text(encoding="utf-8"))
            self.same_builds = before["stamp"] == self.stamp
            if self.same_builds:
                self.seen = {int(number): tests for number, tests in before["seen"].items()}
                self.sound = before.get("sound", False)
                return
        self.record_anew()
        self.keep()

    def keep(self):
        """For a run that resumes this one."""
        (self.options.dir / "seen.json").write_text(json.dumps(
            {"stamp": self.stamp, "seen": self.seen, "sound": self.sound}), encoding="utf-8")

    def record_anew(self):
        """Runs every test once and notes which mutants make a difference in it."""
        tests = [(program, test) for _, program in self.programs
                 for test in self.regression.tests_of(program)]
        self.say(f"recording what {len(tests)} tests can see")
        last = time.monotonic()

        def one(item):
            program, test = item
            path = self.options.dir / f"seen-{zlib.crc32(str(item).encode()):08x}"
            outcome = self.regression.run(program, [test],
                                          {"VERICAN_MUTANT_RECORD": str(path)}, RECORD_SECONDS)
            numbers = path.read_text().split() if path.exists() else []
            path.unlink(missing_ok=True)
            return outcome, [int(number) for number in numbers]

        for done, (item, (outcome, numbers)) in enumerate(
                in_parallel(self.options.jobs, one, tests), 1):
            if not outcome.passed:
                sys.exit(f"run.py: without a mutant {item[0]}: {item[1]} {outcome.reason}")
            for number in numbers:
                self.seen.setdefault(number, []).append((*item, outcome.seconds))
            if time.monotonic() - last > 30:
                last = time.monotonic()
                self.say(f"recorded {done} of {len(tests)}")

    def killed_before(self, run):
        """Verdicts of an interrupted run on the same programs, of mutants that a test killed."""
        path = self.options.dir / "progress.jsonl"
        if not (self.options.resume and self.same_builds and path.exists()):
            path.unlink(missing_ok=True)
            return {}
        modules = {mutant.name: mutant.module for mutant in run}
        before = {}
        for entry in map(json.loads, path.read_text(encoding="utf-8").splitlines()):
            name = entry.pop("name")
            if entry["killed"] and name in modules:
                before[name] = entry
                self.noticed[modules[name], entry["by"].split(":")[0]] += 1
        return before

    def baseline(self):
        """The same programs that run the mutants must pass without one."""
        self.say("running the regression without a mutant")
        begin = time.monotonic()
        for item, outcome in in_parallel(
                self.options.jobs, lambda item: self.regression.run(item[1], None, {}, 600),
                self.programs):
            if not outcome.passed:
                sys.exit(f"run.py: without a mutant {item[1]} {outcome.reason}: {outcome.test}")
        return time.monotonic() - begin

    def judge(self, mutant):
        """Proves it again, or runs a part of the tests that can see it, the quickest programs
        first."""
        entry = self.known.find(mutant)
        if entry and entry["verdict"] == "proven":
            where = proof_of(self.design, mutant, PROOF_SECONDS)
            if where:
                return {"killed": False, "proven": where, "tests": 0, "seconds": 0}
        return self.run_against(mutant, self.short_run(mutant))

    def is_open(self, mutant, result):
        """Whether a mutant that the short run left alive has to survive the other tests, too."""
        return not (result["killed"] or result.get("stopped") or self.known.find(mutant))

    def judge_whole(self, mutant, result):
        """The verdict of all tests that can see it, behind that of its short run."""
        return self.run_against(mutant, self.left_out(mutant, self.short_run(mutant)), result)

    def short_run(self, mutant):
        """{program: [(test, seconds)]} that can see it, of long programs a part."""
        groups = {}
        for program, test, seconds in self.seen.get(mutant.number, []):
            groups.setdefault(program, []).append((test, seconds))
        return {program: part_of(tests, JUDGE_SECONDS if program in JUDGES else PROGRAM_SECONDS)
                for program, tests in groups.items()}

    def left_out(self, mutant, short):
        """The same of the tests that its short run has left out."""
        groups = {}
        for program, test, seconds in self.seen.get(mutant.number, []):
            if (test, seconds) not in short[program]:
                groups.setdefault(program, []).append((test, seconds))
        return groups

    def run_against(self, mutant, groups, before=None):
        """The verdict of these tests, and of those before: first the programs that are quick, or
        have noticed other mutants of the module."""
        def rank(program):
            seconds = sum(seconds for _, seconds in groups[program])
            return (seconds / (10 if program in JUDGES else 1)
                    / (1 + self.noticed[mutant.module, program]), program)

        order = sorted(groups, key=rank)
        tests = sum(len(group) for group in groups.values()) + (before["tests"] if before else 0)
        used, planned = before["seconds"] if before else 0.0, 0.0
        for program in order:
            planned += sum(seconds for _, seconds in groups[program])
            if planned > self.options.budget:
                return {"killed": False, "seen": True, "seconds": round(used, 3),
                        "tests": tests, "stopped": True}
            outcome = self.regression.run(program, sorted(test for test, _ in groups[program]),
                                          {"VERICAN_MUTANT": str(mutant.number)},
                                          sum(seconds for _, seconds in groups[program]))
            used += outcome.seconds
            if not outcome.passed:
                self.noticed[mutant.module, program] += 1
                return {"killed": True, "by": outcome.test, "reason": outcome.reason,
                        "seconds": round(used, 3)}
        return {"killed": False, "seen": tests > 0, "seconds": round(used, 3), "tests": tests}

    def judge_all(self, run, shard):
        """The verdicts on the shard's mutants, by name."""
        results = self.killed_before(run) if shard.kind == "whole" else {}
        if shard.kind == "whole" and not (self.options.resume and self.sound):
            self.say(f"regression without a mutant: {self.baseline():.0f} s")
            self.sound = True
            self.keep()
        # Scattered over the modules, so that an interrupted run says something of all.
        scattered = shard.mine(sorted((mutant for mutant in run if mutant.name not in results),
                                      key=lambda mutant: zlib.crc32(mutant.name.encode())))
        self.say(f"{len(results) + len(scattered)} mutants, {len(results)} killed before")
        self.take_verdicts(scattered, self.judge, results, shard)
        # After the others: one that nobody notices takes as long as hundreds that somebody does.
        alive = [mutant for mutant in scattered if self.is_open(mutant, results[mutant.name])]
        if alive:
            self.say(f"{len(alive)} of them, which are not known, against all their tests")
        self.take_verdicts(alive, lambda mutant: self.judge_whole(mutant, results[mutant.name]),
                           results, shard)
        return results

    def take_verdicts(self, mutants, judge, results, shard):
        """judge(mutant) of each into `results`, by name, and its file of progress."""
        last = time.monotonic()
        for done, (mutant, result) in enumerate(
                in_parallel(self.options.jobs, judge, mutants), 1):
            results[mutant.name] = result
            if shard.kind == "whole":
                with open(self.options.dir / "progress.jsonl", "a", encoding="utf-8") as file:
                    file.write(json.dumps({"name": mutant.name, **result}) + "\n")
            if time.monotonic() - last > 15 or done == len(mutants):
                last = time.monotonic()
                alive = sum(not entry["killed"] for entry in results.values())
                self.say(f"{done} of {len(mutants)}, {alive} not noticed")


def main():
    """Entry point."""
    options = arguments()
    if not options.list:
        programs_of(options)  # of mistakes in them before the RTL is read
    shard = Shard()
    out = campaign_settings.writable(options.out) if shard.kind in ("whole", "merge") else None
    design = Design(models.rtl_files(), models.modules_of(options.part))
    known = Known(models.HERE / "survivors.yaml")
    chosen, run = wanted(options, design)
    if options.list:
        for mutant in run:
            print(f"{mutant.name:28} {mutant.kind:20} {mutant.shown()}")
        return
    campaign = Campaign(options, design, known, chosen)
    campaign.record()
    if shard.kind == "prepare":
        campaign.say(f"regression without a mutant: {campaign.baseline():.0f} s")
        return
    if shard.kind == "merge":
        results = {name: result for part in shard.read(options.dir)
                   for name, result in part.items()}
    else:
        results = campaign.judge_all(run, shard)
    if shard.kind == "part":
        shard.write(options.dir, results)
        return
    report = Report(design, known, run, results, campaign.seen, campaign.programs)
    report.show(options.mutant != [])
    if out:
        out.write_text(json.dumps(report.json(options), indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
