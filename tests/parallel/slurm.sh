# The job scripts of drivers/slurm under a real Slurm, started here on loopback and stopped again.
# sh slurm.sh PROGRAM RTOL [MPI_PROGRAM MPIEXEC]
scripts=$(cd "$(dirname "$0")/../../drivers/slurm" && pwd)
. "$(dirname "$0")/ranks_common.sh"
PATH=$PATH:/usr/sbin:/sbin
export PATH
for need in munged slurmctld slurmd sbatch; do
   if ! command -v $need >/dev/null; then echo "skipped: no $need here"; exit $skip; fi
done
if [ "$(id -u)" != 0 ]; then echo "skipped: slurmd wants to be root"; exit $skip; fi

# give_up WHY LOG: this is no place for a Slurm
give_up() {
   echo "skipped: $1"
   tail -n 5 "$2" 2>/dev/null | sed 's/^/   /'
   exit $skip
}

# until_true SECONDS COMMAND...: wait for the command to succeed
until_true() {
   tries=$(($1 * 10))
   shift
   while [ $tries -gt 0 ]; do
      if "$@" >/dev/null 2>&1; then return 0; fi
      sleep 0.1
      tries=$((tries - 1))
   done
   return 1
}

# what this test started, and nothing else
stop_slurm() {
   [ -z "${SLURM_CONF:-}" ] || scancel --user=root --quiet 2>/dev/null
   sleep 0.3
   for name in slurmd slurmctld munged; do
      [ ! -e "$work/$name.pid" ] || kill "$(cat "$work/$name.pid")" 2>/dev/null
   done
   for name in slurmd slurmctld munged; do
      if [ -e "$work/$name.pid" ]; then
         pid=$(cat "$work/$name.pid")
         until_true 5 sh -c "! kill -0 $pid" || kill -9 "$pid" 2>/dev/null
      fi
   done
}
cleanup='stop_slurm'

host=$(hostname -s 2>/dev/null || hostname)
port=$((20000 + $$ % 20000))
mkdir state spool
chmod 755 .
dd if=/dev/urandom of=munge.key bs=128 count=1 2>/dev/null
chmod 600 munge.key
munged --force --foreground --socket="$work/munge.socket" --key-file="$work/munge.key" --seed-file="$work/munge.seed" \
   --pid-file="$work/munge.pid" --log-file="$work/munged.log" >munged.out 2>&1 &
echo $! >munged.pid
until_true 10 munge --socket="$work/munge.socket" --no-input || give_up "munged does not start" munged.log
cat >slurm.conf <<END
ClusterName=reedvalve
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
SlurmctldPort=$port
SlurmdPort=$((port + 1))
AuthType=auth/munge
AuthInfo=socket=$work/munge.socket
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/slurmctld.daemon
SlurmdPidFile=$work/slurmd.daemon
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=batch_sched_delay=0,sched_interval=1,sched_min_interval=0,bf_interval=1
SlurmdParameters=config_overrides
ReturnToService=2
KillWait=5
MailProg=/bin/true
NodeName=here NodeHostname=$host NodeAddr=127.0.0.1 CPUs=4 State=UNKNOWN
PartitionName=all Nodes=here Default=YES MaxTime=INFINITE State=UP
END
SLURM_CONF=$work/slurm.conf
export SLURM_CONF
slurmctld -D -c -f "$SLURM_CONF" >slurmctld.log 2>&1 &
echo $! >slurmctld.pid
slurmd -D -N here -f "$SLURM_CONF" >slurmd.log 2>&1 &
echo $! >slurmd.pid
until_true 20 sh -c "sinfo --noheader --format=%T | grep -q '^idle$'" || give_up "Slurm does not start" slurmctld.log
echo "  Slurm $(sinfo --version | cut -d ' ' -f 2) runs"

