# Ctrl-C, and what batch systems and closed terminals send: exit 130, 143 or 129, and nothing written.
source "$(dirname "$0")/case.sh"
set -m  # a job of its own; else the shell has it ignore the signal
long=(render "$SCENES/small.toml" -o out.exr --set sheet.main.beams=3000000 --threads 1)
for signal in INT:130 TERM:143 HUP:129; do
  "$VEGARD" "${long[@]}" >"$stdout" 2>"$stderr" &
  job=$!
  wait_until_interruptible "$job"
  kill "-${signal%:*}" "$job"
  status=0
  wait "$job" || status=$?
  [[ $status -eq ${signal#*:} ]] || fail "exit $status after $signal"
  expect_stderr "interrupted"
  expect_only
done
# A hangup that nohup has it ignore is ignored.
nohup "$VEGARD" "${long[@]}" >"$stdout" 2>"$stderr" &
job=$!
wait_until_interruptible "$job"
ignored=$(sed -n 's/^SigIgn:[[:space:]]*//p' "/proc/$job/status")
(((0x$ignored & 1) == 1)) || fail "nohup is of no use"
kill -HUP "$job"
kill -TERM "$job"
status=0
wait "$job" || status=$?
[[ $status -eq 143 ]] || fail "exit $status instead of 143"
expect_only
# What a process that is killed outright leaves of an output, the next of the same output clears away; what is another
# output's stays.
"$VEGARD" "${long[@]}" >"$stdout" 2>"$stderr" &
job=$!
wait_until_interruptible "$job"
kill -KILL "$job"
wait "$job" 2>/dev/null || true
touch ".out.partial-$job-0.exr" ".other.partial-$job-0.exr"
expect_exit 0 render "$SCENES/small.toml" -o out.exr
expect_only out.exr ".other.partial-$job-0.exr"
rm out.exr ".other.partial-$job-0.exr"
# Among the stars too, which are the last; all of them would take minutes.
sed '/^\[\[sheet\]\]/,/^$/d' "$SCENES/small.toml" >dark.toml
"$VEGARD" render dark.toml -o out.exr --set stars.shown=true --set stars.faintest_magnitude=12 \
  --set time.instants=1000 --set time.exposure_s=10 >"$stdout" 2>"$stderr" &
job=$!
wait_until_interruptible "$job"
wait_until_worked "$job" 20
kill -INT "$job"
for _ in $(seq 500); do
  kill -0 "$job" 2>/dev/null || break
  sleep 0.02
done
kill -KILL "$job" 2>/dev/null && fail "the stars go on after Ctrl-C"
status=0
wait "$job" || status=$?
[[ $status -eq 130 ]] || fail "exit $status instead of 130"
expect_stderr "interrupted"
expect_only dark.toml
