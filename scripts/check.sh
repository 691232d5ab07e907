#!/usr/bin/env bash
# What a change is to pass before it is shared, beside ./test.sh:
#
#   scripts/check.sh [--format] [--tidy] [--sanitize] [--base COMMIT | --all]
#
#   --format     clang-format finds nothing to change
#   --tidy       clang-tidy finds nothing to complain of (.clang-tidy says which checks count, and why not all)
#   --sanitize   the unit tests under the address and the undefined-behaviour sanitizer
#   --base       format and tidy look at what changed since this commit, uncommitted and new files included (default: where this branch
#                left origin/main, or else the commit before this one)
#   --all        they look at every file; clang-tidy then takes a quarter of an hour
#
# Without a step named, all three. The exit code is 1 if any finds something, 2 if a tool is missing: packages.txt names them.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

refuse() {
  echo "check.sh: $*" >&2
  exit 2
}

need() { # PROGRAM
  command -v "$1" >/dev/null ||
    refuse "$1 is missing: apt-get install --no-install-recommends $(sed -n 's/^#check //p' packages.txt | xargs)"
}

format=false tidy=false sanitize=false all=false base=
while [[ $# -gt 0 ]]; do
  case $1 in
    --format) format=true ;;
    --tidy) tidy=true ;;
    --sanitize) sanitize=true ;;
    --all) all=true ;;
    --base)
      [[ $# -gt 1 ]] || refuse "--base needs a commit"
      base=$2
      shift
      ;;
    -h | --help)
      sed -n '2,/^set /s/^#\( \|$\)//p' "${BASH_SOURCE[0]}"
      exit 0
      ;;
    *) refuse "unknown option '$1'; see scripts/check.sh --help" ;;
  esac
  shift
done
if ! $format && ! $tidy && ! $sanitize; then format=true tidy=true sanitize=true; fi

default_base() {
  local fork
  fork=$(git merge-base HEAD origin/main 2>/dev/null) || fork=
  if [[ -n $fork && $fork != "$(git rev-parse HEAD)" ]]; then echo "$fork"; else echo HEAD~1; fi
}

# The C++ files to look at, one a line.
files() {
  if $all; then
    git ls-files '*.cpp' '*.h'
  else
    { git diff --name-only --diff-filter=d "$base" -- '*.cpp' '*.h' && git ls-files --others --exclude-standard '*.cpp' '*.h'; } | sort -u
  fi
}

# What clang-tidy compiles to see them: a header is seen through the .cpp of its stem, or else through one that includes it.
units() {
  local file unit
  files | while read -r file; do
    unit=${file%.h}.cpp
    if [[ $file == *.cpp ]]; then
      echo "$file"
    elif [[ -e $unit ]]; then
      echo "$unit"
    else
      git grep -lF "#include \"$file\"" -- '*.cpp' | head -1
    fi
  done | sort -u
}

check_format() {
  need clang-format
  files | xargs -r clang-format --dry-run -Werror
}

# The preset is configured and not built, but for a source that is made: its compile commands have no precompiled headers. Of a few
# files each is looked at by itself, of all several as one unit, which takes a third of the time.
check_tidy() {
  need clang-tidy
  cmake --preset tidy -DVEGARD_UNITY=$($all && echo ON || echo OFF) >build/tidy.log &&
    cmake --build build/tidy --target embedded_data >>build/tidy.log || { cat build/tidy.log >&2; return 1; }
  local unit
  if $all; then
    sed -n 's/^ *"file": "\(.*\)",\{0,1\}$/\1/p' build/tidy/compile_commands.json | sort -u
  else
    units | while read -r unit; do
      if grep -qF "\"file\": \"$PWD/$unit\"" build/tidy/compile_commands.json; then echo "$unit"; else echo "clang-tidy: $unit is not compiled" >&2; fi
    done
  fi | xargs -r -n 1 -P "$(nproc)" clang-tidy -p build/tidy --quiet 2>&1 | sed '/ warnings\{0,1\} generated\.$/d'
}

# Each program as often as there are cores, every time with its share of the tests. A finding ends a program, so it is looked for by
# the exit code; the end of the log says what and where.
check_sanitize() {
  cmake --preset asan >build/asan.log || { cat build/asan.log >&2; return 1; }
  cmake --build --preset asan -j "$(nproc)" --target sim_tests fit_tests apps_tests || return 1
  local program share failed=0
  local -A shares=()
  for program in sim_tests fit_tests apps_tests; do
    for share in $(seq 0 $(($(nproc) - 1))); do
      GTEST_TOTAL_SHARDS=$(nproc) GTEST_SHARD_INDEX=$share UBSAN_OPTIONS=print_stacktrace=1 \
        "build/asan/tests/$program" --gtest_brief=1 >"build/asan/$program.$share.log" 2>&1 &
      shares[$!]=$program.$share
    done
    for share in "${!shares[@]}"; do
      wait "$share" && continue
      echo "sanitizers: the end of build/asan/${shares[$share]}.log" >&2
      tail -n 40 "build/asan/${shares[$share]}.log" >&2
      failed=1
    done
    shares=()
  done
  return "$failed"
}

if ! $all && { $format || $tidy; }; then
  base=${base:-$(default_base)}
  git rev-parse --verify --quiet "$base^{commit}" >/dev/null || refuse "--base: there is no commit '$base'"
  echo "Since $(git log -1 --format='%h, %s' "$base"): $(files | wc -l) files"
fi

mkdir -p build
findings=()
if $format; then check_format || findings+=(clang-format); fi
if $tidy; then check_tidy || findings+=(clang-tidy); fi
if $sanitize; then check_sanitize || findings+=(sanitizers); fi
if [[ ${#findings[@]} -gt 0 ]]; then
  echo "check.sh: findings of ${findings[*]}" >&2
  exit 1
fi
echo "check.sh: nothing found"
