# Ctrl-C: exit 130 and nothing written.
source "$(dirname "$0")/case.sh"
set -m  # a job of its own; else the shell has it ignore the signal
"$VEGARD" render "$SCENES/small.toml" -o out.exr --set sheet.main.beams=3000000 --threads 1 >"$stdout" 2>"$stderr" &
job=$!
wait_until_interruptible "$job"
kill -INT "$job"
status=0
wait "$job" || status=$?
[[ $status -eq 130 ]] || fail "exit $status instead of 130"
expect_stderr "interrupted"
expect_only
# Among the stars too, which are the last; all of them would take minutes.
sed '/^\[\[sheet\]\]/,/^$/d' "$SCENES/small.toml" >dark.toml
"$VEGARD" render dark.toml -o out.exr --set stars.shown=true --set stars.faintest_magnitude=12 \
  --set time.instants=1000 --set time.exposure_s=10 >"$stdout" 2>"$stderr" &
job=$!
wait_until_interruptible "$job"
sleep 0.2
kill -INT "$job"
for _ in $(seq 100); do
  kill -0 "$job" 2>/dev/null || break
  sleep 0.1
done
kill -KILL "$job" 2>/dev/null && fail "the stars go on after Ctrl-C"
status=0
wait "$job" || status=$?
[[ $status -eq 130 ]] || fail "exit $status instead of 130"
expect_stderr "interrupted"
expect_only dark.toml
