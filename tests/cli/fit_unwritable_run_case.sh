# A run that cannot be written: exit 6, and nothing is left behind but the finished steps, with which it can be
# written later.
source "$(dirname "$0")/case.sh"
expect_exit 0 render "$SCENES/small.toml" -o photo.png
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
