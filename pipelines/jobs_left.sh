#!/bin/sh
# jobs_left.sh FILE: those of the jobs of Slurm named in FILE that have not ended. Where there is no
# Slurm, or it does not know them any more, they have.
command -v squeue >/dev/null 2>&1 || exit 0
while read -r job; do
  [ -z "$(squeue --noheader --jobs="$job" --format=%i 2>/dev/null)" ] || printf '%s ' "$job"
done <"$1"
