#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# A batch job for Slurm, to be changed and handed in with `sbatch scripts/slurm_job.sh SCENE PICTURE`. A minute before
# its time is up it keeps what it has in the journal beside the picture and asks to be queued again, until the picture
# is there.
#SBATCH --job-name=tessera
#SBATCH --ntasks=64
#SBATCH --time=01:00:00
#SBATCH --signal=B:TERM@60
#SBATCH --requeue
#SBATCH --open-mode=append
set -uo pipefail
scene=${1:?the scene is missing}
picture=${2:?the picture is missing}

# sbatch runs a copy of this script: the programs are those of the folder that it was handed in from, or of the PATH.
PATH=${SLURM_SUBMIT_DIR:-.}/scripts:$PATH
tessera-run -n "${SLURM_NTASKS:-2}" -- "$scene" -o "$picture" --progress plain &
run=$!
trap 'kill -TERM $run' TERM
wait $run
code=$?
while kill -0 $run 2>/dev/null; do # the signal ended the waiting, not the run
  wait $run
  code=$?
done

if [ $code -eq 143 ] && [ -n "${SLURM_JOB_ID:-}" ]; then
  scontrol requeue "$SLURM_JOB_ID"
fi
exit $code
