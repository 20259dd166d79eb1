# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""From RTL and property files to what the solvers read. The RTL in rtl/ is never changed: the
properties are spliced into a copy of the module before its endmodule."""

import re
import shutil
import subprocess

PACKAGES = ("can_pkg.sv",)


class ModelError(Exception):
    """The model could not be built; the text says why in one line."""


def spliced(text, module, properties):
    pattern = re.compile(rf"\bmodule\s+{module}\b.*?^endmodule", re.S | re.M)
    found = pattern.search(text)
    if not found:
        raise ModelError(f"no module {module} in its file")
    end = found.end() - len("endmodule")
    return text[:end] + properties + text[end:]


def _mutated(text, mutant):
    if text.count(mutant.old) != 1:
        raise ModelError(f"mutant {mutant.name}: its text stands {text.count(mutant.old)} times "
                         f"in {mutant.file}, wanted: once")
    return text.replace(mutant.old, mutant.new)


def write_sources(proof, rtl_root, out, mutant=None):
    """Copies the RTL with properties and mutation into out; returns the file names in order."""
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    names, done = [], set()
    rtl = [p for p in PACKAGES if p not in proof.rtl] + proof.rtl
    for name in rtl:
        source = rtl_root / name
        if not source.is_file():
            raise ModelError(f"no file rtl/{name}")
        text = source.read_text(encoding="utf-8")
        if mutant and mutant.file == name:
            text = _mutated(text, mutant)
            done.add(mutant.file)
        for module, properties in proof.splice.items():
            if source.stem == module:
                text = spliced(text, module, "".join((proof.folder / file).read_text("utf-8")
                                                      for file in properties))
                done.add(module)
        (out / source.name).write_text(text, encoding="utf-8")
        names.append(source.name)
    for name in proof.files:
        shutil.copy(proof.folder / name, out / (proof.folder / name).name)
        names.append((proof.folder / name).name)
    for wanted in list(proof.splice) + ([mutant.file] if mutant else []):
        if wanted not in done:
            raise ModelError(f"{wanted} is not in 'rtl:'")
    return names


def _select(proof, only):
    """Keeps the statements of the method; with a mutant only those that it breaks."""
    if proof.method == "cover":
        return "chformal -assert -remove"
    lines = ["chformal -cover -remove"]
    if only:
        keep = " ".join(f"c:{label} c:*.{label} %u" for label in only)
        union = " %u" * (len(only) - 1)
        lines += [f"select -set kept {keep}{union}", "select -assert-any @kept",
                  "chformal -assert -remove t:$assert @kept %d"]
    return "; ".join(lines)


def build(proof, names, out, smt, aiger, only=None):
    """Runs Yosys: model.smt2 and/or model.aig in out."""
    params = " ".join(f"-chparam {key} {value}" for key, value in proof.params.items())
    memory = "memory -nomap; memory_unpack" if proof.memories and not aiger else "memory"
    script = [f"read_verilog -sv -formal {' '.join(names)}",
              f"hierarchy -check -top {proof.top} {params}", "proc", "flatten",
              _select(proof, only), "opt_expr; opt_clean; check", memory, "async2sync; opt_clean",
              # One clock only, and no latches: else the model would not be the circuit.
              "select -assert-none t:$dlatch t:$adlatch t:$sr", "opt -fast; dffunmap"]
    if smt:
        script.append("write_smt2 -wires model.smt2")
    if aiger:
        script += ["setundef -undriven -anyseq; setattr -unset keep; delete -output",
                   "opt -full; techmap; opt -fast; dffunmap; abc -g AND -fast; opt_clean",
                   # In the order of the outputs of the AIGER file.
                   "tee -q -o asserts.txt select -list t:$assert",
                   "write_aiger -I -B -zinit -no-startoffset -map model.aim model.aig"]
    (out / "model.ys").write_text("\n".join(script) + "\n", encoding="utf-8")
    run = subprocess.run(["yosys", "-q", "-l", "yosys.log", "model.ys"], cwd=out, text=True,
                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    if run.returncode:
        lines = [line for line in run.stdout.splitlines() if "ERROR" in line] or ["no message"]
        raise ModelError(f"yosys: {lines[0]} ({out}/yosys.log)")
