"""The study on a private cluster of one node: real daemons, in a folder that is thrown away."""

import getpass
import math
import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import pytest

from planarimpact import lumped, study
from stronge1994.figures.study import files as study_files

PROGRAMS = ("munged", "slurmctld", "slurmd", "sinfo", "sbatch", "srun", "squeue", "scontrol")
STARTING, RUNNING = 20, 120  # s, at most
PROFILE = ["--profile", "profiles/slurm"]
# One node that is this machine, whatever it has, and nothing that needs systemd or cgroups.
CONFIG = """
ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket={folder}/munge.socket
StateSaveLocation={folder}
SlurmdSpoolDir={folder}
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
MpiDefault=none
SwitchType=switch/none
SlurmdParameters=config_overrides
SchedulerParameters=batch_sched_delay=0
NodeName={host} NodeAddr=127.0.0.1 CPUs=2 RealMemory=4000
PartitionName=main Nodes={host} Default=YES State=UP
"""


class Cluster:
    """Daemons of SLURM in a folder."""

    def __init__(self, folder):
        self.folder, self.daemons = folder, []
        self.environment = os.environ | {
            "SLURM_CONF": f"{folder}/slurm.conf",
            "PATH": f"{folder}/bin:{os.environ['PATH']}",
        }

    def start(self):
        """Start everything; skip with the words of the daemons where that does not succeed."""
        host = socket.gethostname().split(".")[0]
        names = {"folder": self.folder, "host": host, "user": getpass.getuser()}
        (self.folder / "slurm.conf").write_text(CONFIG.format(ports=_free_ports(2), **names))
        cgroups = "CgroupPlugin=cgroup/v1\nConstrainCores=no\nConstrainRAMSpace=no\n"
        (self.folder / "cgroup.conf").write_text(cgroups)
        key = self.folder / "munge.key"
        key.touch(mode=0o600)
        key.write_bytes(os.urandom(128))
        # Snakemake's job step hides SLURM_CONF from srun, which looks in /etc then.
        srun = self.folder / "bin/srun"
        srun.parent.mkdir()
        conf, real = self.environment["SLURM_CONF"], shutil.which("srun")
        srun.write_text(f'#!/bin/sh\nSLURM_CONF={conf} exec {real} "$@"\n')
        srun.chmod(0o755)
        names = ("key-file", "socket", "pid-file", "log-file", "seed-file")
        options = [f"--{name}={self.folder}/munge.{name.split('-')[0]}" for name in names]
        self._daemon("munged", "--foreground", "--force", *options)
        self._wait_until((self.folder / "munge.socket").exists)
        self._daemon("slurmctld", "-D")
        self._daemon("slurmd", "-D", "-N", host)
        self._wait_until(lambda: self.says("sinfo", "-h", "-o", "%T") == "idle\n")

    def says(self, *command):
        return subprocess.run(
            command, env=self.environment, capture_output=True, text=True, timeout=STARTING
        ).stdout

    def snakemake(self, project, *arguments):
        """Run snakemake with the profile, no longer than allowed; its code and words."""
        command = [sys.executable, "-m", "snakemake", *PROFILE, *arguments]
        running = subprocess.Popen(
            command,
            cwd=project.folder,
            env=self.environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            start_new_session=True,
        )
        try:
            words, _ = running.communicate(timeout=RUNNING)
        except subprocess.TimeoutExpired:
            os.killpg(running.pid, signal.SIGKILL)
            words, _ = running.communicate()
        return running.returncode, words

    def stop(self):
        if len(self.daemons) == 3:
            self.says("scancel", "--user", getpass.getuser())
        for daemon in reversed(self.daemons):
            daemon.terminate()
        for daemon in self.daemons:
            try:
                daemon.wait(5)
            except subprocess.TimeoutExpired:
                os.killpg(daemon.pid, signal.SIGKILL)
                daemon.wait()

    def _daemon(self, *command):
        with open(self.folder / f"{command[0]}.out", "w") as words:
            daemon = subprocess.Popen(
                command, env=self.environment, stdout=words, stderr=words, start_new_session=True
            )
        self.daemons.append(daemon)

    def _wait_until(self, ready):
        deadline = time.monotonic() + STARTING
        while not ready():
            if time.monotonic() > deadline or any(d.poll() is not None for d in self.daemons):
                words = "\n".join(file.read_text()[-500:] for file in self.folder.glob("*.out"))
                pytest.skip(f"SLURM does not start here: {words}")
            time.sleep(0.1)


def _free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


@pytest.fixture(scope="module")
def cluster():
    missing = [name for name in PROGRAMS if not shutil.which(name)]
    if missing:
        pytest.skip(
            f"SLURM is not complete here: {', '.join(missing)} missing; Debian has the packages "
            "slurmctld, slurmd, slurm-client and munge"
        )
    # Not pytest's folder: a socket's path must be short.
    with tempfile.TemporaryDirectory(prefix="slurm", ignore_cleanup_errors=True) as folder:
        Path(folder).chmod(0o755)  # munge's clients must get at its socket
        found = Cluster(Path(folder))
        try:
            found.start()
            yield found
        finally:
            found.stop()


@pytest.mark.long
def test_the_study_goes_through_slurm(cluster, fresh):
    """A job a chunk, and the numbers are those of this machine."""
    # Looks after 1, 12 and 33 s.
    quick = ["--slurm-init-seconds-before-status-checks", "1"]
    code, words = cluster.snakemake(
        fresh, "results/study.npz", *quick, "--config", "study={chunks: 2}"
    )
    assert code == 0, words
    jobs = cluster.says("scontrol", "show", "jobs", "--oneliner").splitlines()
    assert len(jobs) == 2, words
    for part in (
        "JobState=COMPLETED",
        "Comment=rule_solve_chunk",
        "NumCPUs=1 ",
        "TimeLimit=00:30:00",
        f"WorkDir={fresh.folder}",
    ):
        assert all(part in job for job in jobs), (part, jobs)
    axes, outputs = study_files.read(fresh / "results/study.npz")
    assert len(list(fresh.folder.glob("results/study/*"))) == 2
    points = math.prod(map(len, axes.values()))
    here = [(0, study.solve(lumped.rebound, axes, 0, points))]
    for name, field in study.gather(axes, here).items():
        assert np.array_equal(field, outputs[name]), name


@pytest.mark.slow
def test_the_profile_is_understood_without_slurm(fresh):
    _, counts = fresh.planned(*PROFILE, "results/study.npz")
    assert set(counts) == {"solve_chunk", "gather_chunks"}
    entries = (fresh / "profiles/slurm/config.yaml").read_text()
    assert not re.search(r"\n\n(?!#)", entries), "an entry without a word on it"
