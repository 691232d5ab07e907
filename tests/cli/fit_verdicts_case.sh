# What is not to be believed says so, in its exit code and in a run that can be read.
source "$(dirname "$0")/case.sh"
expect_exit 0 render "$SCENES/small.toml" -o photo.png
# The sheet behind the camera.
expect_exit 4 fit "$SCENES/fit.toml" --photo photo.png --out behind --set camera.azimuth_deg=180
expect_stdout "Do not believe it"
expect_stdout "camera points"
grep -qF '"verdict": "failed"' behind/result.json || fail "another verdict"
expect_file behind/report.html
# Stopped before it could converge.
expect_exit 4 fit "$SCENES/fit.toml" --photo photo.png --out stopped --max-evaluations 1
grep -qF '"verdict": "failed"' stopped/result.json || fail "another verdict"
# Stopped in the middle of a descent: in our words, without the solver's own on stderr.
expect_exit 4 fit "$SCENES/fit.toml" --photo photo.png --out midway --max-evaluations 4
for run in stopped midway; do
  grep -qF '"termination": "stopped: the evaluations ran out"' "$run/result.json" || fail "another end of $run"
done
! grep -qiE 'logging|terminating|trust_region' "$stderr" || fail "the solver's log is among the messages"
# Converged, with errors so wide that the agreement proves nothing: worth knowing, and nothing against the answer.
expect_exit 0 fit "$SCENES/fit.toml" --photo photo.png --out wide --set fit.model_error=0.2
grep -qF 'larger than what the model misses' wide/result.json || fail "nothing is said of chi2"
! grep -qiE '[^a-z"](nan|inf)[^a-z]' */result.json || fail "a number that JSON does not have"
