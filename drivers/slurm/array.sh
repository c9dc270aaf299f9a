#!/bin/sh
# A deck as an array of slices; each finishes its blocks, in as many goes as its time limit makes it.
#    job=$(sbatch --parsable --array=1-16 drivers/slurm/array.sh my.nml my)
#    sbatch --dependency=afterany:$job drivers/slurm/merge.sh my
# Task I of N is slice I/N. To run some slices only, such as those that failed, say how many there are in all:
#    sbatch --array=4,11 drivers/slurm/array.sh my.nml my 16
# Options of sbatch, given before the script, override what stands here.
#SBATCH --job-name=reedvalve
#SBATCH --array=1-16
#SBATCH --cpus-per-task=4
#SBATCH --time=04:00:00
#SBATCH --signal=B:USR1@120
#SBATCH --requeue
#SBATCH --open-mode=append
set -u

# give_up WORDS...
give_up() {
   echo "array.sh: $*" >&2
   exit 2
}
if [ $# -lt 2 ] || [ $# -gt 3 ]; then give_up "usage: sbatch --array=1-16 array.sh DECK FOLDER [SLICES]"; fi
deck=$1
folder=$2
slice=${SLURM_ARRAY_TASK_ID:-}
if [ -z "$slice" ]; then give_up "this is no task of a Slurm array: submit it with sbatch --array=1-16"; fi
slices=${3:-${SLURM_ARRAY_TASK_COUNT:-}}
case $slices in
'' | *[!0-9]*) give_up "SLICES must be the number of slices of the whole run, not '$slices'" ;;
esac
if [ "$slice" -lt 1 ] || [ "$slice" -gt "$slices" ]; then
   give_up "task $slice of an array is none of $slices slices. All of them: --array=1-$slices;" \
      "some of N only: --array=$slice array.sh $deck $folder N"
fi

# A warning that the time is up: stop with whole blocks, then get in line again. A cancelled job stops for good.
again=no
trap 'again=yes; kill -TERM "$work"' USR1
trap 'kill -TERM "$work"' TERM
${REEDVALVE:-reedvalve} run "$deck" -o "$folder" --slice "$slice/$slices" --resume \
   --threads "${SLURM_CPUS_PER_TASK:-1}" &
work=$!
# a signal ends a wait, not the work
while wait "$work"; status=$?; kill -0 "$work" 2>/dev/null; do :; done
if [ $again = yes ] && [ $status = 1 ]; then exec scontrol requeue "$SLURM_JOB_ID"; fi
exit $status
