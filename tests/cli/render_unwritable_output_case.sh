# A folder that is missing, and a full disk (a limit on a file's size looks the same): exit 6, nothing left behind.
source "$(dirname "$0")/case.sh"
expect_exit 6 render "$SCENES/small.toml" -o no/such/folder/out.exr
expect_stderr "no/such/folder"
for name in out.exr out.png out.tif out.jpg; do
  status=0
  (ulimit -f 4 && exec "$VEGARD" render "$SCENES/small.toml" -o "$name" >"$stdout" 2>"$stderr") || status=$?
  [[ $status -eq 6 ]] || fail "exit $status instead of 6 for $name on a full disk"
  expect_stderr "$name"
done
expect_only
