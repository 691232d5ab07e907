#!/usr/bin/env bash
# From a fresh clone to a first report: installs what is missing, builds the command, fits the example and says where its report is.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
# shellcheck source=scripts/set_up.sh
source scripts/set_up.sh

set_up vegard

example=data/examples/h000
run=runs/h000
status=0
mkdir -p "$(dirname "$run")"
build/release/vegard fit "$example/scene.toml" --photo "$example/photo.jpg" --out "$run" --overwrite || status=$?

# 0: good. 5: converged, but the verdict doubts the answer; that report is worth reading too.
if [[ $status -eq 0 || $status -eq 5 ]]; then
  echo
  if [[ $status -eq 5 ]]; then
    echo "The fit converged, but its verdict doubts the answer; the report says why."
  fi
  echo "The report: $PWD/$run/report.html"
else
  echo "The fit ended with exit code $status and without an answer." >&2
fi
exit "$status"