# over JOB SECONDS: wait until the job is neither waiting nor running
over() {
   until_true "$2" sh -c "[ -z \"\$(squeue --noheader --job=$1 2>/dev/null)\" ]"
}
# ended JOB STATE: the job is known to have ended so
ended() {
   if scontrol --oneliner show job "$1" | grep -q "JobState=$2"; then pass "job $1 is $2"
   else
      wrong "job $1 is not $2"
      scontrol --oneliner show job "$1"
      tail -n 20 slurmctld.log slurmd.log
   fi
}

REEDVALVE=$own
export REEDVALVE
sweep_deck 20 1.0e-6 >deck.nml
expect 0 'none failed' run deck.nml -o whole

# slices, and a merge that waits for them
job=$(sbatch --parsable --array=1-7 --cpus-per-task=1 "$scripts/array.sh" deck.nml sliced)
last=$(sbatch --parsable --dependency=afterany:"$job" "$scripts/merge.sh" sliced)
holds "an array and its merge are over" over "$last" 60
ended "$last" COMPLETED
same whole sliced

# an array of the slices that are missing
job=$(sbatch --parsable --array=1,3,4,6-7 --cpus-per-task=1 "$scripts/array.sh" deck.nml mended 7)
holds "an array without slices 2 and 5 is over" over "$job" 60
expect 3 '5 of 16 blocks are not finished \(2, 5, 9, 12, 16\)' merge mended
job=$(sbatch --parsable --array=2,5 --cpus-per-task=1 "$scripts/array.sh" deck.nml mended 7)
holds "an array of slices 2 and 5 is over" over "$job" 60
ended "$job" COMPLETED
expect 0 'none failed' merge mended
same whole mended

# a slice whose time is up stops with whole blocks and gets in line again
sweep_deck 4000 1.0e-10 | sed "s/block_size = 4000/block_size = 20/" >long.nml
job=$(sbatch --parsable --array=1-1 --cpus-per-task=2 --output=long.out "$scripts/array.sh" long.nml long)
until_true 20 test -e long/parts/block_000000001.part
scancel --batch --signal=USR1 "${job}_1"
holds "a job whose time is up gets in line again" until_true 20 sh -c \
   "scontrol --oneliner show job ${job}_1 | grep -E 'JobState=(PENDING|RUNNING).* Restarts=1'"
holds "it stopped with whole blocks" grep -q 'blocks are finished and kept' long.out
before=$(ls long/parts | grep -c 'part$')
until_true 20 sh -c "sinfo --noheader --format=%T | grep -q '^idle$'"   # its first go is wound up
sleep 2   # slurmd takes a new go within the second for the old one; Slurm itself lets it wait two minutes
scontrol update JobId="${job}_1" StartTime=now
until_true 20 sh -c "[ \$(ls long/parts | grep -c 'part\$') -gt $before ]"
after=$(ls long/parts | grep -c 'part$')
if [ "$after" -gt "$before" ]; then pass "it went on from $before of 3200 blocks"; else wrong "it did not go on"; cat long.out; fi
scancel "${job}_1"
holds "a cancelled job is over" over "$job" 20
ended "${job}_1" CANCELLED

# ranks
if [ -n "$mpi" ]; then
   REEDVALVE_MPI=$mpi
   REEDVALVE_MPIRUN=$mpiexec
   export REEDVALVE_MPI REEDVALVE_MPIRUN
   job=$(sbatch --parsable --ntasks=3 --output=ranks.out "$scripts/ranks.sh" deck.nml ranks)
   holds "a job of ranks is over" over "$job" 60
   ended "$job" COMPLETED
   same whole ranks
   holds "there were three" grep -q 'processes: 3' ranks/run.log
   job=$(sbatch --parsable --ntasks=2 --output=stopped.out "$scripts/ranks.sh" long.nml stopped)
   until_true 20 test -e stopped/parts/block_000000001.part
   scancel --batch --signal=USR1 "$job"
   holds "ranks whose time is up get in line again" until_true 20 sh -c \
      "scontrol --oneliner show job $job | grep -E 'JobState=(PENDING|RUNNING).* Restarts=1'"
   holds "they stopped with whole blocks" grep -q 'blocks are finished and kept' stopped.out
   scancel "$job"
fi
finish
