#!/usr/bin/env bash
# An hour of what is too long for every change: everything that reads is fed with damaged inputs, and killed.
#
#   scripts/soak.sh [--minutes N] [--out FOLDER] [--jobs N] [--seed N] [--skip units|fuzz|damage|kills]...
#
#   --minutes    how long to work once all is built (default 60). The unit tests take what they take, some minutes; of the rest
#                the fuzz targets have six tenths; 2000 damaged inputs and 50 kills of each command belong to an hour, fewer to less
#   --out        where logs, findings and the fuzzers' corpora go (default runs/soak; the corpora are gone on with the next time)
#   --jobs       of the compiler (default: one for each core)
#   --seed       of damaged inputs, kills and fuzzers (default: the day's number, so that no week looks at the last one's)
#   --skip       leave a part out; may be repeated
#
# It builds the presets asan (unit tests), fuzz (clang, with sanitizers) and release. In the end it prints a table; the exit code is 1
# if there is any finding, 2 if a tool is missing. A finding of the fuzzers that is mended belongs in tests/fuzz/corpus/TARGET.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

refuse() {
  echo "soak.sh: $*" >&2
  exit 2
}

minutes=60 out=runs/soak jobs=$(nproc) seed=$(($(date +%s) / 86400)) skipped=" "
while [[ $# -gt 0 ]]; do
  case $1 in
    --minutes | --out | --jobs | --seed | --skip)
      [[ $# -gt 1 ]] || refuse "$1 needs a value"
      case $1 in
        --minutes) minutes=$2 ;;
        --out) out=$2 ;;
        --jobs) jobs=$2 ;;
        --seed) seed=$2 ;;
        --skip) skipped+="$2 " ;;
      esac
      shift
      ;;
    -h | --help)
      sed -n '2,/^set /s/^#\( \|$\)//p' "${BASH_SOURCE[0]}"
      exit 0
      ;;
    *) refuse "unknown option '$1'; see scripts/soak.sh --help" ;;
  esac
  shift
done
for number in "$minutes" "$jobs" "$seed"; do [[ $number =~ ^[1-9][0-9]*$ ]] || refuse "'$number' is no whole number above 0"; done
for part in $skipped; do [[ " units fuzz damage kills " == *" $part "* ]] || refuse "--skip: there is no part '$part'"; done
wanted() { [[ $skipped != *" $1 "* ]]; }
if wanted fuzz; then
  command -v clang++ >/dev/null || refuse "clang++ is missing: packages.txt names it"
fi

mkdir -p "$out"
targets=(fuzz_scene fuzz_image fuzz_grids fuzz_tables fuzz_runs fuzz_arrays)
build() { # PRESET TARGETS...
  local preset=$1 log=$out/build-$1.log
  shift
  if cmake --preset "$preset" >"$log" 2>&1 && cmake --build "build/$preset" -j "$jobs" --target "$@" >>"$log" 2>&1; then return; fi
  tail -n 30 "$log" >&2
  refuse "the preset $preset does not build"
}
build release vegard "${targets[@]}"
if wanted fuzz; then build fuzz "${targets[@]}"; fi
if wanted units; then build asan sim_tests fit_tests apps_tests; fi

rows=() findings=0
row() { # PART RUNS SECONDS FINDINGS
  rows+=("$(printf '%-22s %10s %9s %9s' "$1" "$2" "$(awk "BEGIN { printf \"%.1f\", $3 / 60 }")" "$4")")
  findings=$((findings + $4))
}

export UBSAN_OPTIONS=print_stacktrace=1
units() { # PROGRAM
  local log=$out/$1.log begin=$SECONDS found=0
  "build/asan/tests/$1" --gtest_brief=1 >"$log" 2>&1 </dev/null || found=1
  if [[ $found -eq 1 ]]; then tail -n 40 "$log" >&2; fi
  row "$1, sanitized" "$(sed -n 's/^\[==========\] \([0-9]*\) tests.*/\1/p' "$log" | tail -n 1)" $((SECONDS - begin)) "$found"
}

# A finding ends the fuzzer: it begins again with what it knows, until its time is over.
fuzz() { # TARGET SECONDS
  local target=$1 corpus=$out/corpus-$1 seeds=$out/seeds-$1 begin=$SECONDS end=$((SECONDS + $2)) runs=0 log=$out/$1.log before after
  mkdir -p "$corpus" "$seeds" "$out/findings"
  build/release/tests/"$target" --source . --write-corpus "$seeds"
  before=$(find "$out/findings" -name "$target-*" | wc -l)
  : >"$log"
  local round=0
  while [[ $SECONDS -lt $end ]]; do
    round=$((round + 1))
    "build/fuzz/tests/$target" "$corpus" "$seeds" -dict="$seeds.dictionary" -seed=$((seed + round)) -max_len=65536 -timeout=10 \
      -rss_limit_mb=3072 -max_total_time=$((end - SECONDS)) -artifact_prefix="$out/findings/$target-" -print_final_stats=1 \
      -close_fd_mask=1 >"$log.now" 2>&1 </dev/null || true
    runs=$((runs + $(sed -n 's/^stat::number_of_executed_units: *//p' "$log.now" | tail -n 1 | grep . || echo 0)))
    grep -aE '^SUMMARY|ERROR: |runtime error' "$log.now" | sort | uniq -c >&2 || true
    cat "$log.now" >>"$log"
    [[ $round -lt 200 ]] || break # one that falls over at once
  done
  rm -f "$log.now"
  after=$(find "$out/findings" -name "$target-*" | wc -l)
  row "$target" "$runs" $((SECONDS - begin)) $((after - before))
}

counted() { # NAME LOG_PATTERN WORDS...
  local name=$1 pattern=$2 begin=$SECONDS status=0 log=$out/$1.log
  shift 2
  "$@" >"$log" 2>&1 </dev/null || status=$?
  [[ $status -le 1 ]] || { tail -n 5 "$log" >&2 && refuse "$name ended with $status"; }
  sed -n '/^$/,$p' "$log" # its own table
  local line
  line=$(tail -n 1 "$log")
  row "$name" "$(sed -n "s/^\([0-9]*\) $pattern.*/\1/p" <<<"$line")" $((SECONDS - begin)) "$(sed -n 's/.*: \([0-9]*\) findings.*/\1/p' <<<"$line")"
}

whole=$((60 * minutes))
if wanted units; then for program in sim_tests fit_tests apps_tests; do units "$program"; done; fi
if wanted fuzz; then for target in "${targets[@]}"; do fuzz "$target" $((whole * 6 / 10 / ${#targets[@]})); done; fi
if wanted damage; then
  counted damage "damaged inputs" python3 scripts/damage.py --seed "$seed" --inputs $((2000 * minutes / 60 + 1)) --findings "$out/damage"
fi
if wanted kills; then counted kills kills python3 scripts/kills.py --seed "$seed" --kills $((50 * minutes / 60 + 1)); fi

printf '\n%-22s %10s %9s %9s\n' part runs minutes findings
printf '%s\n' "${rows[@]}"
if [[ $findings -gt 0 ]]; then
  echo "soak.sh: $findings findings; logs and inputs are in $out" >&2
  exit 1
fi
echo "soak.sh: nothing found"
