#!/bin/sh
# A deck as an array of slices; each finishes its blocks, in as many goes as its time limit makes it.
#    job=$(sbatch --parsable drivers/slurm/array.sh my.nml my)
#    sbatch --dependency=afterany:$job drivers/slurm/merge.sh my
# Options of sbatch, given before the script, override what stands here.
#SBATCH --job-name=reedvalve
#SBATCH --array=1-16
#SBATCH --cpus-per-task=4
#SBATCH --time=04:00:00
#SBATCH --signal=B:USR1@120
#SBATCH --requeue
#SBATCH --open-mode=append
set -u
deck=$1
folder=$2

# A warning that the time is up: stop with whole blocks, then get in line again. A cancelled job stops for good.
again=no
trap 'again=yes; kill -TERM "$work"' USR1
trap 'kill -TERM "$work"' TERM
${REEDVALVE:-reedvalve} run "$deck" -o "$folder" --slice "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" --resume \
   --threads "${SLURM_CPUS_PER_TASK:-1}" &
work=$!
# a signal ends a wait, not the work
while wait "$work"; status=$?; kill -0 "$work" 2>/dev/null; do :; done
if [ $again = yes ] && [ $status = 1 ]; then exec scontrol requeue "$SLURM_JOB_ID"; fi
exit $status
