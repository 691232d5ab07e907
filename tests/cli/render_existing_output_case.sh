# What exists is not replaced unless it is asked for.
source "$(dirname "$0")/case.sh"
echo precious >out.exr
expect_exit 2 render "$SCENES/small.toml" -o out.exr
expect_stderr "out.exr"
expect_stderr "--overwrite"
[[ $(cat out.exr) == precious ]] || fail "out.exr was touched"
expect_exit 2 render "$SCENES/small.toml" -o other.exr --lines out.exr
expect_only out.exr
expect_exit 0 render "$SCENES/small.toml" -o out.exr --overwrite
expect_starts out.exr 762f3101
expect_only out.exr
