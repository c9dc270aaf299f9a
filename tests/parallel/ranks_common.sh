# What scripts with MPI ranks share, on top of those of tests/faults.
# sh script PROGRAM RTOL MPI_PROGRAM MPIEXEC
. "$(dirname "$0")/../faults/common.sh"
own=$program
mpi=${3:-}
mpiexec=${4:-}
# Open MPI asks for leave to run as root and to have more ranks than processors.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_odls_base_sigkill_timeout=0   # [s], its patience with ranks that outlive one that failed
export OMPI_MCA_rmaps_base_oversubscribe=1 PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe

# with_ranks N: from now on $program is the MPI program on N ranks
with_ranks() {
   printf '#!/bin/sh\nexec "%s" -n %d "%s" "$@"\n' "$mpiexec" "$1" "$mpi" >on_ranks
   chmod 755 on_ranks
   program=./on_ranks
}

# start_ranks N DECK FOLDER: set $job to mpiexec, leave each rank's process number in pid.RANK, wait until the work begins
start_ranks() {
   rm -f pid.*
   "$mpiexec" -n "$1" sh -c 'echo $$ >pid.${OMPI_COMM_WORLD_RANK:-${PMI_RANK:-0}}; exec "$@"' sh "$mpi" \
      run "$2" -o "$3" --resume >out.txt 2>err.txt &
   job=$!
   while kill -0 $job 2>/dev/null && [ ! -e "$3/parts/manifest" ]; do :; done
}
