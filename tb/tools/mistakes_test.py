#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Mistakes in the arguments, variables and files of a script are told in its own words, and what is
there is left as it is. One table; a row is a command line as a shell reads it, with variables in
front, the exit code and a part of what is said. {tmp}: a folder with the files of FILES; {rel}: the
same, as seen from the project's root."""

import os
import shlex
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SECONDS = "20"   # of one command; a script that takes longer has not seen the mistake
PLAN = "stages: [{name: toy, title: a toy, command: 'true', summary: none}]\n"
FILES = {
    "full/thesis.txt": "years of work\n",
    "two/verican-1.0.0.tar.gz": "", "two/verican-1.1.0.tar.gz": "",
    "sites/site/index.html": "another's\n", "sites/pages/index.md": "another's\n",
    "plan.yaml": PLAN, "no_stages.yaml": "3\n", "no_command.yaml": "stages: [{name: toy}]\n",
    "no_yaml.yaml": "stages: [\n", "nothing.yaml": "stages: []\n",
    "out/slurm/toy/0.done": "{}", "list.json": "[1]", "empty/can.core": "",
    "first/can.core": "CAPI=2:\nname: [\n",
    "build/tb/many_test": "#!/bin/sh\n"   # its list is longer than a pipe holds
                          "if [ \"$1\" = --gtest_list_tests ]; then\n"
                          "  seq -f '  Test%.0f' 200000\nelse\n"
                          "  sleep 0.1; touch \"$VERICAN_WAVE_DIR/x.fst\"\nfi\n",
    "build/tb/odd_test": "#!/bin/sh\nexit 3\n",
    # A PATH with one of the tools for iCE40, and what a script needs to get to the question.
    "few/dirname": "#!/bin/sh\necho tools\n",
    "few/python3": "#!/bin/sh\n[ \"$1\" != tools/dist.py ]\n",
    "few/icepack": "#!/bin/sh\n",
}
# What may not be there afterwards: a script has begun to work.
ABSENT = ("none", "out/toy.json")

