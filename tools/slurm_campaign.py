# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The campaign as jobs of a Slurm cluster (docs/cluster.md); part of tools/campaign.py.

For each stage: a job array of shards after one job that builds (and one that prepares, if the
stage has such a command), and after the array a job that merges. The merging job queues shards that
failed again. What is done is told by files, so nothing is lost with the session that began it:

    OUT/slurm/plan.json          what was asked for; its key tells results of another campaign
    OUT/slurm/STAGE/K.done       shard K has ended as it should: key, seconds, status, node
    OUT/slurm/STAGE/*.log        output of each job
    OUT/slurm/STAGE/failed       why a stage was given up
    OUT/STAGE/shards/            what the shards found, read by the merge
    OUT/STAGE.json               the stage's result, as of a run on one machine
"""
import hashlib
import json
import os
import resource
import shlex
import shutil
import socket
import subprocess
import sys
import time
from pathlib import Path

POLLS = (1, 15)  # seconds between two looks at the files, at first and at last
LOST = 30        # seconds without a job and without a result until a stage counts as lost


class SlurmError(Exception):
    """The cluster does not do as it is told; the text says what it answered."""


def command(*words):
    """Output of a Slurm command."""
    try:
        done = subprocess.run(words, capture_output=True, text=True, check=False)
    except OSError as error:
        raise SlurmError(f"{words[0]}: {error.strerror}; SLURM=1 needs a machine from which jobs "
                         "can be submitted") from None
    if done.returncode:
        raise SlurmError(f"{' '.join(words[:3])} ...: {done.stderr.strip() or done.stdout.strip()}")
    return done.stdout.strip()


class Cluster:
    """A campaign on the cluster: the plan, its jobs, and what is there of them."""

    def __init__(self, out, plan=None):
        """out: directory of the campaign's results; plan: None reads that of OUT."""
        self.out = Path(out)
        self.folder = self.out / "slurm"
        self.plan = plan or json.loads((self.folder / "plan.json").read_text())

    # ---- Files

    def place(self, name):
        """The folder of a stage's markers and logs."""
        return self.folder / name

    def done(self, name):
        """What the shards of a stage that have ended say: {number: marker}."""
        found = {}
        for path in self.place(name).glob("*.done"):
            marker = json.loads(path.read_text())
            if marker["key"] == self.plan["key"]:
                found[int(path.stem)] = marker
        return found

    def missing(self, name):
        """Numbers of the shards that have not ended as they should."""
        done = self.done(name)
        return [n for n in range(self.plan["stages"][name]["shards"]) if n not in done]

    def give_up(self, name, text):
        """Ends a stage without a result; what waits for it goes."""
        (self.place(name) / "failed").write_text(text + "\n")
        command("scancel", "--me", "--state=PENDING", f"--name={self.jobs(name)}")

    # ---- Jobs

    def job(self, name, step):
        """The name of a stage's jobs; that of another campaign is another one."""
        return f"vc-{self.plan['key'][:6]}-{name}-{step}"

    def jobs(self, name):
        """All of them, with commas."""
        return ",".join(self.job(name, step) for step in ("build", "prepare", "shard", "merge"))

    def queued(self, name):
        """Whether the queue has jobs of a stage that can still begin."""
        states = command("squeue", "--me", "--noheader", "--format=%T %r",
                         f"--name={self.jobs(name)}").splitlines()
        return any("DependencyNeverSatisfied" not in line for line in states)

    def submit(self, name, step, after="", array="", again=0):
        """Submits a step of a stage; returns the job's number."""
        log = self.place(name) / (f"{step}-%a-{again}.log" if array else f"{step}-{again}.log")
        one = step == "merge" or (step == "shard" and self.plan["stages"][name]["cut"])
        words = ["sbatch", "--parsable", f"--job-name={self.job(name, step)}", f"--output={log}",
                 f"--chdir={self.plan['root']}", "--requeue", "--ntasks=1",
                 f"--cpus-per-task={1 if one else self.plan['jobs']}"]
        words += shlex.split(self.plan["sbatch"])
        words += [f"--dependency={after}"] if after else []
        words += [f"--array={array}"] if array else []
        program = [sys.executable, str(self.plan["program"]), "--step", step, "--only", name,
                   "--plan", self.plan["file"], "--out", str(self.out), "--again", str(again)]
        return command(*words, "--wrap", shlex.join(program)).split(";")[0]

    def submit_shards(self, name, numbers, after, again):
        """An array of these shards and, after all of them, the merge; returns the merge's job."""
        array = self.submit(name, "shard", after, ",".join(map(str, numbers)), again)
        return self.submit(name, "merge", f"afterany:{array}", again=again)

    def submit_stage(self, name, built):
        """Everything of a stage that is not there yet."""
        stage, after = self.plan["stages"][name], f"afterok:{built}" if built else ""
        missing = self.missing(name)
        if missing and stage["prepare"]:
            after = f"afterok:{self.submit(name, 'prepare', after)}"
        if missing:
            self.submit_shards(name, missing, after, 0)
        else:
            self.submit(name, "merge", after)


def key_of(root, settings, stages):
    """Tells campaigns apart: what is tested, with what settings."""
    def git(*words):
        return subprocess.run(["git", *words], cwd=root, capture_output=True, check=False).stdout
    digest = hashlib.sha256(git("rev-parse", "HEAD") + git("diff", "HEAD"))
    digest.update(json.dumps([settings, stages], sort_keys=True).encode())
    return digest.hexdigest()[:16]


def shards_of(stage, options):
    """How many shards a stage has: as many as it says, at SHARDS if that is fewer; 1 if none."""
    return min(stage.get("shards", 1), options["shards"]) if "shards" in stage else 1


def make_plan(stages, options, root, program, file):
    """The plan of a campaign; `file`: that of the stages."""
    wanted = {stage["name"]: {"shards": shards_of(stage, options), "cut": "shards" in stage,
                              "prepare": bool(stage.get("prepare"))} for stage in stages}
    settings = {name: options[name] for name in ("seed", "scale")}
    sbatch = os.environ.get("SBATCH", "")
    try:
        shlex.split(sbatch)
    except ValueError as error:
        raise SlurmError(f"SBATCH is '{sbatch}', which are no words: {error}") from None
    return {"key": key_of(root, settings, wanted), "root": str(root), "program": str(program),
            "file": str(file), "jobs": options["jobs"], "sbatch": sbatch,
            "retries": options["retries"], "began": time.time(), "stages": wanted, **settings}


def clear(cluster, name):
    """Removes what another campaign, or this one before, has left of a stage."""
    shutil.rmtree(cluster.place(name), ignore_errors=True)
    shutil.rmtree(cluster.out / name / "shards", ignore_errors=True)


def start(cluster, resume):
    """Submits all stages. With `resume` shards of the same key count."""
    cluster.folder.mkdir(parents=True, exist_ok=True)
    for name in cluster.plan["stages"]:
        if not resume or not cluster.done(name):
            clear(cluster, name)
        cluster.place(name).mkdir(parents=True, exist_ok=True)
        (cluster.place(name) / "failed").unlink(missing_ok=True)
        (cluster.out / f"{name}.json").unlink(missing_ok=True)
    (cluster.folder / "plan.json").write_text(json.dumps(cluster.plan, indent=1) + "\n")
    previous = ""
    for name in cluster.plan["stages"]:
        # One build directory: one build after the other.
        previous = cluster.submit(name, "build", f"afterany:{previous}" if previous else "")
        cluster.submit_stage(name, previous)


def wait(cluster):
    """Until each stage has a result or was given up; prints what is done."""
    seen = dict.fromkeys(cluster.plan["stages"], time.monotonic())  # when a stage had jobs
    told = {}
    pause = POLLS[0]
    while seen:
        for name in list(seen):
            done = len(cluster.done(name))
            if told.get(name) != done:
                told[name] = done
                print(f"{name}: {done} of {cluster.plan['stages'][name]['shards']} shards",
                      flush=True)
            if (cluster.out / f"{name}.json").exists() or (cluster.place(name) / "failed").exists():
                del seen[name]
                continue
            if cluster.queued(name):
                seen[name] = time.monotonic()
            elif time.monotonic() - seen[name] > LOST:
                cluster.give_up(name, "no job of it is in the queue any more; see its logs")
        if seen:
            time.sleep(pause)
            pause = min(pause * 1.1, POLLS[1])
    for name in cluster.plan["stages"]:
        failed = cluster.place(name) / "failed"
        if failed.exists():
            print(f"campaign: {name}: {failed.read_text().strip()} ({cluster.place(name)})")


# ---- What the jobs do

def step_shard(cluster, stage, run):
    """One shard; run(environment) runs the stage's command and returns its status."""
    name, number = stage["name"], int(os.environ["SLURM_ARRAY_TASK_ID"])
    cut, count = (cluster.plan["stages"][name][key] for key in ("cut", "shards"))
    whole = cluster.out / name / "whole.json"
    whole.unlink(missing_ok=True)
    begin = time.monotonic()
    status = run({"CAMPAIGN_SHARD": f"{number}/{count}"} if cut else {"CAMPAIGN_OUT": str(whole)})
    # A stage of one piece that missed a bar has done its work.
    if status and (cut or not whole.exists()):
        return status
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    marker = {"key": cluster.plan["key"], "seconds": round(time.monotonic() - begin, 1),
              "cpu": round(used.ru_utime + used.ru_stime, 1), "status": status,
              "node": socket.gethostname()}
    path = cluster.place(name) / f"{number}.done"
    path.with_suffix(".new").write_text(json.dumps(marker) + "\n")
    path.with_suffix(".new").replace(path)
    return 0


def step_build(cluster, stage, built):
    """After the build or the preparation of a stage: without it there is no stage."""
    if not built:
        cluster.give_up(stage["name"], "build or preparation failed")
    return 0 if built else 1


def step_merge(cluster, stage, run, again):
    """Queues shards that failed again, or makes the stage's result of them; returns (status,
    markers), None as the status if there is nothing to tell yet."""
    name = stage["name"]
    missing = cluster.missing(name)
    if missing and again < cluster.plan["retries"]:
        print(f"{name}: shards {', '.join(map(str, missing))} failed and are queued again")
        cluster.submit_shards(name, missing, "", again + 1)
        return None, {}
    if missing:
        cluster.give_up(name, f"shards {', '.join(map(str, missing))} failed "
                              f"{again + 1} times")
        return None, {}
    markers = cluster.done(name)
    if not cluster.plan["stages"][name]["cut"]:
        shutil.copy(cluster.out / name / "whole.json", cluster.out / f"{name}.new")
        return markers[0]["status"], markers
    count = cluster.plan["stages"][name]["shards"]
    status = run({"CAMPAIGN_SHARD": f"merge/{count}",
                  "CAMPAIGN_OUT": str(cluster.out / f"{name}.new")})
    return status, markers
