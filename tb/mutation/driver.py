#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Mutation score of the C code that synchronises clocks (docs/mutation.md).

Puts small errors into servo, CanTSyn, delay and masters, one at a time, and links each with the
tests of a release build, which must fail. What the compiler makes the same object of is no error.
"""
import argparse
import json
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.append(str(ROOT / "tb"))
import campaign_settings  # noqa: E402  pylint: disable=wrong-import-position

SOURCES = ("servo*.c", "tsyn*.c", "delay.c", "masters.c", "p4.c")
# The quickest first.
PROGRAMS = ("driver_servo_fit_test", "driver_servo_states_test", "driver_tsyn_test",
            "driver_delay_test", "driver_domain_follower_test", "driver_domain_master_test",
            "driver_servo_model_test", "driver_tsyn_model_test", "driver_timesync_test",
            "driver_sync_loop_test")
LIBRARY = "sw/driver/CMakeFiles/verican_driver_sanitized.dir/src"
SECONDS = 240      # of one program
FULL = 150         # mutants at scale 1

SWAPS = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==", "&&": "||",
         "||": "&&", "+": "-", "-": "+", "/": "*", "<<": ">>", ">>": "<<"}
OPERATOR = re.compile(r"(?<=[\w)\]]) (<<|>>|<=|>=|==|!=|&&|\|\||[<>+\-/]) (?=[\w(*&!-])")
NUMBER = re.compile(r"(?<![\w.#])(\d+)(u?)\b(?!\s*\))|(?<=[(, ])(\d+)(u?)(?=\))")
NEGATION = re.compile(r"(?<![\w!])!(?=[\w(])")
STATEMENT = re.compile(r"^\s+((?:\+\+|--)?[\w>.\[\]*-]+(?: [-+*/&|]?= .+|\(.*\)|\+\+)?;)$")


def candidates(path):
    """(line number, column, kind, mutated line) of a file, from its code alone."""
    comment = False
    for number, line in enumerate(path.read_text(encoding="utf-8").split("\n")):
        comment = comment or "/*" in line
        plain = not comment and not line.lstrip().startswith(("#", "static_assert", "_Static"))
        comment = comment and "*/" not in line
        if not plain:
            continue
        for match in OPERATOR.finditer(line):
            yield number, match.start(1), "operator", \
                line[:match.start(1)] + SWAPS[match[1]] + line[match.end(1):]
        for match in NUMBER.finditer(line):
            value = match[1] or match[3]
            start = match.start(1 if match[1] else 3)
            yield number, start, "constant", \
                line[:start] + str(int(value) + 1) + line[start + len(value):]
        for match in NEGATION.finditer(line):
            yield number, match.start(), "inversion removed", \
                line[:match.start()] + line[match.end():]
        match = STATEMENT.match(line)
        if match and not match[1].startswith(("return", "break", "continue")):
            yield number, match.start(1), "statement dropped", line[:match.start(1)] + ";"


class Build:
    """How the build directory makes objects and programs."""

    def __init__(self, directory):
        self.directory = pathlib.Path(directory).resolve()
        missing = [name for name in PROGRAMS if not (self.directory / "tb" / name).exists()]
        if missing:
            sys.exit(f"driver.py: not built: {' '.join(missing)}; cmake --build {directory} "
                     f"--target {' '.join(PROGRAMS)}")
        lines = subprocess.run(["ninja", "-C", self.directory, "-t", "commands", *PROGRAMS],
                               check=True, capture_output=True, text=True).stdout.split("\n")
        self.compile = {}
        self.link = {}
        for line in lines:
            match = re.search(rf"-o ({LIBRARY}/(\w+\.c)\.o)", line)
            if match:
                self.compile[match[2]] = line
            match = re.search(r"-o tb/(\w+_test) ", line)
            if match:
                self.link[match[1]] = line

    def shell(self, command, seconds=600):
        """Exit code; 124 if it takes too long."""
        try:
            return subprocess.run(command, shell=True, cwd=self.directory, check=False,
                                  stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                  timeout=seconds).returncode
        except subprocess.TimeoutExpired:
            return 124

    def object_of(self, source, name, out):
        """Compiles `source` as the driver's file `name`; false if it is no C."""
        command = re.sub(r"-c \S+", f"-c {source}", self.compile[name])
        command = re.sub(r"-o \S+\.o", f"-o {out}", command)
        command = re.sub(r"-M[DT] |-M[TF] \S+ ", "", command)
        include = f"-I{ROOT / 'sw/driver/src'} "
        return self.shell(command.replace(" -c ", f" {include}-w -Wno-error -c ")) == 0

    def program(self, name, mutated, out):
        """The test with the mutated object in place of the library's."""
        command = re.sub(rf"-o tb/{name} ", f"-o {out} {mutated} ", self.link[name])
        return self.shell(command) == 0


