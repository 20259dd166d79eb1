# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Results as a table for people and as JSON for the campaign."""

METHOD = {"induction": "induction, depth", "pdr": "pdr, unbounded", "bounded": "bounded, clocks",
          "cover": "cover, clocks"}


def method_text(proof):
    """How it was proven, with the bound."""
    text = METHOD[proof.method]
    return text if proof.method == "pdr" else f"{text} {proof.depth}"


def rows(proofs, results):
    """One row a proof: name, statements, method, verdict, mutants, seconds."""
    table = []
    for proof in proofs:
        mine = [r for r in results if r.proof is proof]
        main = [r for r in mine if r.mutant is None]
        mutants = [r for r in mine if r.mutant is not None]
        rules = sorted({rule for p in proof.properties for rule in p.rules})
        verdict = "-" if not main else "proven" if main[0].ok else "NOT PROVEN"
        caught = f"{sum(r.ok for r in mutants)}/{len(mutants)}" if mutants else "-"
        table.append([proof.id, str(sum(p.label[0] in "pc" for p in proof.properties)),
                      " ".join(rules), method_text(proof), verdict, caught,
                      f"{sum(r.seconds for r in mine):.1f}"])
    return table


COLUMNS = ["proof", "properties", "rules", "method", "verdict", "mutants caught", "solver s"]


def table(proofs, results):
    """The rows in columns."""
    lines = [COLUMNS] + rows(proofs, results)
    shown = [0, 1, 3, 4, 5, 6]
    widths = [max(len(line[i]) for line in lines) for i in shown]
    return "\n".join("  ".join(line[i].ljust(w) for i, w in zip(shown, widths)).rstrip()
                     for line in lines)


def _figure(name, value, total, bar="all"):
    return {"name": name, "value": value, "text": f"{value} of {total}", "bar": bar,
            "ok": value == total}


def as_json(proofs, results, wall):
    """The campaign's form: figures, tables, notes."""
    figures = []
    for part in sorted({p.part for p in proofs}):
        for method in METHOD:
            mine = [p for p in proofs if p.part == part and p.method == method]
            total = sum(p.label[0] in "pc" for proof in mine for p in proof.properties)
            good = sum(p.label[0] in "pc" for r in results if r.proof in mine and r.ok
                       and r.mutant is None for p in r.proof.properties)
            if total:
                words = {"induction": "proven by induction", "pdr": "proven without bound by pdr",
                         "bounded": "hold to their bound", "cover": "situations reached"}[method]
                figures.append(_figure(f"formal {part}: properties {words}"
                                       if method != "cover" else f"formal {part}: {words}",
                                       good, total))
        mutants = [r for r in results if r.proof.part == part and r.mutant is not None]
        if mutants:
            figures.append(_figure(f"formal {part}: mutants caught", sum(r.ok for r in mutants),
                                   len(mutants)))
    figures.append({"name": "formal: wall time", "value": round(wall, 1), "text": f"{wall:.0f} s",
                    "bar": None, "ok": None})
    properties = [[proof.id, p.label, " ".join(p.rules), p.text] for proof in proofs
                  for p in proof.properties if p.label[0] in "pc"]
    return {"figures": figures,
            "tables": [{"title": "Formal proofs", "columns": COLUMNS,
                        "rows": rows(proofs, results)},
                       {"title": "Formal properties",
                        "columns": ["proof", "property", "rules", "meaning"], "rows": properties}],
            "notes": [f"{r.proof.id}{'.' + r.mutant.name if r.mutant else ''}: {r.detail}"
                      for r in results if not r.ok]}
