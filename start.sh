#!/usr/bin/env bash
# From a fresh clone to a first report: installs what is missing, builds the command, fits the example and says where its report is.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
with_python=false
for argument in "$@"; do
  case "$argument" in
    --python) with_python=true ;;
    -h | --help)
      echo "usage: ./start.sh [--python]"
      echo "  --python  build the Python module as well (docs/python.md)"
      exit 0
      ;;
    *)
      echo "start.sh: unknown option '$argument'; see ./start.sh --help" >&2
      exit 2
      ;;
  esac
done

# shellcheck source=scripts/set_up.sh
source scripts/set_up.sh

if $with_python; then set_up vegard vegard_python; else set_up vegard; fi

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
  if $with_python; then
    echo "The Python module: PYTHONPATH=$PWD/build/release/python /usr/bin/python3 -c 'import vegard'"
  fi
else
  echo "The fit ended with exit code $status and without an answer." >&2
fi
exit "$status"
