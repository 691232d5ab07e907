#!/usr/bin/env bash
# Installs what is missing, builds and runs the tests, and compares the time that took with the budget. The exit code is that
# of the tests, or 1 if something took too long.
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
ctest --preset release -j2 "${selection[@]}" --output-junit "$PWD/build/release/tests.xml"
# Both are looked at before either ends this. 77: there was too little to judge by, which was said.
within_budget() { scripts/budget.py "$@" || [[ $? -eq 77 ]]; }
status=0
within_budget build build/release || status=1
within_budget tests build/release build/release/tests.xml || status=1
exit "$status"
