# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Asks the solvers: yosys-smtbmc (z3, boolector) on SMT-LIB, abc (pdr, bmc3) on AIGER."""

import re
import subprocess
import time
from dataclasses import dataclass, field


@dataclass
class Answer:
    """proven: all hold; refuted: a counterexample exists; unknown: out of time or error."""

    verdict: str
    detail: str
    seconds: float
    refuted: dict = field(default_factory=dict)  # label: clock


def _run(command, cwd, timeout, log):
    start = time.monotonic()
    try:
        run = subprocess.run(command, cwd=cwd, text=True, stdout=subprocess.PIPE, check=False,
                             stderr=subprocess.STDOUT, timeout=timeout)
        text = run.stdout
    except subprocess.TimeoutExpired as error:
        text = (error.stdout or b"").decode() + f"\nout of time after {timeout} s\n"
    (cwd / log).write_text(text, encoding="utf-8")
    return text, time.monotonic() - start


def _smtbmc(proof, out, options, log):
    # Clock by clock in one formula: what z3 decides in a second so may take it minutes otherwise.
    unroll = ["--unroll"] if proof.solver == "z3" else []
    command = ["yosys-smtbmc", "-s", proof.solver, *unroll, *options, "model.smt2"]
    text, seconds = _run(command, out, proof.timeout, log)
    status = re.search(r"Status: (\w+)", text)
    failed = re.findall(r"Assert failed in [^:]*: (\S+)", text)
    if not status:
        return Answer("unknown", f"no answer, see {out}/{log}", seconds)
    if status[1] == "PASSED":
        return Answer("proven", "", seconds)
    if status[1] == "FAILED" or failed:
        return Answer("refuted", ", ".join(failed), seconds)
    return Answer("unknown", f"{status[1]}, see {out}/{log}", seconds)


def bounded(proof, out, depth=None, vcd="counterexample.vcd"):
    """No counterexample within depth clocks of the initial states."""
    depth = depth or proof.depth
    return _smtbmc(proof, out, ["-t", str(depth + 1), "--dump-vcd", vcd], "bounded.log")


def induction(proof, out):
    """k-induction: base by bounded search, then the step."""
    base = bounded(proof, out)
    if base.verdict != "proven":
        return base
    step = _smtbmc(proof, out, ["-i", "-t", str(proof.depth), "--dump-vcd", "step.vcd"], "step.log")
    verdict = "proven" if step.verdict == "proven" else "unknown"
    detail = "" if verdict == "proven" else f"not inductive at depth {proof.depth}: {step.detail}"
    return Answer(verdict, detail, base.seconds + step.seconds)


def covers(proof, out):
    """Every cover is reached within depth clocks."""
    return _smtbmc(proof, out, ["-c", "-t", str(proof.depth + 1), "--dump-vcd", "cover%.vcd"],
                   "cover.log")


def _labels(out):
    lines = (out / "asserts.txt").read_text(encoding="utf-8").split()
    return [line.split("/")[-1].split(".")[-1] for line in lines]


# One output after the other; what one order of steps does not decide, another often does at once.
PDR = ("pdr -T 20", "scleanup; pdr -T 40", "scleanup; pdr -r -T 80", "pdr -n -c -T 120")


def _abc_output(out, steps, index, timeout):
    """Decides one output, without bound or to that of bmc3.

    Returns (proven?, clock of the counterexample or None, text).
    """
    text = ""
    for step in steps:
        merge = "scorr; " if step.startswith(("pdr", "scleanup")) else ""
        script = f"read_aiger model.aig; fold; strash; {merge}cone -s -O {index}; {step}"
        text, _ = _run(["yosys-abc", "-c", script], out, timeout, f"output{index}.log")
        found = re.search(r"was asserted in frame\s+(\d+)", text)
        if found:
            return False, int(found[1]), text
        if "Property proved" in text or re.search(r"No output asserted in \d+ frames", text):
            return True, None, text
    return False, None, text


def _all_proven(out, count, timeout):
    """Whether pdr proves all outputs at once: what they share it learns once. It says nothing of
    the others if one is false or hard."""
    script = "read_aiger model.aig; fold; strash; scorr; pdr -a -T 20"
    text, _ = _run(["yosys-abc", "-c", script], out, timeout, "all.log")
    return f"Properties:  All = {count}. Proved = {count}. " in text


def abc(proof, out, search, depth):
    """pdr (unbounded) or bmc3 (to depth) on each output; the answer names the refuted."""
    labels = _labels(out)
    start = time.monotonic()
    if search == "pdr" and not depth and len(labels) > 1 and _all_proven(out, len(labels),
                                                                         proof.timeout):
        return Answer("proven", "", time.monotonic() - start)
    limit = f" -F {depth}" if depth else ""
    steps = [f"{step}{limit}" for step in PDR] if search == "pdr" else [f"bmc3{limit or ' -F 100'}"]
    refuted, open_ = {}, []
    for index, label in enumerate(labels):
        proven, clock, _ = _abc_output(out, steps, index, proof.timeout)
        if clock is not None:
            refuted[label] = clock
        elif not proven:
            open_.append(label)
    seconds = time.monotonic() - start
    detail = ", ".join(f"{label} at clock {clock}" for label, clock in refuted.items())
    if open_:
        detail += ("; " if detail else "") + f"not decided: {', '.join(open_)}, see {out}"
    verdict = "refuted" if refuted else "unknown" if open_ else "proven"
    return Answer(verdict, detail, seconds, refuted)
