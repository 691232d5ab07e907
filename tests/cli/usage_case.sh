# Wrong words on the command line: exit 2; being asked for help or the version: exit 0.
source "$(dirname "$0")/case.sh"
expect_exit 2
expect_stderr "which subcommand"
expect_exit 2 rendre
expect_stderr "did you mean 'render'?"
expect_exit 2 xyzzyxyzzy
! grep -q "did you mean" "$stderr" || fail "a word that is like none"
expect_exit 2 render "$SCENES/small.toml" -o out.exr --treads 2
expect_stderr "did you mean '--threads'?"
expect_exit 2 render
expect_exit 2 render "$SCENES/small.toml"
expect_exit 2 render "$SCENES/small.toml" -o out.exr --no-such-option
expect_exit 2 render "$SCENES/small.toml" -o out.xyz
expect_exit 2 render "$SCENES/small.toml" -o out.exr --threads -1
expect_exit 2 render "$SCENES/small.toml" -o out.jpg --bits 16
expect_exit 2 render "$SCENES/small.toml" -o out.exr --bits 8
expect_exit 2 render "$SCENES/small.toml" -o out.png --quality 50
expect_exit 2 render "$SCENES/small.toml" -o out.exr --lines out.exr
expect_exit 2 render "$SCENES/small.toml" -o ./same.exr --lines same.exr
expect_stderr --lines
expect_exit 2 render "$SCENES/small.toml" --lines lines.exr --bits 16
expect_stderr --bits
expect_exit 2 render "$SCENES/small.toml" --lines lines.exr --quality 50
expect_stderr --quality
expect_exit 2 render "$SCENES/small.toml" -o out.exr --lines lines.png
expect_exit 2 render "$SCENES/small.toml" -o out.exr --seed minus
expect_exit 2 render "$SCENES/small.toml" -o out.exr --seed -1
expect_exit 2 render "$SCENES/small.toml" -o out.exr --seed 18446744073709551615
expect_exit 2 fit "$SCENES/small.toml"
expect_exit 2 profile
expect_only
expect_exit 0 --help
expect_stdout render
expect_stdout "numbers:"
# What an option takes, its default and its limits are words, not the library's types.
expect_exit 0 render --help
expect_stdout --overwrite
expect_stdout "Quality of a JPEG (default: 92; 1 to 100)"
expect_stdout "needs --as-seen"
if grep -E "INT|FLOAT|TEXT:" "$stdout"; then fail "the help has names of types"; fi
expect_exit 0 animate --help
expect_stdout "--frames FIRST:LAST[:STEP]"
expect_exit 0 survey --help
expect_stdout "Subcommands:"
expect_exit 0 fit --help
expect_stdout --photo
expect_exit 0 --version
expect_stdout vegard
for library in Ceres OpenCV Eigen OpenImageIO CFITSIO SQLite; do expect_stdout "$library"; done
