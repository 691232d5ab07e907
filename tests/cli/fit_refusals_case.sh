# Fits that write no run: of what can be rendered only, to a folder that cannot be written, and that only check derivatives.
source "$(dirname "$0")/case.sh"
expect_exit 0 render "$SCENES/small.toml" -o photo.png

# What can be rendered but not fitted: exit 2, one message that says so, and no run.
refused() {  # KEY VALUE NEEDED
  expect_exit 2 fit "$SCENES/fit.toml" --photo photo.png --out run --set "$1=\"$2\""
  for words in "$1" "\"$2\" cannot be fitted" "\"$3\"" "for rendering only"; do expect_stderr "$words"; done
  expect_one_message
  [[ ! -e run ]] || fail "$1: a run was written"
}
refused blur.order rgb lines
refused film.weight unit rayleigh
refused film.splat nearest bilinear

# The derivative doctor: a table, exit 0 if all agree, 5 if a parameter has no effect; no run is written.
expect_exit 0 fit "$SCENES/fit.toml" --photo photo.png --check-derivatives
expect_stdout "All derivatives"
[[ $(grep -cE '^sheet\.main\..* agree$' "$stdout") -eq 2 ]] || fail "not two parameters that agree"
# Where the flux changes the brightness alone, the gains take it up entirely.
sed 's/^free = .*/free = ["sheet.main.energy_kev", "sheet.main.energy_flux_mw_m2"]/' "$SCENES/fit.toml" >flux.toml
expect_exit 5 fit flux.toml --photo photo.png --check-derivatives --set 'emission.flux_law="linear"'
grep -qE '^sheet\.main\.energy_flux_mw_m2 .* no effect$' "$stdout" || fail "the flux has an effect"
expect_stdout "1 of 2"
expect_exit 2 fit "$SCENES/fit.toml" --photo photo.png
expect_stderr "--out"
expect_only photo.png flux.toml
rm flux.toml

# A run that cannot be written: exit 6, and nothing is left behind but the finished steps, with which it can be
# written later.
echo "a file" >file
expect_exit 6 fit "$SCENES/fit.toml" --photo photo.png --out file/run
for blocks in 1 8 64; do
  status=0
  (ulimit -f "$blocks" && exec "$VEGARD" fit "$SCENES/fit.toml" --photo photo.png --out new/run --resume >"$stdout" 2>"$stderr") ||
    status=$?
  [[ $status -eq 6 ]] || fail "exit $status instead of 6 on a full disk"
  expect_stderr "new/run"
  left=$(find new -mindepth 1 2>/dev/null) || true
  [[ -z $left || $left == new/run.part ]] || fail "left behind: $left"
done
expect_exit 0 fit "$SCENES/fit.toml" --photo photo.png --out new/run --resume
expect_stderr "going on after"
expect_only file new photo.png
