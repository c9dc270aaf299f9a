#!/bin/sh
# The results of a run whose slices are done; says which blocks are missing if they are not.
#    sbatch --dependency=afterany:$job drivers/slurm/merge.sh my
#SBATCH --job-name=reedvalve-merge
#SBATCH --time=01:00:00
if [ $# != 1 ]; then
   echo "merge.sh: usage: sbatch merge.sh FOLDER" >&2
   exit 2
fi
exec ${REEDVALVE:-reedvalve} merge "$1"
