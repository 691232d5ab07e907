# The validation of the error bars: asked for by flags, in result.json and the report, refused where they make no sense.
source "$(dirname "$0")/case.sh"
expect_exit 0 render "$SCENES/small.toml" -o photo.png
expect_exit 0 fit "$SCENES/fit.toml" --photo photo.png --out plain --threads 1
for key in profile_intervals bootstrap chain; do
  ! grep -qF "\"$key\":" plain/result.json || fail "$key without having been asked for"
done
expect_exit 0 fit "$SCENES/fit.toml" --photo photo.png --out validated --threads 1 --intervals --bootstrap 50 --mcmc 10
for stage in "profile likelihood" bootstrap "Markov chain"; do expect_stderr "$stage: "; done
for key in profile_intervals bootstrap chain; do
  grep -qF "\"$key\":" validated/result.json || fail "no $key in result.json"
done
grep -qF "Validation of the error bars" validated/report.html || fail "the report does not show them"
[[ ! -e validated.part ]] || fail "the journal is left"
# It assesses the answer and does not change it.
diff <(grep -v '^#' plain/best.toml) <(grep -v '^#' validated/best.toml) >&2 || fail "another answer"
expect_same plain/trace.csv validated/trace.csv
for flag in --bootstrap --mcmc; do
  expect_exit 2 fit "$SCENES/fit.toml" --photo photo.png --out wrong "$flag" 0
  expect_stderr "$flag"
done

# Ctrl-C in the chain: the fit's own answer is a run, and --resume goes on; here to the end, without the chain.
set -m # a job of its own; else the shell has it ignore the signal
fit=(fit "$SCENES/fit.toml" --photo photo.png --out cut --threads 1 --intervals)
"$VEGARD" "${fit[@]}" --mcmc 1000000 >"$stdout" 2>"$stderr" &
job=$!
until grep -q "Markov chain" "$stderr"; do
  kill -0 "$job" 2>/dev/null || fail "ended before it was cut off"
  sleep 0.01
done
kill -INT "$job"
status=0
wait "$job" || status=$?
set +m
[[ $status -eq 130 ]] || fail "exit $status instead of 130"
expect_stderr "--resume goes on"
expect_stdout "Believable"
grep -qF '"profile_intervals":' cut/result.json || fail "the validation that was finished is left out"
! grep -qF '"chain":' cut/result.json || fail "half a chain is told"
expect_exit 0 "${fit[@]}" --resume
expect_stderr "going on after"
! grep -qF validation_interrupted cut/result.json || fail "the run is still the one that was cut short"
expect_same plain/trace.csv cut/trace.csv
