# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""A Slurm cluster of one node on this machine, for as long as a test runs: munged, slurmctld and
slurmd of Debian's packages with a key, ports and a directory of their own, on the loop-back device
alone. It needs no root and touches no Slurm that is installed."""
import contextlib
import getpass
import os
import secrets
import shutil
import signal
import socket
import subprocess
import tempfile
import time
from pathlib import Path

CONFIGURATION = """\
ClusterName=verican
SlurmctldHost=localhost(127.0.0.1)
SlurmctldPort={controller}
SlurmdPort={node}
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
AuthType=auth/munge
AuthInfo=socket={dir}/munge.sock
CredType=cred/munge
SlurmUser={user}
SlurmdUser={user}
StateSaveLocation={dir}/state
SlurmdSpoolDir={dir}/spool
SlurmctldPidFile={dir}/slurmctld.pid
SlurmdPidFile={dir}/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=sched_interval=1,bf_interval=1,batch_sched_delay=0
SlurmdParameters=config_overrides
ReturnToService=2
MinJobAge=3600
NodeName=localhost NodeAddr=127.0.0.1 CPUs={cpus} State=UNKNOWN
PartitionName=all Nodes=localhost Default=YES MaxTime=INFINITE State=UP
"""


class Impossible(Exception):
    """This machine cannot run a cluster: a program is not installed; the text names it."""


class Failed(Exception):
    """The cluster does not work though all of it is there; the text says what happened."""


def _free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


class PrivateSlurm:
    """A context: within it self.environment is that of a machine of the cluster. `patience`: how
    long, in seconds, a daemon may take to answer."""

    def __init__(self, cpus, patience=240):
        self.cpus = cpus
        self.patience = patience
        self.programs = []
        self.environment = {**os.environ,
                            "PATH": f"{os.environ.get('PATH', '')}:/usr/sbin:/sbin"}

    def _start(self, name, *words):
        if not shutil.which(name, path=self.environment["PATH"]):
            raise Impossible(f"{name} is not installed (packages slurm-wlm and munge)")
        with open(self.dir / f"{name}.log", "wb") as log:
            self.programs.append(subprocess.Popen(
                [name, *map(str, words)], env=self.environment, stdin=subprocess.DEVNULL,
                stdout=log, stderr=log, cwd=self.dir))

    def _wait(self, what, condition):
        end = time.monotonic() + self.patience
        while not condition():
            dead = [program.args[0] for program in self.programs if program.poll() is not None]
            if dead or time.monotonic() > end:
                ended = f"ended: {', '.join(dead)}" if dead else "not in time"
                raise Failed(f"{what}: {ended}; " + " | ".join(self._last_words()))
            time.sleep(0.2)

    def _last_words(self):
        for path in sorted(self.dir.glob("*.log")):
            lines = path.read_text(errors="replace").strip().splitlines()
            yield f"{path.name}: {lines[-1] if lines else 'empty'}"

    def _is_idle(self):
        done = subprocess.run(["sinfo", "--noheader", "--format=%T"], env=self.environment,
                              capture_output=True, text=True, check=False)
        return done.stdout.strip() == "idle"

    def state(self):
        """What nodes and jobs there are, why a node is not used, and what each daemon said last."""
        said = []
        for words in (["sinfo", "--Node", "--long"], ["sinfo", "--list-reasons"], ["squeue"]):
            done = subprocess.run(words, env=self.environment, capture_output=True, text=True,
                                  check=False, timeout=20)
            said.append(done.stdout + done.stderr)
        return "\n".join([*said, *self._last_words()])

    def __enter__(self):
        # Short: the path of a socket has 108 characters.
        self.dir = Path(tempfile.mkdtemp(prefix="verican-slurm-"))
        try:
            self._set_up()
        except BaseException:
            self.__exit__()
            raise
        return self

    def _set_up(self):
        for name in ("state", "spool"):
            (self.dir / name).mkdir()
        self.dir.chmod(0o755)
        key = self.dir / "munge.key"
        key.write_bytes(secrets.token_bytes(128))
        key.chmod(0o400)
        controller, node = _free_ports(2)
        (self.dir / "slurm.conf").write_text(CONFIGURATION.format(
            dir=self.dir, user=getpass.getuser(), controller=controller, node=node,
            cpus=self.cpus))
        self.environment["SLURM_CONF"] = str(self.dir / "slurm.conf")
        self._start("munged", "--foreground", "--force", f"--socket={self.dir}/munge.sock",
                    f"--key-file={key}", f"--pid-file={self.dir}/munged.pid",
                    f"--seed-file={self.dir}/munge.seed", "--num-threads=2")
        self._wait("munged", (self.dir / "munge.sock").exists)
        self._start("slurmctld", "-D", "-i")
        self._start("slurmd", "-D", "-N", "localhost")
        self._wait("the node is not idle", self._is_idle)

    def __exit__(self, *_):
        with contextlib.suppress(OSError):
            subprocess.run(["scancel", "--me"], env=self.environment, check=False,
                           capture_output=True, timeout=20)
        for program in reversed(self.programs):
            program.send_signal(signal.SIGTERM)
        for program in self.programs:
            try:
                program.wait(20)
            except subprocess.TimeoutExpired:
                program.kill()
                program.wait()
        shutil.rmtree(self.dir, ignore_errors=True)
