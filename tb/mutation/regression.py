# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# The tests that must notice a mutant: GoogleTest programs, run with limits.
"""programs() names them, Regression runs their tests with and without a mutant, whole
(harness/depth.hpp).

A program with @BUS behind its name runs with the core behind that bus (harness/bus_run.sh)."""
import concurrent.futures
import os
import pathlib
import resource
import subprocess
import tempfile
import time

# Folders of tb/ whose tests are about a part of the RTL, and which programs in them are.
FOLDERS = {
    "core": [("unit", "can_"), ("mailbox", ""), ("protocol", ""), ("driver", ""),
             ("system", "bus_"), ("faults", ""), ("random", "random_"), ("time", "")],
    "remote": [("unit", "can_rn_"), ("remote", "port_"), ("remote", "rtl_"),
               ("remote", "unit_same_id")],
    "time": [("unit", "can_clock"), ("unit", "can_time"), ("time", "")],
    "buses": [("mailbox", "bus_")]}
# Not with mutants: that a model rests, which one with mutants in it does not; and first contents of
# a RAM, which a build of changed RTL leaves out (tb/CMakeLists.txt).
NOT_OF_RTL = {"time_rest_test", "rtl_init_test"}
# Of a part: programs that are also run with the core behind each of the buses.
BEHIND = {"buses": (("apb", "axil", "axil_slow", "wb", "wb_pipelined", "wb_stalled"),
                    [("driver", "driver_load_test"), ("driver", "driver_traffic_test")])}
SANITIZED = ("driver", "time")   # folders whose programs link the sanitized driver
CPU_SECONDS = 6        # of one program, and more for tests that take long without a mutant
CPU_FACTOR = 5
MEMORY = 2 << 30       # bytes
OUTPUT = 16 << 20      # bytes, of one program


def programs(root, part="core"):
    """(folder, name) of the test programs of a part, in a fixed order."""
    out = []
    for folder, prefix in FOLDERS[part]:
        for source in sorted((root / "tb" / folder).glob(f"{prefix}*_test.cpp")):
            if source.stem not in NOT_OF_RTL:
                out.append((folder, source.stem))
    buses, names = BEHIND.get(part, ((), ()))
    return out + [(folder, f"{name}@{bus}") for folder, name in names for bus in buses]


def target(program):
    """The program itself, without its bus."""
    return program.partition("@")[0]


class Outcome:
    """What became of one run of a program: passed, or why not."""

    def __init__(self, passed, reason, test, seconds):
        self.passed, self.reason, self.test, self.seconds = passed, reason, test, seconds


def limits(cpu, sanitized):
    """Called in the child: a mutant may hang or eat memory."""
    resource.setrlimit(resource.RLIMIT_CPU, (cpu, cpu + 1))
    if not sanitized:                   # a sanitizer maps terabytes, and has a limit of its own
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_FSIZE, (OUTPUT, OUTPUT))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def failed_test(text, code):
    """Name of the test that failed, or the last one that began."""
    for mark in ("[  FAILED  ] ", "[ RUN      ] "):
        found = [line[len(mark):] for line in text.splitlines() if line.startswith(mark)]
        if found:
            return (found[0] if code == 1 else found[-1]).split(",")[0].split(" (")[0]
    return "?"


class Regression:
    """Test programs of one build directory, run from the project's root."""

    def __init__(self, root, build):
        self.root, self.build = pathlib.Path(root), pathlib.Path(build)
        self.sanitized = {name for part in FOLDERS for folder, name in programs(root, part)
                          if folder in SANITIZED}

    def path(self, program):
        """Where the build has put it: beside the others, or in a folder of its own."""
        name = target(program)
        direct = self.build / "tb" / name
        found = [direct] if direct.exists() else sorted(self.build.glob(f"tb/*/{name}"))
        if not found:
            raise FileNotFoundError(f"{self.build}: {program} has not been built")
        return found[0]

    def run(self, program, tests, environment, expected):
        """Runs tests of a program until one fails; expected: CPU seconds without a mutant."""
        cpu = int(CPU_SECONDS + CPU_FACTOR * expected)
        command = [self.path(program), "--gtest_fail_fast", "--gtest_brief=0"]
        if tests is not None:
            command.append("--gtest_filter=" + ":".join(tests))
        sanitized = program in self.sanitized
        environment = {**os.environ, **environment, "VERICAN_WHOLE_TESTS": "1",
                       "ASAN_OPTIONS": f"hard_rss_limit_mb={MEMORY >> 20}"}
        if "@" in program:
            environment["VERICAN_TEST_BUS"] = program.partition("@")[2]
        begin = time.monotonic()
        # A killed program cannot clear up after itself.
        with tempfile.TemporaryFile() as output, tempfile.TemporaryDirectory() as work:
            environment["TMPDIR"] = work
            result = subprocess.Popen(command, stdout=output, stderr=subprocess.STDOUT,
                                      stdin=subprocess.DEVNULL, cwd=self.root,
                                      env=environment,
                                      preexec_fn=lambda: limits(cpu, sanitized))
            _, status, usage = os.wait4(result.pid, 0)
            result.returncode = code = os.waitstatus_to_exitcode(status)
            output.seek(0)
            text = output.read().decode(errors="replace")
        seconds = time.monotonic() - begin
        used = usage.ru_utime + usage.ru_stime
        if code == 0 and "[  PASSED  ]" in text:
            return Outcome(True, "", "", used)
        reason = "failed" if code == 1 else "hang" if used >= cpu - 0.5 else f"stopped ({code})"
        return Outcome(False, reason, f"{program}: {failed_test(text, code)}", max(used, 0.0)
                       if used else seconds)

    def tests_of(self, program):
        """Names of the tests of a program."""
        text = subprocess.run([self.path(program), "--gtest_list_tests"], check=True,
                              capture_output=True, text=True, cwd=self.root).stdout
        out, suite = [], ""
        for line in text.splitlines():
            name = line.split("#")[0].rstrip()
            if line.startswith("  "):
                out.append(suite + name.strip())
            elif name.endswith("."):
                suite = name
        if "@" in program:                 # buses are those of the largest core
            out = [name for name in out if "16" not in name and "32" not in name]
        return [name for name in out if "DISABLED_" not in name]


def in_parallel(jobs, function, items):
    """function(item) for all items, jobs at a time; yields (item, result) as they come."""
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        futures = {pool.submit(function, item): item for item in items}
        for future in concurrent.futures.as_completed(futures):
            yield futures[future], future.result()
