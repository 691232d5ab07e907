# Ctrl-C: exit 130, whole frames only, and the same command goes on to the same bytes.
source "$(dirname "$0")/case.sh"
scene_with 's/beams = 150/beams = 20000/; s/energy_kev = 3.0/energy_kev = 3.0\ndrift_km_s = [2.0, 0.0]/'
set -m # a job of its own; else the shell has it ignore the signal
"$VEGARD" animate scene.toml -o part/###.png --threads 1 >"$stdout" 2>"$stderr" &
job=$!
until [[ -e part/001.png ]]; do
  kill -0 "$job" 2>/dev/null || fail "ended before it was interrupted"
  sleep 0.02
done
kill -INT "$job"
status=0
wait "$job" || status=$?
[[ $status -eq 130 ]] || fail "exit $status instead of 130"
expect_stderr "same command"
frames=$(find part -name '[0-9]*.png' | wc -l)
[[ $frames -ge 2 && $frames -lt 60 ]] || fail "$frames frames after the interruption"
[[ $(find part -type f | wc -l) -eq $((frames + 1)) ]] || fail "more than frames and a manifest is left"
"$VEGARD" animate scene.toml -o part/###.png --threads 1 >"$stdout" 2>"$stderr" &
job=$!
wait_until_interruptible "$job"
kill -TERM "$job"
status=0
wait "$job" || status=$?
[[ $status -eq 143 ]] || fail "exit $status instead of 143"
frames=$(find part -name '[0-9]*.png' | wc -l)
expect_exit 0 animate scene.toml -o part/###.png --frames "0:$frames"
expect_stdout "$((frames + 1)) frames | 160 x 120 | $frames of them"
expect_exit 0 animate scene.toml -o whole/###.png --frames "$frames:$frames"
expect_same "part/$(printf %03d "$frames").png" "whole/$(printf %03d "$frames").png"
# What a process that was killed outright has left is removed; what a living one writes, or what is no part
# of a frame to be made, is not.
sleep 0 &
dead=$!
wait "$dead"
mkdir half
touch "half/.001.partial-$dead-0.png" "half/.000.partial-$$-0.png" "half/.009.partial-$dead-0.png" "half/.a.partial-$dead-0.png"
expect_exit 0 animate scene.toml -o half/###.png --frames 0:1
(cd half && expect_only 000.png 001.png animation.json ".000.partial-$$-0.png" ".009.partial-$dead-0.png" ".a.partial-$dead-0.png")
touch "half/.002.partial-$dead-12.png"
expect_exit 0 animate scene.toml -o half/###.png --frames 1:2
[[ ! -e half/.002.partial-$dead-12.png ]] || fail "an orphan is left after going on"