NOT_ITS_OWN = "it is left as it is: name another folder, or remove it"
BUILDS = "no build nosuch; there are all, ahb_16"
USAGE = "usage: tools/"
TABLE = [
    # Folders that scripts write to.
    ("tools/site.py {tmp}/full", 1, NOT_ITS_OWN),
    ("tools/site.py {tmp}/sites", 1, NOT_ITS_OWN),
    ("tools/dist.py {tmp}/full", 1, NOT_ITS_OWN),
    ("tools/dist.py {tmp}/two", 1, NOT_ITS_OWN),
    ("tools/dist.py {tmp}/none --flat nosuch", 1, BUILDS),
    ("tools/dist.py {tmp}/none --flat all wb_16", 1, "all builds, or names of some, not both"),
    ("SOURCE_DATE_EPOCH=x tools/dist.py {tmp}/none", 1, "SOURCE_DATE_EPOCH is 'x'; allowed: sec"),
    ("SOURCE_DATE_EPOCH=-1 tools/dist.py {tmp}/none", 1, "SOURCE_DATE_EPOCH is '-1'; allowed"),
    ("tools/package.py /proc/x", 1, "package.py: /proc/x: No such file"),
    ("tools/package.py {tmp}/none --flat nosuch", 1, BUILDS),
    ("tools/constraints.py /proc/x", 1, "constraints.py: /proc/x: No such file"),
    # Names in constraints.
    ("tools/constraints.py {tmp}/none --rx ''", 1, "--rx '' is not the name of a port"),
    ("tools/constraints.py {tmp}/none --rx 'a} b'", 1, "--rx 'a} b' is not the name of a port"),
    ("tools/constraints.py {tmp}/none --tx 'a\"b'", 1, "--tx 'a\"b' is not the name of a port"),
    ("tools/constraints.py {tmp}/none --clock ''", 1, "--clock '' is not the name of a port"),
    ("tools/constraints.py {tmp}/none --instance 'a b{'", 1, "--instance 'a b{' is not the place"),
    ("tools/constraints.py {tmp}/none --instance u_can --rx a --tx b --mhz 0", 1,
     "--instance needs --reset, too"),
    ("tools/constraints.py {tmp}/none --rx a --tx a", 1, "--rx and --tx are both 'a'"),
    ("tools/constraints.py {tmp}/ports --mhz 0 --clock '' --reset '' --rx 'pads.can[3]' --tx t "
     "--instance 'g_soc[0].u_soc/u_can'", 0, ""),
    # Options of the Makefile that are on or off.
    ("make -n clean ALL=0", 0, "! -name linux"),
    ("make -n clean ALL=", 0, "! -name linux"),
    ("make -n clean ALL=1", 0, "-maxdepth 1  -exec rm"),
    ("make -n clean ALL=yes", 2, "ALL is 'yes'; allowed: 0 and 1"),
    ("make -n test-linux SHORT=0", 0, "build/linux \n"),
    ("make -n test-linux SHORT=1", 0, "build/linux --short\n"),
    ("make -n test-linux SHORT=no", 2, "SHORT is 'no'; allowed: 0 and 1"),
    ("make -n build V=0", 0, 'tools/quiet.sh "Building'),
    ("make -n build V=1", 0, 'tools/quiet.sh --show "Building'),
    ("V=on make -n build", 2, "V is 'on'; allowed: 0 and 1"),
    ("make -n campaign SLURM=0", 0, '--only "" \n'),
    ("make -n campaign SLURM=1", 0, '--only "" --slurm\n'),
    ("make -n campaign SLURM=no", 2, "SLURM is 'no'; allowed: 0 and 1"),
    ("make -n install PREFIX=", 2, "PREFIX is empty"),
    ("make -n install PREFIX=' '", 2, "PREFIX is empty"),
    ("PREFIX= JOBS= PRESET= make -n install", 0, "--prefix \"/usr/local\""),
    ("make -n install PREFIX='~/here'", 2, "PREFIX is '~/here'; allowed: a path without ~"),
    ("make -n install PREFIX={tmp}/in", 0, "--prefix \"{tmp}/in\""),
    ("make -n build JOBS=", 2, "JOBS is empty"),
    ("make -n build PRESET=", 2, "PRESET is empty"),
    ("tools/quiet.sh --show Saying echo hello", 0, "Saying\nhello\n"),
    # What would pass for a success.
    ("tools/install-packages.sh nosuch.txt", 2, "nosuch.txt: no such list"),
    ("BOARDS=' ' tools/boards.sh {tmp}/none", 2, "names no board; allowed: icestick, hx8k"),
    ("BOARDS=ice tools/boards.sh {tmp}/none", 2, "unknown board 'ice'; allowed: icestick, hx8k"),
    ("tools/driver-coverage.sh {tmp}/none abc", 2, "LIMIT is 'abc'; allowed: 0 to 100"),
    ("tools/driver-coverage.sh {tmp}/none 101", 2, "LIMIT is '101'; allowed: 0 to 100"),
    ("tools/driver-size.sh --chek", 2, "usage: tools/driver-size.sh [--check]"),
    ("tools/driver-size.sh --check more", 2, "usage: tools/driver-size.sh [--check]"),
    ("tools/campaign.py --page --out {tmp}/out", 1, "no result of a whole run"),
    ("tools/campaign.py --plan {tmp}/plan.yaml --out {tmp}/out --only ,", 1,
     "--only ',' names no stage; stages: toy"),
    ("tools/lint-sources.sh nosuch", 2, "no check 'nosuch'; there are licence_heads, line_le"),
    ("GIT_DIR={tmp}/none tools/lint-sources.sh licence_heads", 1, "not a git repository"),
    ("GIT_DIR={tmp}/none tools/lint-sources.sh line_length", 1, "not a git repository"),
    ("GIT_DIR={tmp}/none tools/lint-sources.sh comments", 1, "not a git repository"),
    ("GIT_DIR={tmp}/none tools/lint-sources.sh format", 1, "not a git repository"),
    ("bash -c '. tools/common.sh; our_files \"*.nosuch\"'", 1, "no files match: *.nosuch"),
    # Tools that are not there.
    ("bash -c '. tools/common.sh; all_there bash nosuch awk nix'", 1, "missing: nosuch nix\n"),
    ("bash -c '. tools/common.sh; all_there bash awk'", 0, ""),
    ("env PATH={tmp}/few /bin/bash tools/hx8k.sh {tmp}/none", 1,
     "missing: yosys nextpnr-ice40 icetime\n"),
    ("env PATH={tmp}/few /bin/bash tools/boards.sh {tmp}/none", 1,
     "missing: yosys nextpnr-ice40 icebox_vlog\n"),
    ("env PATH={tmp}/few /bin/bash tools/dist.sh {tmp}/none", 1,
     "missing: nextpnr-ice40 icetime\ndist: no bitstream of examples/hx8k\n"),
    # Files and folders of the campaign.
    ("tools/campaign.py --plan {tmp}/nosuch", 1, "nosuch: No such file"),
    ("tools/campaign.py --plan {tmp}/no_yaml.yaml", 1, "no_yaml.yaml: while parsing"),
    ("tools/campaign.py --plan {tmp}/no_stages.yaml", 1, "no_stages.yaml: no list of stages"),
    ("tools/campaign.py --plan {tmp}/nothing.yaml --out {tmp}/none", 1, "nothing.yaml: no stages"),
    ("tools/campaign.py --plan {tmp}/no_command.yaml", 1, "a stage without title"),
    ("tools/campaign.py --plan {tmp}/plan.yaml --out /proc/x", 1, "--out /proc/x: No such file"),
    ("SBATCH='--comment=\"a' tools/campaign.py --plan {tmp}/plan.yaml --out {tmp}/out --slurm", 1,
     "SBATCH is '--comment=\"a', which are no words: No closing quotation"),
    # Waveforms.
    ("tools/wave.sh {rel}/build Test7", 0, "waveform: {tmp}/build/waves/x.fst"),
    ("tools/wave.sh {rel}/none Arb", 1, "no test program in {rel}/none/tb; run: make build"),
    # Output that cannot be written.
    *((f"bash -c 'tools/{script} >/dev/full'", 1, f"{script.split()[0]}: No space left on device\n")
      for script in ("profiles.py", "profiles.py small", "flexcan_rows.py --check",
                     "rules.py --check", "remote_rules.py --check", "time_rules.py --check",
                     "core_check.py")),
    ("bash -c 'set -o pipefail; (sleep 1; tools/profiles.py) | true'", 1, ""),
    ("bash -c 'set -o pipefail; (sleep 1; tools/package.py {tmp}/written) | true'", 1, ""),
    # Names that are not there.
    ("SEEDS=x OUT={tmp}/none tools/synth.sh", 2, "SEEDS is 'x'; allowed: whole numbers"),
    ("SEEDS=' ' OUT={tmp}/none tools/synth.sh", 2, "SEEDS is ' '; allowed: whole numbers"),
    ("SEEDS='1 -2' OUT={tmp}/none tools/synth.sh", 2, "SEEDS is '1 -2'; allowed: whole numbers"),
    ("tools/families.py all ecp5", 1, "either all families, or names of some, not both"),
    ("tools/families.py nosuch --check", 1, "no family nosuch; there are all, ice40"),
    ("tb/formal/run.py --only engine.crc15 --mutant nosuch --scratch {tmp}/none", 2,
     "--mutant nosuch: none of the 1 proofs has a mutant of that name"),
    ("tb/four_state/run.py --jobs 0", 2, "--jobs 0: at least 1 is needed"),
    ("tb/mutation/run.py --dir /proc/x", 2, "--dir /proc/x: No such file"),
    ("tb/mutation/run.py --part time --scale 0.01 --no-build --build {tmp}/bare", 1,
     "--no-build: {tmp}/bare: can_clock_test has not been built"),
    ("python3 -B sw/linux/run.py --jobs 0", 2, "--jobs 0: at least 1 is needed"),
    ("python3 -B sw/linux/run.py --timeout -1", 2, "--timeout -1: at least 1 is needed"),
    ("python3 -B sw/linux/run.py --only '('", 2, "--only '(': no regular expression: missing"),
    ("examples/robot/firmware.py {tmp} --verican {tmp}/nosuch", 1,
     "firmware.py: {tmp}/nosuch: No such file or directory; --verican says where the tool is"),
    ("examples/remote/cabinet.py --verican {tmp}/nosuch", 2, "--verican says where the tool is"),
    # Files that are something else.
    ("tools/svd_check.py README.md", 1, "README.md: no XML: not well-formed"),
    ("tools/core_check.py {tmp}/empty", 1, "core: it needs name, filesets, parameters, targets"),
    ("tools/core_check.py {tmp}/first", 1, "can.core: while parsing"),
    ("tools/bench_page.py {tmp}/nosuch {tmp}/none", 1, "has no medians in a *_bench.json"),
    ("python3 -B sw/litex/verican/dts.py {tmp}/list.json", 1, "list.json: no csr.json of LiteX's"),
    # No arguments.
    ("tools/bench.sh", 2, USAGE + "bench.sh BUILD"),
    ("tools/boards-test.sh build", 2, USAGE + "boards-test.sh BUILD BOARDS ["),
    ("tools/demo.sh build", 2, USAGE + "demo.sh BUILD OUT"),
    ("tools/dist.sh", 2, USAGE + "dist.sh OUT"),
    ("tools/lint-sources.sh", 2, USAGE + "lint-sources.sh CHECK"),
    ("tools/lint.sh", 2, USAGE + "lint.sh BUILD"),
    ("tools/linux-test.sh build 2", 2, USAGE + "linux-test.sh BUILD JOBS DIRECTORY ["),
    ("tools/quiet.sh Nothing", 2, USAGE + "quiet.sh [--show] WHAT COMMAND..."),
    ("tools/test.sh build", 2, USAGE + "test.sh BUILD JOBS"),
    ("tools/wave.sh", 2, "usage: make wave TEST="),
    ("tools/netlist/netlist.sh", 2, USAGE + "netlist/netlist.sh KIND OUT.v TOP"),
    ("tools/netlist/netlist.sh word {tmp}/none top more and more", 2, USAGE + "netlist/netlist.sh"),
    ("tools/netlist/netlist.sh word {tmp}/none top A=1 --", 2, USAGE + "netlist/netlist.sh"),
]
# sw/profiles.yaml: what is in it for what, and what is said of it.
SMALL = "parameters: {NumMb: 64}"
PROFILES = [
    (SMALL, "parameters: {NumMb: 17}", "sw/profiles.yaml: full: NumMb: '17' is not one of 16, 32"),
    (SMALL, "parameters: {NumMb: 64, Fifoo: 0}", "sw/profiles.yaml: full: unknown key 'Fifoo'"),
    (SMALL, "parameters: {", "sw/profiles.yaml: while parsing"),
    ("profiles:", "profiles: 3\nothers:", "sw/profiles.yaml: file: unknown key 'others'"),
    (None, "profiles: 3\n", "sw/profiles.yaml: profiles: keys are expected here, not 3"),
]


