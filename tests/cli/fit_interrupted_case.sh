# Ctrl-C: the best so far as a whole run, and exit 130.
source "$(dirname "$0")/case.sh"
expect_exit 0 render "$SCENES/small.toml" -o photo.png
set -m  # a job of its own; else the shell has it ignore the signal
"$VEGARD" fit "$SCENES/fit.toml" --photo photo.png --out run --set sheet.main.beams=15000 --set fit.scan_points=1000 --set fit.model=draws \
  --threads 1 >"$stdout" 2>"$stderr" &
job=$!
# The first line of a stage says that the work is under way.
interrupt "$job"
[[ $status -eq 130 ]] || fail "exit $status instead of 130"
grep -qF '"verdict": "interrupted"' run/result.json || fail "another verdict"
grep -qF '"termination": "stopped by the user"' run/result.json || fail "another end"
! grep -qiE 'logging|terminating|trust_region' "$stderr" || fail "the solver's log is among the messages"
for file in best.toml map.svg model.exr profiles.csv report.html residual.exr trace.csv; do expect_file "run/$file"; done
expect_exit 0 render run/best.toml -o best.png --set sheet.main.beams=50
