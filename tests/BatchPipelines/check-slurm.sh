#!/usr/bin/env bash
# check-slurm.sh SOURCE PROGRAMS FOLDER: one collection as one run, as a job array of Slurm, and by Snakemake on Slurm gives the same
# files; so does a case that Slurm killed for its memory, or put back into the queue, and started again. Slurm runs on this machine
# alone, as processes that end with this script.
set -euo pipefail
source=$1
export PATH="$2:$PATH:/usr/sbin"
folder=$3
for program in munged slurmctld slurmd sbatch snakemake python3; do
  command -v $program >/dev/null || { echo "skipped: $program is not installed"; exit 77; }
done
[ "$(id -u)" -eq 0 ] || { echo "skipped: slurmd has to be started by root"; exit 77; }

rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"
slurm=$(mktemp -d) # short, as the paths of sockets are limited; and munged refuses folders that others can write
stop() {
  for file in "$slurm"/*.pid; do
    [ -e "$file" ] && kill -KILL "$(cat "$file")" 2>/dev/null || true
  done
  rm -rf "$slurm"
}
trap stop EXIT

fail() {
  echo "$1" >&2
  tail -n 20 "$slurm"/*.log >&2
  squeue >&2 || true
  exit 1
}

wait_for() { # COMMAND...: CTest ends what hangs
  until "$@" > /dev/null 2>&1; do
    sleep 0.2
  done
}

start_slurm() {
  local ports
  ports=($(python3 -c '
import socket
sockets = [socket.socket() for _ in range(2)]
for s in sockets:
    s.bind(("127.0.0.1", 0))
print(*(s.getsockname()[1] for s in sockets))'))
  mkdir "$slurm/state" "$slurm/spool"
  chmod 755 "$slurm"
  head -c 1024 /dev/urandom > "$slurm/key"
  chmod 400 "$slurm/key"
  cat > "$slurm/slurm.conf" <<END
ClusterName=test
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmUser=root
SlurmctldPort=${ports[0]}
SlurmdPort=${ports[1]}
AuthType=auth/munge
AuthInfo=socket=$slurm/munge.socket
CredType=cred/munge
StateSaveLocation=$slurm/state
SlurmdSpoolDir=$slurm/spool
SlurmctldPidFile=$slurm/slurmctld.pid
SlurmdPidFile=$slurm/slurmd.pid
SlurmctldLogFile=$slurm/slurmctld.log
SlurmdLogFile=$slurm/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU_Memory
JobAcctGatherType=jobacct_gather/linux
JobAcctGatherFrequency=1
JobAcctGatherParams=OverMemoryKill
SlurmdParameters=config_overrides
SchedulerParameters=sched_interval=1,batch_sched_delay=0,defer
SwitchType=switch/none
MpiDefault=none
ReturnToService=2
NodeName=$(hostname -s) NodeAddr=127.0.0.1 CPUs=4 RealMemory=16000
PartitionName=test Nodes=ALL Default=YES MaxTime=60
END
  export SLURM_CONF=$slurm/slurm.conf
  munged --socket "$slurm/munge.socket" --key-file "$slurm/key" --pid-file "$slurm/munged.pid" --log-file "$slurm/munged.log" \
    --seed-file "$slurm/munged.seed" --force 2> "$slurm/start.log"
  slurmctld -c
  slurmd -c
  wait_for bash -c 'sinfo -h -o %t | grep -q idle'
}

rhombic -q phantom --spacing 8 -o phantom
"$source/tests/BatchPipelines/make-variants.py" scans 20 phantom/phantom.nii.gz
rm scans/variant-00?.nii.gz scans/variant-010.nii.gz
rhombic -q phantom --spacing 2 -o phantom-2
mkdir large
cp phantom-2/phantom.nii.gz large/large.nii.gz
printf 'outputs: [{mesh: bone.stl, threshold: 250.5}]\n' > pipeline.yaml
rhombic -q batch scans -o whole --pipeline pipeline.yaml --names-from-paths --dry-run > cases.tsv
rhombic -q batch cases.tsv -o whole --pipeline pipeline.yaml && exit 1 || [ $? -eq 12 ] # one case is broken
rhombic -q batch large -o large-whole --pipeline pipeline.yaml --names-from-paths
start_slurm

contents() { # OUT: hashes of what depends on no times
  (cd "$1" && find . -type f ! -name journal.jsonl ! -name index.html ! -name 'results.*' -exec md5sum {} + | sort -k 2)
}

# A job array.
sbatch --wait --output=/dev/null --array=1-$(($(wc -l < cases.tsv) - 1)) --cpus-per-task=2 --mem=1G --time=50 \
  "$source/pipelines/batch/job-array.sh" cases.tsv array --pipeline pipeline.yaml --threads 2 --max-memory 1G -q || [ $? -eq 12 ]
rhombic -q batch cases.tsv -o array --pipeline pipeline.yaml --tables

# Snakemake with its profile.
major=$(snakemake --version | cut -d . -f 1)
snakemake -s "$source/pipelines/batch/Snakefile" --profile "$source/pipelines/batch/slurm-$major" --quiet \
  --config manifest=cases.tsv output=snake pipeline=pipeline.yaml scale=1 && fail "Snakemake did not tell of the broken case" || true

for other in array snake; do
  diff <(contents whole) <(contents $other)
  diff <(cut -f 1-3,7- whole/results.tsv) <(cut -f 1-3,7- $other/results.tsv)
done

state_of() { # JOB
  scontrol show job "$1" | sed -n 's/.*JobState=\([A-Z_]*\).*/\1/p'
}
has_state() { # JOB STATE
  [ "$(state_of "$1")" = "$2" ]
}

submit_large() { # OUT MEMORY: the number of a job
  sbatch --parsable --requeue --output=/dev/null --cpus-per-task=2 --mem="$2" --time=50 \
    --wrap "exec rhombic -q batch large -o $1 --pipeline pipeline.yaml --names-from-paths --case large.nii.gz --threads 1"
}

# A case that takes more memory than its job has, which is then given more.
job=$(submit_large killed 60M)
wait_for has_state "$job" FAILED
grep -q "exceeded memory limit" "$slurm/slurmd.log" || fail "The job was not killed for its memory"
[ ! -e killed/large.nii.gz ] || fail "The case has outputs"
sleep 2 # slurmd does not start a job in the second in which it killed it
scontrol requeuehold "$job"
scontrol update JobId="$job" MinMemoryNode=2000
scontrol release "$job"
scontrol update JobId="$job" StartTime=now # without the two minutes that Slurm waits before it starts a job again
wait_for has_state "$job" COMPLETED

# A job that is put back into the queue while it runs.
job=$(submit_large requeued 2G)
wait_for bash -c 'compgen -G "requeued/.stage*"'
scontrol requeue "$job"
sleep 2
wait_for has_state "$job" PENDING
scontrol update JobId="$job" StartTime=now
wait_for has_state "$job" COMPLETED

for other in killed requeued; do
  rhombic -q batch large -o $other --pipeline pipeline.yaml --names-from-paths --tables
  diff <(contents large-whole) <(contents $other)
done
