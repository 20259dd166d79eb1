# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Test docs.first_bus: the reader of docs/first-bus.md sees what the page says.
"""usage: first_bus.py SOURCE BUILD VERICAN

Runs the page from top to bottom in an empty directory:
  ```yaml after "Save this as `NAME`:" or "Append to `NAME`:" is a file
  ```console holds "$ command" lines and what each prints; the line "..." stands for any lines
  ```sh is how to build: done already, so only that its targets and presets exist is checked
"""
import difflib
import json
import pathlib
import re
import subprocess
import sys
import tempfile

BLOCK = re.compile(r"(?P<before>[^\n]*)\n\n```(?P<kind>\w+)\n(?P<text>.*?)^```$",
                   re.DOTALL | re.MULTILINE)


class Wrong(Exception):
    """What the page says is not so."""


def run(command, cwd):
    """Exit code and output of a shell command."""
    done = subprocess.run(["bash", "-c", command], cwd=cwd, stdin=subprocess.DEVNULL, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=120,
                          check=False)
    return done.returncode, done.stdout


def check_build(text, source, build):
    """Every line of the recipe names something that is there."""
    presets = json.loads((source / "CMakePresets.json").read_text())["configurePresets"]
    for line in text.splitlines():
        words = line.split()
        if words[:2] == ["git", "clone"] or words[0] == "cd":
            good = True
        elif words[0] == "make":
            good = run(f"make -n {words[1]}", source)[0] == 0
        elif words[:2] == ["cmake", "--preset"]:
            good = any(preset["name"] == words[2] for preset in presets)
        elif words[:2] == ["cmake", "--build"]:
            good = words[2] == "build/release" and words[3] == "--target" and \
                run(f"ninja -C {build} -t query {words[4]}", source)[0] == 0
        else:
            good = False
        if not good:
            raise Wrong(f"cannot follow this line of the recipe: {line}")


def check_console(text, work):
    """Runs the commands of a block, compares what they print; returns their number."""
    steps = re.findall(r"^\$ (.*)\n((?:(?!\$ ).*\n)*)", text, re.MULTILINE)
    if not steps:
        raise Wrong(f"no command in:\n{text}")
    for command, expected in steps:
        code, output = run(command, work)
        if code != 0:
            raise Wrong(f"$ {command}\nends with {code}:\n{output}")
        pattern = "".join(r"(?:.*\n)*" if line == "..." else re.escape(line) + r"\n"
                          for line in expected.rstrip("\n").splitlines())
        if not re.fullmatch(pattern, re.sub(r"\n+$", "\n", output)):
            raise Wrong(f"$ {command}\n" + "\n".join(difflib.unified_diff(
                expected.splitlines(), output.splitlines(), "the page", "the tool", lineterm="")))
    return len(steps)


def follow(page, source, build, work):
    """The whole page; returns how many commands were run."""
    commands = files = 0
    for block in BLOCK.finditer(page):
        before, kind, text = block.group("before", "kind", "text")
        to_file = re.fullmatch(r"(Save this as|Append to) `([\w.-]+)`:", before)
        if kind == "yaml" and to_file:
            files += 1
            with open(work / to_file[2], "w" if to_file[1][0] == "S" else "a",
                      encoding="utf-8") as file:
                file.write(text)
        elif kind == "console":
            commands += check_console(text, work)
        elif kind == "sh":
            check_build(text, source, build)
        else:
            raise Wrong(f"a block of {kind} after '{before}': what is it?")
    if commands < 4 or files < 2 or page.count("```") != 2 * len(BLOCK.findall(page)):
        raise Wrong(f"only {commands} commands and {files} files found on the page")
    return commands


def main():
    """Follows the page with the tool VERICAN as build/release/verican."""
    source, build, verican = (pathlib.Path(arg).resolve() for arg in sys.argv[1:4])
    page = (source / "docs" / "first-bus.md").read_text(encoding="utf-8")
    with tempfile.TemporaryDirectory(prefix="verican-first-bus-") as work:
        tool = pathlib.Path(work) / "build" / "release" / "verican"
        tool.parent.mkdir(parents=True)
        tool.symlink_to(verican)
        try:
            print(f"{follow(page, source, build, pathlib.Path(work))} commands")
        except Wrong as error:
            sys.exit(f"docs/first-bus.md: {error}")


main()
