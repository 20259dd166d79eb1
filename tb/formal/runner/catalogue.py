# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""What is to be proven: tb/formal/<part>/proofs.yaml and the labelled properties it names."""

import re
from dataclasses import dataclass, field
from pathlib import Path

import yaml

METHODS = ("induction", "pdr", "bounded", "cover")
SOLVERS = ("z3", "boolector", "abc")
RULE = re.compile(r"\b[A-Z]{2}-\d{2,3}[a-z]?\b|\b(?:AHB|APB|AXI|FX|WB)-[A-Z0-9][\w.]*\w|"
                  r"\bflexcan\.md [0-9.]+\b")
LABEL = re.compile(r"^\s*([plmc]_[a-z0-9_]+)\s*:\s*(assert|assume|cover)\b")


class CatalogueError(Exception):
    """A mistake in a proofs.yaml or a property file, told in one line."""


@dataclass
class Property:
    """A labelled statement: p_ property, l_ lemma, m_ assumption, c_ cover."""

    label: str
    kind: str
    text: str
    rules: list

    @property
    def is_property(self):
        return self.label.startswith("p_")


@dataclass
class Mutant:
    """A textual change of one RTL file that has to break some properties."""

    name: str
    file: str
    old: str
    new: str
    breaks: list
    depth: int


@dataclass
class Proof:
    """One model and the properties that are proven on it together."""

    part: str
    name: str
    title: str
    top: str
    rtl: list
    splice: dict
    files: list
    params: dict
    method: str
    depth: int
    solver: str
    quick: bool
    memories: bool
    search: str
    timeout: int
    folder: Path
    properties: list = field(default_factory=list)
    mutants: list = field(default_factory=list)

    @property
    def id(self):
        return f"{self.part}.{self.name}"

    def checked(self):
        """The statements that the solver has to decide."""
        kind = "cover" if self.method == "cover" else "assert"
        return [p for p in self.properties if p.kind == kind]


def _take(entry, where, key, kind, default=None, required=False, allowed=None):
    value = entry.pop(key, None)
    if value is None:
        if required:
            raise CatalogueError(f"{where}: '{key}' is missing")
        return default
    if not isinstance(value, kind) or (kind is int and isinstance(value, bool)):
        raise CatalogueError(f"{where}: '{key}' is {value!r}, wanted: {kind.__name__}")
    if allowed and value not in allowed:
        raise CatalogueError(f"{where}: '{key}' is {value!r}, allowed: {', '.join(allowed)}")
    return value


def _no_more(entry, where):
    if entry:
        raise CatalogueError(f"{where}: unknown key '{next(iter(entry))}'")


def read_properties(path):
    """The labelled statements of a file; the comment above one names its rules."""
    found, comment, used = [], [], False
    for line in path.read_text(encoding="utf-8").splitlines():
        label = LABEL.match(line)
        if label:
            text = " ".join(comment)
            kind = {"assert": "assert", "assume": "assume", "cover": "cover"}[label[2]]
            found.append(Property(label[1], kind, text, RULE.findall(text)))
            used = True
        elif line.strip().startswith("//"):
            comment, used = ([] if used else comment), False
            comment.append(line.strip().lstrip("/ ").strip())
        elif re.match(r"^\s*(assert|assume|cover|restrict)\b", line):
            raise CatalogueError(f"{path}: a statement without a label: {line.strip()}")
        elif not used:
            comment = []
    return found


def _mutant(entry, where, labels):
    entry = dict(entry)
    name = _take(entry, where, "name", str, required=True)
    where = f"{where}, mutant {name}"
    mutant = Mutant(
        name, _take(entry, where, "file", str, required=True),
        _take(entry, where, "old", str, required=True),
        _take(entry, where, "new", str, required=True),
        _take(entry, where, "breaks", list, required=True), _take(entry, where, "depth", int))
    _no_more(entry, where)
    for label in mutant.breaks:
        if label not in labels:
            raise CatalogueError(f"{where}: no property '{label}', there are: {', '.join(labels)}")
    return mutant


def _proof(entry, part, folder):
    entry = dict(entry)
    where = f"{folder.name}/proofs.yaml"
    name = _take(entry, where, "name", str, required=True)
    where = f"{where}, {name}"
    mutants = _take(entry, where, "mutants", list, default=[])
    method = _take(entry, where, "method", str, required=True, allowed=METHODS)
    proof = Proof(
        part=part, name=name, folder=folder, method=method,
        title=_take(entry, where, "title", str, required=True),
        top=_take(entry, where, "top", str, required=True),
        rtl=_take(entry, where, "rtl", list, required=True),
        splice=_take(entry, where, "splice", dict, default={}),
        files=_take(entry, where, "files", list, default=[]),
        params=_take(entry, where, "params", dict, default={}),
        depth=_take(entry, where, "depth", int, default=1, required=method not in ("pdr",)),
        solver=_take(entry, where, "solver", str, default="z3", allowed=SOLVERS),
        quick=_take(entry, where, "quick", bool, default=False),
        memories=_take(entry, where, "memories", bool, default=False),
        search=_take(entry, where, "search", str, default="pdr" if method == "pdr" else "bmc",
                     allowed=("pdr", "bmc", "smt")),
        timeout=_take(entry, where, "timeout", int, default=600))
    _no_more(entry, where)
    if proof.solver == "abc" and method != "bounded":
        raise CatalogueError(f"{where}: solver abc is for method bounded")
    proof.splice = {module: [files] if isinstance(files, str) else files
                    for module, files in proof.splice.items()}
    for text in [name for names in proof.splice.values() for name in names] + proof.files:
        if not (folder / text).is_file():
            raise CatalogueError(f"{where}: no file {folder.name}/{text}")
        proof.properties += read_properties(folder / text)
    labels = [p.label for p in proof.properties]
    for label in labels:
        if labels.count(label) > 1:
            raise CatalogueError(f"{where}: label '{label}' twice")
    proof.mutants = [_mutant(m, where, labels) for m in mutants]
    _every_property_can_fail(proof, where)
    return proof


def _every_property_can_fail(proof, where):
    if proof.method == "cover":
        return
    broken = {label for mutant in proof.mutants for label in mutant.breaks}
    for prop in proof.properties:
        if prop.is_property and prop.label not in broken:
            raise CatalogueError(f"{where}: no mutant breaks '{prop.label}'")
        if prop.is_property and not prop.rules:
            raise CatalogueError(f"{where}: no rule in the comment above '{prop.label}'")
    if not proof.checked():
        raise CatalogueError(f"{where}: nothing to prove")


def load(root):
    """All proofs of all parts, in the order of their files."""
    proofs = []
    for path in sorted(Path(root).glob("*/proofs.yaml")):
        try:
            data = yaml.safe_load(path.read_text(encoding="utf-8"))
        except yaml.YAMLError as error:
            raise CatalogueError(f"{path}: {str(error).splitlines()[0]}") from error
        if not isinstance(data, dict) or not isinstance(data.get("proofs"), list):
            raise CatalogueError(f"{path}: wanted a list 'proofs:'")
        proofs += [_proof(entry, path.parent.name, path.parent) for entry in data["proofs"]]
    names = [p.id for p in proofs]
    for name in names:
        if names.count(name) > 1:
            raise CatalogueError(f"proof '{name}' twice")
    return proofs
