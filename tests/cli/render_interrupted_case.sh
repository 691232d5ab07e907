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
