# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Asks the solvers: yosys-smtbmc (z3, boolector) on SMT-LIB, abc (pdr, bmc3) on AIGER."""

import re
import subprocess
import time
from dataclasses import dataclass


@dataclass
class Answer:
    """proven: all hold; refuted: a counterexample exists; unknown: out of time or error."""

    verdict: str
    detail: str
    seconds: float


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
    command = ["yosys-smtbmc", "-s", proof.solver, *options, "model.smt2"]
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


def abc(proof, out, search, depth, outputs):
    """pdr (unbounded) or bmc3 (to depth) on all outputs; how many were refuted counts."""
    limit = f"-F {depth} " if depth else ""
    engine = f"pdr -a {limit}" if search == "pdr" else f"bmc3 -a {limit or '-F 100 '}"
    script = f"read_aiger model.aig; fold; strash; {engine}"
    text, seconds = _run(["yosys-abc", "-c", script], out, proof.timeout, f"{search}.log")
    refuted = len(set(re.findall(r"Output (\d+) was asserted in frame", text)))
    frames = [int(f) for f in re.findall(r"was asserted in frame\s+(\d+)", text)]
    detail = f"{refuted} of {outputs} outputs refuted" + (f" by clock {max(frames)}" if frames else "")
    if refuted >= outputs:
        return Answer("refuted", detail, seconds), refuted
    if refuted == 0 and search == "pdr" and "Verification of invariant" in text \
            and "was successful" in text:
        return Answer("proven", "", seconds), refuted
    return Answer("refuted" if refuted else "unknown", detail + f", see {out}/{search}.log",
                  seconds), refuted
