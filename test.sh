#!/usr/bin/env bash
# Installs what is missing, builds and runs the tests. The exit code is that of the tests.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

selection=(--label-exclude slow)
for argument in "$@"; do
  case "$argument" in
    --slow) selection=() ;;
    -h | --help)
      echo "usage: ./test.sh [--slow]"
      echo "  --slow  run the tests labelled slow as well"
      exit 0
      ;;
    *)
      echo "test.sh: unknown option '$argument'; see ./test.sh --help" >&2
      exit 2
      ;;
  esac
done

# shellcheck source=scripts/set_up.sh
source scripts/set_up.sh

set_up
exec ctest --preset release -j2 "${selection[@]}"
