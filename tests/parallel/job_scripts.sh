# The job scripts of drivers/slurm without a Slurm, in the surroundings that it would give them.
# sh job_scripts.sh PROGRAM
scripts=$(cd "$(dirname "$0")/../../drivers/slurm" && pwd)
. "$(dirname "$0")/../faults/common.sh"
own=$program
REEDVALVE=$own
REEDVALVE_MPI=$own   # one rank is much like a run
REEDVALVE_MPIRUN=env
export REEDVALVE REEDVALVE_MPI REEDVALVE_MPIRUN
unset SLURM_ARRAY_TASK_ID SLURM_ARRAY_TASK_COUNT SLURM_CPUS_PER_TASK
sweep_deck 20 1.0e-6 >deck.nml

# job SCRIPT: $program is that script from now on
job() {
   printf '#!/bin/sh\nexec sh "%s" "$@"\n' "$scripts/$1" >as_job
   chmod 755 as_job
   program=./as_job
}

# task I COUNT: $program is task I of an array of so many from now on
task() {
   printf '#!/bin/sh\nSLURM_ARRAY_TASK_ID=%s SLURM_ARRAY_TASK_COUNT=%s exec sh "%s" "$@"\n' "$1" "$2" "$scripts/array.sh" >as_task
   chmod 755 as_task
   program=./as_task
}

expect 0 'none failed' run deck.nml -o whole

# an array of seven, of which two tasks fail
for slice in 1 3 4 6 7; do
   task $slice 7
   expect 0 "^Slice $slice/7: .* none failed" deck.nml folder
done
program=$own
expect 3 '5 of 16 blocks are not finished \(2, 5, 9, 12, 16\)' merge folder

# these two alone
task 5 2
expect 2 'task 5 of an array is none of 2 slices.* some of N only: --array=5 array.sh deck.nml folder N' deck.nml folder
expect 0 '^Slice 5/7: .* none failed' deck.nml folder 7
task 2 2
expect 0 '^Slice 2/7: .* none failed' deck.nml folder 7
job merge.sh
expect 0 'none failed' folder
same whole folder

# words
task 0 16
expect 2 'task 0 of an array is none of 16 slices. All of them: --array=1-16' deck.nml none
task 17 17
expect 2 'task 17 of an array is none of 16 slices' deck.nml none 16
task 1 1
expect 2 "SLICES must be the number of slices of the whole run, not 'x'" deck.nml none x
expect 2 'usage: sbatch --array=1-16 array.sh DECK FOLDER \[SLICES\]' deck.nml
expect 2 'usage' deck.nml none 16 16
job array.sh
expect 2 'no task of a Slurm array: submit it with sbatch --array=1-16' deck.nml none
job merge.sh
expect 2 'usage: sbatch merge.sh FOLDER'
job ranks.sh
expect 2 'usage: sbatch --ntasks=16 ranks.sh DECK FOLDER' deck.nml
fails "none of these made a folder" test -e none
expect 0 'none failed' deck.nml ranks
same whole ranks
finish
