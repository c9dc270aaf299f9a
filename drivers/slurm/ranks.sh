#!/bin/sh
# A deck on MPI ranks, in as many goes as the time limit makes it; the ranks write the results themselves.
#    sbatch --ntasks=64 drivers/slurm/ranks.sh my.nml my
# Options of sbatch, given before the script, override what stands here. REEDVALVE_MPIRUN='srun --mpi=pmix
# --kill-on-bad-exit' starts the ranks with srun instead of mpirun.
#SBATCH --job-name=reedvalve
#SBATCH --ntasks=16
#SBATCH --cpus-per-task=1
#SBATCH --time=04:00:00
#SBATCH --signal=B:USR1@120
#SBATCH --requeue
#SBATCH --open-mode=append
set -u
if [ $# != 2 ]; then
   echo "ranks.sh: usage: sbatch --ntasks=16 ranks.sh DECK FOLDER" >&2
   exit 2
fi
deck=$1
folder=$2

# A warning that the time is up: stop with whole blocks, then get in line again. A cancelled job stops for good.
# Both go on as SIGUSR1: after a SIGTERM to itself mpirun soon kills its ranks. Unbound, for else all threads of a
# rank may share one core.
again=no
trap 'again=yes; kill -USR1 "$work"' USR1
trap 'kill -USR1 "$work"' TERM
${REEDVALVE_MPIRUN:-mpirun --bind-to none} ${REEDVALVE_MPI:-reedvalve_mpi} run "$deck" -o "$folder" --resume \
   --threads "${SLURM_CPUS_PER_TASK:-1}" &
work=$!
# a signal ends a wait, not the work
while wait "$work"; status=$?; kill -0 "$work" 2>/dev/null; do :; done
if [ $again = yes ] && [ $status = 1 ]; then exec scontrol requeue "$SLURM_JOB_ID"; fi
exit $status
