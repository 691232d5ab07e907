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
# Two outputs appear both or not at all: the picture fits below the limit, the lines do not.
limit_kb=24
expect_exit 0 render "$SCENES/small.toml" -o out.jpg --quality 40 --lines lines.exr
[[ $(stat -c %s out.jpg) -lt $((limit_kb * 1024)) ]] || fail "the picture is too large for this case"
[[ $(stat -c %s lines.exr) -gt $((limit_kb * 1024)) ]] || fail "the lines are too small for this case"
rm out.jpg lines.exr
status=0
(ulimit -f "$limit_kb" && exec "$VEGARD" render "$SCENES/small.toml" -o out.jpg --quality 40 --lines lines.exr \
  >"$stdout" 2>"$stderr") || status=$?
[[ $status -eq 6 ]] || fail "exit $status instead of 6 for lines on a full disk"
expect_stderr lines.exr
expect_only
