#!/bin/sh
# Runs every benchmark once with a tiny workload and looks for its last line.
set -eu
for program in "$@"; do
  output=$("$program" --tiny --benchmark_min_time=0.001 --benchmark_repetitions=2) || {
    echo "$output"
    echo "$program failed"
    exit 1
  }
  echo "$output"
  echo "$output" | grep -q '(target ' || { echo "$program printed no ratio"; exit 1; }
done
