#!/usr/bin/env python3
"""The job array of docs/sweeps.md on a Slurm of one node, started for this test alone: slurm_test.py COMMAND PROJECT

Needs the packages slurmctld, slurmd, slurm-client and munge, and root, for Slurm's daemons switch users. Eight tasks; one is
killed outright; merge says what is missing; that task is submitted again; the rows have the hash of a sweep in one process.
"""

import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

command = pathlib.Path(sys.argv[1]).resolve()
project = pathlib.Path(sys.argv[2])
KILLED = 3

sys.path.append(str(project / "tests/docs"))
from markdown_page import Document  # noqa: E402

CONFIGURATION = """\
ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket={place}/munge.socket
SlurmctldPort={controller}
SlurmdPort={daemon}
StateSaveLocation={place}/state
SlurmdSpoolDir={place}/spool
SlurmctldPidFile={place}/slurmctld.pid
SlurmdPidFile={place}/slurmd.pid
SlurmctldLogFile={place}/slurmctld.log
SlurmdLogFile={place}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
MpiDefault=none
ReturnToService=2
NodeName={host} NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""

PAD = """\
[sensor]
count = 41
pitch = 0.5
depth = 1.5
reads = ["stress_x"]
[material]
youngs_modulus = 1.0
poisson_ratio = 0.45
[[contact]]
shape = "cylinder"
half_width = 2.0
force = 1.0
[noise]
rms = 1e-3
[reconstruct]
alpha = "rgcv"
"""

STUDY = """\
scene = "pad.toml"
repeats = 20
[[axis]]
key = "sensor.depth"
from = 0.5
to = 2.5
count = 10
"""


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


def comes_true(condition, seconds, what):
    end = time.monotonic() + seconds
    while not (value := condition()):
        if time.monotonic() > end:
            raise SystemExit(f"FAILED: {what} did not come within {seconds} s")
        time.sleep(0.02)
    return value


def check(holds, what):
    if not holds:
        raise SystemExit(f"FAILED: {what}")


def run(*arguments, **options):
    return subprocess.run([str(one) for one in arguments], capture_output=True, text=True, timeout=300, **options)


def sweep_of_task(task):
    """The process of a task: its file is its own."""
    for process in pathlib.Path("/proc").iterdir():
        if not process.name.isdigit():
            continue
        try:
            words = (process / "cmdline").read_bytes().decode().split("\0")
        except OSError:
            continue
        if words[0].endswith("tactile-net") and f"part-{task}.csv" in words:
            return int(process.name)
    return None


class Cluster:
    def __init__(self, place):
        self.place = place
        host = socket.gethostname().split(".")[0]
        controller, daemon = free_ports(2)
        for folder in ("state", "spool"):
            (place / folder).mkdir()
        configuration = place / "slurm.conf"
        configuration.write_text(CONFIGURATION.format(host=host, place=place, controller=controller, daemon=daemon))
        self.environment = {**os.environ, "SLURM_CONF": str(configuration), "PATH": f"{command.parent}:{os.environ['PATH']}"}
        key = place / "munge.key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o400)
        self.daemons = []
        self.start("munged", "--foreground", "--force", f"--key-file={key}", f"--socket={place}/munge.socket",
                   f"--pid-file={place}/munged.pid", f"--log-file={place}/munged.log", f"--seed-file={place}/munged.seed")
        comes_true((place / "munge.socket").exists, 10, "munge's socket")
        self.start("slurmctld", "-D", "-c")
        self.start("slurmd", "-D")

    def start(self, *words):
        log = open(self.place / f"{words[0]}.out", "w", encoding="utf-8")
        self.daemons.append(subprocess.Popen(words, env=self.environment, stdout=log, stderr=log))

    def call(self, *words):
        return run(*words, env=self.environment, cwd=self.place)

    def is_idle(self):
        return "idle" in self.call("sinfo", "--noheader", "--format=%t").stdout

    def has_no_job(self):
        answer = self.call("squeue", "--noheader")
        return answer.returncode == 0 and not answer.stdout.strip()

    def stop(self):
        for daemon in reversed(self.daemons):
            daemon.terminate()
        for daemon in self.daemons:
            try:
                daemon.wait(20)
            except subprocess.TimeoutExpired:
                daemon.kill()


def test(cluster, place):
    (place / "pad.toml").write_text(PAD)
    study = place / "study.toml"
    study.write_text(STUDY)
    serial = run(command, "sweep", study, "-o", place / "serial.csv", "--jobs", "1")
    check(serial.returncode == 0, f"the sweep in one process: {serial.stderr}")
    check(run(command, "merge", place / "serial.csv", "--out", place / "serial").returncode == 0, "its merge")
    recipe = next(block for block in Document(project / "docs/sweeps.md").blocks if block.option("recipe") == "slurm")
    (place / "job.sh").write_text(recipe.text)

    def merge():
        return run(command, "merge", *sorted(place.glob("part-*.csv")), "--out", place / "out")

    comes_true(cluster.is_idle, 60, "an idle node")
    began = time.monotonic()
    submitted = cluster.call("sbatch", "job.sh")
    check(submitted.returncode == 0, f"sbatch: {submitted.stderr}")
    os.kill(comes_true(lambda: sweep_of_task(KILLED), 120, "the task to be killed"), signal.SIGKILL)
    comes_true(cluster.has_no_job, 240, "the end of the array")
    merged = merge()
    logs = "\n".join(log.read_text() for log in place.glob("slurm-*.out"))
    check(merged.returncode == 1 and "missing" in merged.stderr, f"merge without a task: {merged.stderr}\n{logs}")
    print(f"after the kill: {merged.stderr.strip()}")

    cluster.call("sbatch", f"--array={KILLED}", "job.sh")
    comes_true(cluster.has_no_job, 240, "the end of the task")
    merged = merge()
    check(merged.returncode == 0, f"merge with all tasks: {merged.stderr}")
    check((place / "out/results.csv").read_bytes() == (place / "serial/results.csv").read_bytes(), "the rows are the same")
    print(f"submitted again: the same 200 rows, {time.monotonic() - began:.0f} s in all")


def main():
    missing = [name for name in ("slurmctld", "slurmd", "sbatch", "squeue", "sinfo", "munged")
               if not shutil.which(name, path=f"{os.environ['PATH']}:/usr/sbin:/sbin")]
    if missing:
        print(f"skipped: {', '.join(missing)} not installed: tools/install-dependencies slurmctld slurmd slurm-client munge")
        return
    if os.geteuid() != 0:
        print("skipped: Slurm's daemons are started by root alone")
        return
    os.environ["PATH"] += ":/usr/sbin:/sbin"
    with tempfile.TemporaryDirectory(prefix="tactile-net-slurm-") as folder:
        place = pathlib.Path(folder).resolve()
        cluster = Cluster(place)
        try:
            test(cluster, place)
        except BaseException:
            for log in sorted(place.glob("*.log")):
                print(f"{log.name}:\n{log.read_text()[-2000:]}", file=sys.stderr)
            raise
        finally:
            cluster.stop()


main()
