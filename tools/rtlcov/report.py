# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Tables and figures of a coverage run."""
KINDS = ("line", "branch", "toggle")
BAR = 99.0


def tally(counts, excluded):
    """file -> kind -> [hit, reachable, excluded]."""
    result = {}
    for point, count in counts.items():
        kinds = result.setdefault(point.file, {kind: [0, 0, 0] for kind in KINDS})
        cell = kinds[point.kind]
        if point in excluded:
            cell[2] += 1
        else:
            cell[0] += count > 0
            cell[1] += 1
    return result


def total(files):
    return {kind: [sum(f[kind][i] for f in files.values()) for i in range(3)] for kind in KINDS}


def percent(cell):
    return 100.0 * cell[0] / cell[1] if cell[1] else 100.0


def shown(cell):
    # Cut, not rounded: 100.0 means all.
    return f"{int(percent(cell) * 10) / 10:5.1f} % {cell[0]:5}/{cell[1]:<5}"


def text(files):
    lines = ["  line                branch              toggle              excluded  file"]
    for name, kinds in sorted(files.items()) + [("all", total(files))]:
        out = sum(kinds[kind][2] for kind in KINDS)
        lines.append("  " + "  ".join(shown(kinds[kind]) for kind in KINDS) + f"  {out:8}  {name}")
    return "\n".join(lines)


def missed(counts, excluded):
    points = [p for p, count in counts.items() if not count and p not in excluded]
    return [f"{p.file}:{p.line}: {p.kind} {p.what}" for p in sorted(points)]


def figures(files, exclusions, complete):
    """The campaign's figures; a part of the tests is not held against the bar."""
    result = []
    for kind, cell in total(files).items():
        value = percent(cell)
        result.append({"name": f"RTL {kind} coverage", "value": round(value, 2),
                       "text": f"{int(value * 100) / 100} % ({cell[0]} of {cell[1]} reachable)",
                       "bar": f">= {BAR:g} % of reachable",
                       "ok": value >= BAR if complete else None})
    for because in sorted({e.because for e in exclusions}):
        points = {p for e in exclusions if e.because == because for p in e.points}
        result.append({"name": f"RTL points excluded: {because}", "value": len(points),
                       "bar": "each with a reason, none hit", "ok": True})
    return result


def tables(files):
    rows = [[name] + [shown(kinds[kind]).strip() for kind in KINDS]
            + [sum(kinds[kind][2] for kind in KINDS)]
            for name, kinds in sorted(files.items()) + [("all", total(files))]]
    return [{"title": "RTL coverage", "columns": ["file", *KINDS, "excluded"], "rows": rows}]
