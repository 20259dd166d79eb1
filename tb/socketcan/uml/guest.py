# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Boots one user-mode Linux with SocketCAN, from power-on to power-off, and leaves nothing behind.

The guest's root is the host's file system, read-only; a directory for results is mounted over
itself to be written. All its processes are in one session, its memory is a file without a name in
a directory of its own: both go with this process, however it ends (guard.py).
"""
import ctypes
import os
import platform
import shlex
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "sw/linux"))
from scratch import scratch  # noqa: E402  pylint: disable=wrong-import-position

KERNEL = Path("/usr/bin/linux.uml")
MODULES = Path("/usr/lib/uml/modules")
INIT = Path(__file__).resolve().parents[1] / "guest/init.sh"
GUARD = Path(__file__).resolve().parent / "guard.py"
TOOLS = ("busybox", "ip", "candump", "cansend", "cangen", "canplayer", "canbusload",
         "setpriv", "j1939acd", "j1939cat", "cangw")


class Impossible(Exception):
    """This machine cannot run a guest; the text says why."""


class Failed(Exception):
    """The guest did not do its work; the text says what was seen."""


def check_machine():
    """Raises Impossible if something that a guest needs is missing."""
    if platform.machine() != "x86_64":
        raise Impossible(f"user-mode Linux runs on x86-64 only, this is {platform.machine()}")
    if not os.access(KERNEL, os.X_OK) or not any(MODULES.glob("*/kernel/drivers/net/can/vcan.ko")):
        raise Impossible(f"{KERNEL} or its modules are missing (package user-mode-linux)")
    path = f"{os.environ.get('PATH', '')}:/usr/sbin:/sbin"
    missing = [tool for tool in TOOLS if not shutil.which(tool, path=path)]
    if missing:
        raise Impossible(f"not installed: {', '.join(missing)} (packages.txt)")


def ptrace_is_allowed():
    """True if a child may ask to be traced, which is what user-mode Linux stands on."""
    child = os.fork()
    if child == 0:
        result = ctypes.CDLL(None, use_errno=True).ptrace(0, 0, 0, 0)  # PTRACE_TRACEME
        os._exit(0 if result == 0 else 1)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0


def session_members(session):
    """Processes of a session, zombies left out."""
    members = []
    for entry in Path("/proc").iterdir():
        try:
            fields = (entry / "stat").read_text().rpartition(")")[2].split()
        except (OSError, ValueError):
            continue
        if entry.name.isdigit() and int(fields[3]) == session and fields[0] not in "ZX":
            members.append(int(entry.name))
    return members


def _command(directory, temporary, memory):
    return [str(KERNEL), f"mem={memory}", "rootfstype=hostfs", "rootflags=/", "ro", f"init={INIT}",
            "con=null", "con0=null,fd:1", "quiet", f"uml_dir={temporary}/",
            f"VERICAN_DIR={directory}", f"VERICAN_GUEST={INIT.parent}"]


def _explain_no_start(console):
    """A guest that never reached its first program: impossible here, or a failure?"""
    if not ptrace_is_allowed():
        raise Impossible("ptrace is not allowed here, and user-mode Linux stands on it")
    last = console.strip().splitlines()[-1:] or ["no output"]
    raise Failed(f"the guest did not start: {last[0]}")


def _furnish(directory, script, settings, files):
    """An empty directory with what the guest's script finds there."""
    shutil.rmtree(directory, ignore_errors=True)
    directory.mkdir(parents=True)
    values = {"VERICAN_SCRIPT": script, **(settings or {})}
    lines = [f"{key}={shlex.quote(str(value))}\n" for key, value in values.items()]
    (directory / "settings.sh").write_text("".join(lines))
    for name, text in (files or {}).items():
        (directory / name).write_bytes(text if isinstance(text, bytes) else text.encode())


def _run(directory, shim, limit, memory):
    """From power-on to power-off, or to the limit."""
    temporary = tempfile.mkdtemp(prefix="verican-uml-", dir=scratch())
    console = directory / "console.txt"
    environment = {**os.environ, "TMPDIR": temporary, "LD_PRELOAD": str(shim)}
    guard = subprocess.Popen([sys.executable, str(GUARD), temporary], stdin=subprocess.PIPE,
                             stdout=subprocess.PIPE)
    try:
        with open(console, "wb") as output:
            guest = subprocess.Popen(_command(directory, temporary, memory), env=environment,
                                     stdin=subprocess.DEVNULL, stdout=output,
                                     stderr=subprocess.STDOUT, start_new_session=True)
        guard.stdin.write(f"{guest.pid}\n".encode())
        guard.stdin.flush()
        (directory / "guest.txt").write_text(f"{temporary}\n{guest.pid}\n")
        guest.wait(limit)
    except subprocess.TimeoutExpired:
        raise Failed(f"the guest did not end within {limit} s; its last words: "
                     f"{_last_words(console)}") from None
    finally:
        guard.stdin.close()  # from here the guard ends what still runs and removes the directory
        guard.stdout.read()  # until it is done
        guard.wait()


def boot(script, directory, shim, settings=None, files=None, limit=240, memory="192M"):
    """Runs guest/SCRIPT.sh in a guest, in `directory`, which is emptied first; returns its console.

    settings: variables of the script. files: {name: text} that it finds there. limit: seconds of
    real time. Raises Impossible or Failed.
    guest.txt tells the directory of the guest's memory and its session while it runs.
    """
    check_machine()
    directory = Path(directory).resolve()
    if " " in f"{directory}{INIT}":
        raise Impossible(f"a blank in a path of the kernel's command line: {directory}, {INIT}")
    _furnish(directory, script, settings, files)
    _run(directory, shim, limit, memory)
    console = (directory / "console.txt").read_text(errors="replace")
    if not (directory / "started").exists():
        _explain_no_start(console)
    if "Kernel panic" in console or not (directory / "ended").exists():
        raise Failed("the guest did not end as it should: "
                     f"{_last_words(directory / 'console.txt')}")
    return console


def _last_words(console):
    lines = console.read_text(errors="replace").strip().splitlines()
    return " | ".join(lines[-3:]) or "none"
