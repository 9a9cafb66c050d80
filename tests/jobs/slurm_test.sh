#!/usr/bin/env bash
# slurm_test.sh HEXFIELD SCRATCH_DIRECTORY: starts Slurm on this one machine (as root, without systemd), runs
# jobs/hexfield.sbatch with a time limit that is too short, and looks whether the job was warned, put back into the
# queue, resumed and finished with the same hexes as an undisturbed run. Exit status 77 (skipped) without Slurm or root.
#
# Needs: apt-get install munge slurm-wlm. Stops the daemons that it started.
set -euo pipefail
hexfield=$1
scratch=$2
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
for tool in munged slurmctld slurmd sbatch; do
  command -v "$tool" >/dev/null || { echo "skipped: no $tool"; exit 77; }
done
[ "$(id -u)" -eq 0 ] || { echo "skipped: only root can start the daemons"; exit 77; }
rm -rf "$scratch"
mkdir -p "$scratch"/{state,spool,log}
cd "$scratch"

write_configuration() {
  cat >slurm.conf <<CONF
ClusterName=test
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=cred_expire=5
MpiDefault=pmix
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SwitchType=switch/none
ReturnToService=2
StateSaveLocation=$scratch/state
SlurmdSpoolDir=$scratch/spool
SlurmctldPidFile=$scratch/slurmctld.pid
SlurmdPidFile=$scratch/slurmd.pid
SlurmctldLogFile=$scratch/log/slurmctld.log
SlurmdLogFile=$scratch/log/slurmd.log
SlurmctldPort=26817
SlurmdPort=26818
SchedulerType=sched/backfill
SchedulerParameters=batch_sched_delay=0,sched_interval=2,bf_interval=2,sched_min_interval=100000
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/none
JobRequeue=1
KillWait=5
MinJobAge=600
InactiveLimit=0
PropagateResourceLimits=NONE
NodeName=$(hostname -s) NodeAddr=127.0.0.1 CPUs=2 Boards=1 SocketsPerBoard=1 CoresPerSocket=2 ThreadsPerCore=1 RealMemory=2000 State=UNKNOWN
PartitionName=test Nodes=$(hostname -s) Default=YES MaxTime=10 DefaultTime=1 State=UP OverSubscribe=NO
CONF
}

daemons=()
stop_daemons() {
  for file in slurmd.pid slurmctld.pid; do
    if [ -e "$scratch/$file" ]; then kill "$(cat "$scratch/$file")" 2>/dev/null || true; fi
  done
  for pid in "${daemons[@]}"; do kill "$pid" 2>/dev/null || true; done
}

start_daemons() {
  export SLURM_CONF=$scratch/slurm.conf
  install -d -o munge -g munge -m 755 /run/munge
  install -d -o munge -g munge -m 700 /var/log/munge /var/lib/munge
  if [ ! -f /etc/munge/munge.key ]; then
    head -c 1024 /dev/urandom >/etc/munge/munge.key
    chown munge:munge /etc/munge/munge.key
    chmod 400 /etc/munge/munge.key
  fi
  if ! pgrep -x munged >/dev/null; then
    setpriv --reuid=munge --regid=munge --clear-groups munged --foreground >log/munged.log 2>&1 &
    daemons+=($!)
    sleep 1
  fi
  slurmctld -i
  slurmd
  for _ in $(seq 100); do
    sinfo -h -o %T 2>/dev/null | grep -q idle && return
    sleep 0.2
  done
  echo "the node did not come up"; tail -n 20 log/*.log; exit 1
}

job_field() { scontrol show job "$1" | grep -o "$2=[^ ]*" | head -n 1 | cut -d= -f2; }

hex_count() { # of a report
  python3 -c 'import json, sys; print(json.load(open(sys.argv[1]))["hex"]["count"])' "$1/report.json"
}

write_configuration
trap stop_daemons EXIT
start_daemons
part="$top/tests/data/bracket.msh"
options=(--target-hexes "${HEXFIELD_SLURM_HEXES:-300000}")
export HEXFIELD=$hexfield
. "$top/jobs/mpi_environment.sh"

# The limit of Slurm is a whole minute at least, and the warning comes some seconds after it is due.
job=$(sbatch --parsable --ntasks=2 --time=1 --signal=B:USR1@45 --output="$scratch/job.log" \
  "$top/jobs/hexfield.sbatch" "$part" "$scratch/warned" "${options[@]}")
for _ in $(seq 300); do
  state=$(job_field "$job" JobState)
  if [ "$(job_field "$job" Restarts)" -ge 1 ] && [ "$(job_field "$job" TimeLimit)" = 00:01:00 ]; then
    scontrol update jobid="$job" TimeLimit=10 || true # the second start gets the time it needs
  fi
  case "$state" in COMPLETED | FAILED | TIMEOUT | CANCELLED | NODE_FAIL) break ;; esac
  sleep 2
done
cat job.log
restarts=$(job_field "$job" Restarts)
echo "job $job: $state after $restarts restarts"
[ "$state" = COMPLETED ] && [ "$restarts" -ge 1 ]
grep -q "back into the queue" job.log
mpirun -np 2 "$hexfield" run "$part" -o "$scratch/undisturbed" "${options[@]}" >/dev/null
[ "$(hex_count "$scratch/warned")" = "$(hex_count "$scratch/undisturbed")" ]
echo "ok: warned, requeued, resumed and finished with $(hex_count "$scratch/warned") hexes"
