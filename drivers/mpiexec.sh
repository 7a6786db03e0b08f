#!/usr/bin/env bash
# mpiexec for long runs: fsi-mpiexec MPIEXEC-ARGUMENTS... takes the arguments of mpiexec.
#
# Open MPI's mpiexec answers SIGINT and SIGTERM by itself: it kills the ranks a second later and ends
# with code 1 whatever they end with. SIGUSR2 it passes on, and then it ends with the code of the
# ranks. So either signal to this script, Ctrl-C among them, reaches the run as SIGUSR2: it finishes
# its step, writes a checkpoint, and the script ends with its code, 5. MPIEXEC names another mpiexec.
#
# As root, as in most containers, Open MPI runs only where two variables say so: then they are set.
[ "$(id -u)" -ne 0 ] || export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
set -m # a process group of its own: a Ctrl-C of the terminal does not reach mpiexec
"${MPIEXEC:-mpiexec}" "$@" </dev/null &
job=$!
set +m
trap 'kill -USR2 "$job" 2>/dev/null' INT TERM HUP USR2
trap 'kill -USR1 "$job" 2>/dev/null' USR1
# A signal interrupts the wait; the code of the job is what counts.
while kill -0 "$job" 2>/dev/null; do wait "$job"; done
wait "$job"
exit $?
