# What can be rendered but not fitted: exit 2, one message that says so, and no run.
source "$(dirname "$0")/case.sh"
expect_exit 0 render "$SCENES/small.toml" -o photo.png
refused() {  # KEY VALUE NEEDED
  expect_exit 2 fit "$SCENES/fit.toml" --photo photo.png --out run --set "$1=\"$2\""
  for words in "$1" "\"$2\" cannot be fitted" "\"$3\"" "for rendering only"; do expect_stderr "$words"; done
  expect_one_message
  [[ ! -e run ]] || fail "$1: a run was written"
}
refused blur.order rgb lines
refused film.weight unit rayleigh
refused film.splat nearest bilinear