def run(line):
    """Exit code and output of a command line. It gets what finds programs, but no variables of the
    make that runs the tests."""
    words = shlex.split(line)
    environment = {name: os.environ[name] for name in ("PATH", "HOME", "TMPDIR", "LANG")
                   if name in os.environ} | {"PYTHONDONTWRITEBYTECODE": "1"}
    while "=" in words[0]:
        name, _, environment[name] = words.pop(0).partition("=")
    done = subprocess.run(["timeout", SECONDS, *words], cwd=ROOT, env=environment, text=True,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, check=False)
    return done.returncode, done.stdout


class Mistakes(unittest.TestCase):
    """Every row of the tables."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = Path(folder.name).resolve()

    def told(self, line, code, said):
        """Runs a command line; it ends and speaks as it should."""
        found, text = run(line)
        for word in ("Traceback", "unbound variable"):
            self.assertNotIn(word, text)
        self.assertEqual(found, code, text)
        self.assertIn(said, text)

    def test_they_are_told_and_nothing_is_lost(self):
        for number, (line, code, said) in enumerate(TABLE):
            folder = self.path / str(number)
            for name, text in FILES.items():
                (folder / name).parent.mkdir(parents=True, exist_ok=True)
                (folder / name).write_text(text, encoding="utf-8")
                (folder / name).chmod(0o755)
            with self.subTest(line):
                for word, place in (("{tmp}", folder), ("{rel}", os.path.relpath(folder, ROOT))):
                    line, said = line.replace(word, str(place)), said.replace(word, str(place))
                self.told(line, code, said)
                for name, text in FILES.items():
                    self.assertEqual((folder / name).read_text(encoding="utf-8"), text, name)
                for name in ABSENT:
                    self.assertFalse((folder / name).exists(), name)

    def test_profiles_are_told_by_their_file(self):
        shutil.copytree(ROOT / "tools", self.path / "tools",
                        ignore=shutil.ignore_patterns("__pycache__"))
        (self.path / "sw").mkdir()
        shutil.copy(ROOT / "sw/registers.yaml", self.path / "sw")
        whole = (ROOT / "sw/profiles.yaml").read_text(encoding="utf-8")
        for old, new, said in PROFILES:
            self.assertEqual(whole.count(old or "profiles:"), 1)
            text = whole.replace(old, new) if old else new
            (self.path / "sw/profiles.yaml").write_text(text, encoding="utf-8")
            for script, code in (("registers.py --check", 2), ("profiles.py", 1)):
                with self.subTest(script, mistake=new):
                    self.told(f"{self.path}/tools/{script}", code, said)
        # Without them fewer builds would be checked.
        (self.path / "rtl").mkdir()
        shutil.copy(ROOT / "rtl/can.f", self.path / "rtl")
        self.told(f"{self.path}/tools/lint.sh {self.path}/none", 1, "lint: no profiles")


if __name__ == "__main__":
    unittest.main()
