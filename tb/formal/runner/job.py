# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""One piece of work: a proof, or a mutant of it that has to be caught."""

from dataclasses import dataclass

from . import model, solve


@dataclass
class Result:
    """What became of a job; ok is what was hoped for."""

    proof: object
    mutant: object
    ok: bool
    detail: str
    seconds: float


def prove(proof, rtl_root, scratch):
    """Proves all statements of the proof by its method; a counterexample is kept as VCD."""
    out = scratch / proof.id
    try:
        names = model.write_sources(proof, rtl_root, out)
        pdr = proof.method == "pdr" or proof.solver == "abc"
        model.build(proof, names, out, smt=not pdr, aiger=pdr)
        if proof.method == "induction":
            answer = solve.induction(proof, out)
        elif proof.method == "bounded" and not pdr:
            answer = solve.bounded(proof, out)
        elif proof.method == "cover":
            answer = solve.covers(proof, out)
        else:
            answer = solve.abc(proof, out, *(("pdr", 0) if proof.method == "pdr"
                                             else ("bmc", proof.depth + 1)))
            if answer.verdict == "refuted":
                answer = _explain(proof, names, out, answer)
    except model.ModelError as error:
        return Result(proof, None, False, str(error), 0.0)
    ok = answer.verdict == "proven"
    detail = answer.detail
    if answer.verdict == "refuted":
        detail = f"REFUTED: {detail}, {out}/counterexample.vcd"
    return Result(proof, None, ok, detail, answer.seconds)


def _explain(proof, names, out, answer):
    """A waveform of what pdr has found: bounded search to the clock that it names."""
    model.build(proof, names, out, smt=True, aiger=False)
    found = solve.bounded(proof, out, depth=min(answer.refuted.values()) + 1)
    return found if found.verdict == "refuted" else answer


def kill(proof, mutant, rtl_root, scratch):
    """The mutant is caught if every property that it has to break has a counterexample."""
    out = scratch / f"{proof.id}.{mutant.name}"
    depth = mutant.depth or (0 if proof.search == "pdr" else max(20, proof.depth + 1))
    try:
        names = model.write_sources(proof, rtl_root, out, mutant)
        smt = proof.search == "smt"
        # With smt one property at a time: the search ends at the first that fails.
        groups = [[label] for label in mutant.breaks] if smt else [mutant.breaks]
        seconds, missed = 0.0, []
        for group in groups:
            model.build(proof, names, out, smt=smt, aiger=not smt, only=group)
            if smt:
                answer = solve.bounded(proof, out, depth)
            else:
                answer = solve.abc(proof, out, proof.search, depth)
            seconds += answer.seconds
            caught = group if smt and answer.verdict == "refuted" else answer.refuted
            if set(group) - set(caught):
                missed.append(f"not refuted: {', '.join(group)}: {answer.detail}")
    except model.ModelError as error:
        return Result(proof, mutant, False, str(error), 0.0)
    return Result(proof, mutant, not missed, "; ".join(missed), seconds)