def judge(build, path, mutant, work):
    """What becomes of one mutant: a program that failed, "no C", "the same" or None."""
    number, _, _, text = mutant
    lines = path.read_text(encoding="utf-8").split("\n")
    objects = []
    for name, line in (("before", lines[number]), ("after", text)):
        changed = lines[:number] + [line] + lines[number + 1:]
        source = work / path.name
        source.write_text("\n".join(changed), encoding="utf-8")
        out = work / f"{name}.o"
        if not build.object_of(source, path.name, out):
            return "no C"
        objects.append(out)
    if objects[0].read_bytes() == objects[1].read_bytes():
        return "the same"
    for program in PROGRAMS:
        test = work / program
        if not build.program(program, objects[1], test):
            sys.exit(f"driver.py: {program} cannot be linked")
        if build.shell(f"cd {ROOT} && {test} --gtest_fail_fast", SECONDS) != 0:
            return program
    return None


def main():
    """Entry point."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build", default=ROOT / "build/release", help="with the tests built")
    parser.add_argument("--seed", type=campaign_settings.SEEDS.option,
                        default=campaign_settings.seed())
    parser.add_argument("--scale", type=campaign_settings.SCALES.option,
                        default=campaign_settings.scale(),
                        help=f"part of {FULL} mutants, above 0 up to 1")
    parser.add_argument("--file", action="append", default=[], help="only this one: servo.c")
    parser.add_argument("--out", default=os.environ.get("CAMPAIGN_OUT"), help="JSON of the results")
    options = parser.parse_args()
    out = campaign_settings.writable(options.out)
    folder = ROOT / "sw/driver/src"
    files = sorted(path for pattern in SOURCES for path in folder.glob(pattern))
    files = [path for path in files if not options.file or path.name in options.file]
    every = [(path, mutant) for path in files for mutant in candidates(path)]
    random.Random(options.seed).shuffle(every)
    build = Build(options.build)
    wanted, killed, alive, same = round(FULL * options.scale), 0, [], 0
    with tempfile.TemporaryDirectory() as work:
        for path, mutant in every:
            if killed + len(alive) == wanted:
                break
            verdict = judge(build, path, mutant, pathlib.Path(work))
            shown = f"{path.name}:{mutant[0] + 1}.{mutant[1] + 1} {mutant[2]}: {mutant[3].strip()}"
            if verdict is None:
                alive.append(shown)
                print(f"lives: {shown}", flush=True)
            elif verdict == "the same":
                same += 1
            elif verdict != "no C":
                killed += 1
    total = killed + len(alive)
    score = killed / total if total else 1.0
    print(f"{killed} of {total} noticed, {100 * score:.1f} %; {same} more are the same to the "
          f"compiler; of {len(every)} that could be made, seed {options.seed}")
    if out:
        figures = [{"name": "mutants of the driver's synchronisation", "value": total},
                   {"name": "noticed", "value": killed, "text": f"{100 * score:.1f} %"}]
        out.write_text(json.dumps({"figures": figures, "tables": [], "notes": alive}, indent=1),
                       encoding="utf-8")


if __name__ == "__main__":
    main()
