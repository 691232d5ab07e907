# The judges of the error bars: asked for by flags, in result.json and the report, refused where they make no sense.
source "$(dirname "$0")/case.sh"
expect_exit 0 render "$SCENES/small.toml" -o photo.png
expect_exit 0 fit "$SCENES/fit.toml" --photo photo.png --out plain --threads 1
for key in profile_intervals bootstrap chain; do
  ! grep -qF "\"$key\":" plain/result.json || fail "$key without having been asked for"
done
expect_exit 0 fit "$SCENES/fit.toml" --photo photo.png --out judged --threads 1 --intervals --bootstrap 50 --mcmc 10
for stage in "profile likelihood" bootstrap "Markov chain"; do expect_stderr "$stage: "; done
for key in profile_intervals bootstrap chain; do
  grep -qF "\"$key\":" judged/result.json || fail "no $key in result.json"
done
grep -qF "Judging the error bars" judged/report.html || fail "the report does not show them"
[[ ! -e judged.part ]] || fail "the journal is left"
# They judge the answer and do not change it.
diff <(grep -v '^#' plain/best.toml) <(grep -v '^#' judged/best.toml) >&2 || fail "another answer"
expect_same plain/trace.csv judged/trace.csv
for flag in --bootstrap --mcmc; do
  expect_exit 2 fit "$SCENES/fit.toml" --photo photo.png --out wrong "$flag" 0
  expect_stderr "$flag"
done
