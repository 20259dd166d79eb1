#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Formal proofs of the RTL: proves what tb/formal/*/proofs.yaml names and shows, by mutants of
the RTL, that every property can fail. docs/formal.md tells how to add one."""

import argparse
import json
import math
import os
import sys
import time
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent))
sys.path.insert(1, str(Path(__file__).resolve().parents[1]))
import campaign_settings  # pylint: disable=wrong-import-position
from shards import Shard  # pylint: disable=wrong-import-position
from runner import catalogue, job, report  # pylint: disable=wrong-import-position

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent


def arguments():
    """The command line; the campaign's variables are its defaults."""
    env = os.environ
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--only", action="append", metavar="NAME",
                        help="a proof (engine.crc15) or a part (engine); may be repeated")
    parser.add_argument("--quick", action="store_true", help="only proofs marked quick")
    parser.add_argument("--mutants", type=int, nargs="?", const=sys.maxsize, default=0,
                        metavar="N", help="also demand that mutants are caught, all or N at most "
                        "of each proof")
    parser.add_argument("--mutant", metavar="NAME", help="only this mutant, no proof")
    parser.add_argument("--jobs", type=campaign_settings.JOBS.option, default=2,
                        help="at the same time (2)")
    parser.add_argument("--json", metavar="FILE", default=env.get("CAMPAIGN_OUT"),
                        help="write figures and tables there")
    parser.add_argument("--scratch", metavar="DIR", type=Path,
                        default=Path(env.get("CAMPAIGN_DIR", ROOT / "build" / "formal")),
                        help="models, logs, waveforms (build/formal)")
    parser.add_argument("--scale", type=campaign_settings.SCALES.option,
                        default=campaign_settings.scale(),
                        help="fraction of the proofs of each part, 0 < scale <= 1")
    parser.add_argument("--catalogue", type=Path, default=HERE, help=argparse.SUPPRESS)
    parser.add_argument("--list", action="store_true", help="show properties and assumptions")
    args = parser.parse_args()
    if args.mutants < 0:
        parser.error(f"--mutants is {args.mutants}, allowed: 1 or more")
    return args


def chosen(proofs, args):
    """The proofs that the options ask for."""
    if args.only:
        known = {p.id for p in proofs} | {p.part for p in proofs}
        for name in args.only:
            if name not in known:
                raise catalogue.CatalogueError(f"--only {name}: no such proof, see --list")
        proofs = [p for p in proofs if p.id in args.only or p.part in args.only]
    if args.quick:
        proofs = [p for p in proofs if p.quick]
    if args.scale < 1:
        proofs = sorted(proofs, key=lambda p: not p.quick)
        kept = []
        for part in sorted({p.part for p in proofs}):
            mine = [p for p in proofs if p.part == part]
            kept += mine[: max(1, math.ceil(args.scale * len(mine)))]
        proofs = kept
    if args.mutant and not any(m.name == args.mutant for p in proofs for m in p.mutants):
        raise catalogue.CatalogueError(
            f"--mutant {args.mutant}: none of the {len(proofs)} proofs has a mutant of that name; "
            "proofs.yaml of each part names them")
    return proofs


def show(proofs):
    """Every property with rules, and what is assumed."""
    for proof in proofs:
        print(f"{proof.id}: {proof.title} ({report.method_text(proof)})")
        for prop in proof.properties:
            print(f"  {prop.label}: {prop.text}")


def work(proofs, args, shard):
    """Runs the shard's jobs; returns their results."""
    rtl = ROOT / "rtl"
    jobs = []
    for proof in proofs:
        if not args.mutant:
            jobs.append((job.prove, (proof, rtl, args.scratch)))
    for proof in proofs:
        wanted = [m for m in proof.mutants if m.name == args.mutant] if args.mutant \
            else proof.mutants[:args.mutants]
        jobs += [(job.kill, (proof, mutant, rtl, args.scratch)) for mutant in wanted]
    jobs = shard.mine(jobs)
    results, last, started = [], 0.0, time.monotonic()
    with ThreadPoolExecutor(max_workers=args.jobs) as pool:
        futures = [pool.submit(function, *parameters) for function, parameters in jobs]
        for future in as_completed(futures):
            result = future.result()
            results.append(result)
            name = result.proof.id + (f" mutant {result.mutant.name}" if result.mutant else "")
            if not result.ok:
                print(f"FAILED  {name}: {result.detail}", flush=True)
            elif time.monotonic() - last > 10:
                last = time.monotonic()
                print(f"{last - started:5.0f} s  {len(results)} of {len(jobs)}  {name}", flush=True)
    return results


def put_down(results):
    """Results as JSON."""
    return [[r.proof.id, r.mutant and r.mutant.name, r.ok, r.detail, r.seconds] for r in results]


def taken_up(parts, proofs):
    """The results of all shards."""
    known = {proof.id: proof for proof in proofs}
    mutants = {(proof.id, mutant.name): mutant for proof in proofs for mutant in proof.mutants}
    return [job.Result(known[name], mutant and mutants[name, mutant], ok, detail, seconds)
            for part in parts for name, mutant, ok, detail, seconds in part]


def main():
    """Returns 0 if everything was proven and every mutant caught."""
    args = arguments()
    started = time.monotonic()
    try:
        proofs = chosen(catalogue.load(args.catalogue), args)
    except catalogue.CatalogueError as error:
        print(f"formal: {error}", file=sys.stderr)
        return 2
    if args.list:
        show(proofs)
        return 0
    args.scratch = args.scratch.resolve()
    args.scratch.mkdir(parents=True, exist_ok=True)
    shard = Shard()
    out = campaign_settings.writable(args.json) if shard.kind != "part" else None
    results = (taken_up(shard.read(args.scratch), proofs) if shard.kind == "merge"
               else work(proofs, args, shard))
    if shard.kind == "part":
        shard.write(args.scratch, put_down(results))
        return 0
    if not results:
        print("formal: nothing to do", file=sys.stderr)
        return 2
    wall = time.monotonic() - started
    print(report.table(proofs, results))
    bad = sum(not r.ok for r in results)
    print(f"{len(results)} jobs, {bad} failed, {wall:.0f} s")
    if out:
        text = json.dumps(report.as_json(proofs, results, wall), indent=1)
        out.write_text(text + "\n", encoding="utf-8")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
