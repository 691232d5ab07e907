# A fit repeated with other choices: the same shifts for any number of threads, one photograph or two.
source "$(dirname "$0")/case.sh"
expect_exit 0 render "$SCENES/small.toml" -o photo.png
expect_exit 0 fit "$SCENES/fit.toml" --photo photo.png --out plain
! grep -qF '"stability"' plain/result.json || fail "it was not asked for"
expect_exit 0 fit "$SCENES/fit.toml" --photo photo.png --out one --threads 1 --stability
expect_stdout "by the fit's choices"
expect_exit 0 fit "$SCENES/fit.toml" --photo photo.png --out two --threads 2 --stability
for text in '"choice": "region"' '"name": "without its left third"' '"choice": "curve"' '"is_refuted": '; do
  grep -qF -- "$text" one/result.json || fail "no '$text' in result.json"
done
grep -qF '<h2>Stability</h2>' one/report.html || fail "nothing in the report"
diff <(grep -v '"command"' one/result.json) <(grep -v '"command"' two/result.json) >&2 ||
  fail "result.json depends on the threads"
# It assesses the answer and does not change it.
diff <(grep -v '^#' plain/best.toml) <(grep -v '^#' one/best.toml) >&2 || fail "another answer"

# Ctrl-C meanwhile: the fit's own answer is a run, and --resume goes on to the same bytes.
set -m # a job of its own; else the shell has it ignore the signal
fit=(fit "$SCENES/fit.toml" --photo photo.png --out cut --threads 1 --stability)
: >"$stderr" # what the last fit said
"$VEGARD" "${fit[@]}" >"$stdout" 2>"$stderr" &
job=$!
until grep -q "stability" "$stderr"; do
  kill -0 "$job" 2>/dev/null || fail "ended before it was cut off"
  sleep 0.01
done
kill -INT "$job"
status=0
wait "$job" || status=$?
set +m
[[ $status -eq 130 ]] || fail "exit $status instead of 130"
grep -qF '"validation_interrupted": true' cut/result.json || fail "nothing says that it was cut off"
expect_exit 0 "${fit[@]}" --resume
diff <(grep -v '"command"' one/result.json) <(grep -v '"command"' cut/result.json) >&2 || fail "another result"
