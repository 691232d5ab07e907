# One file per filter: profiles and their words, and what is refused.
source "$(dirname "$0")/case.sh"

printf 'P5\n160 120\n65535\n' >green.pgm
head -c 38400 /dev/zero | tr '\0' '\1' >>green.pgm
printf 'P5\n160 120\n65535\n' >red.pgm
head -c 38400 /dev/zero | tr '\0' '\2' >>red.pgm
printf 'P5\n16 12\n65535\n' >small.pgm
head -c 384 /dev/zero >>small.pgm

expect_exit 0 profile --line 557.7=green.pgm --line 630=red.pgm -o out.csv
grep -q '^# r: 557.7 nm, green.pgm, sha256 [0-9a-f]\{64\}$' out.csv || fail "the filter of red is not told"
grep -q '^# g: 630 nm, red.pgm, sha256' out.csv || fail "the filter of green is not told"
grep -q '^# b: no file$' out.csv || fail "it is not told that blue has no file"
grep -q '^# decoding: one file per filter: 557.7 nm linear (16-bit PGM, assumed; --decoding overrides); 630 nm ' out.csv ||
  fail "the decoding is not told"

expect_exit 2 profile green.pgm --line 630=red.pgm -o none.csv
expect_exit 2 profile -o none.csv
expect_exit 2 profile --line red.pgm -o none.csv
expect_exit 2 profile --line 630=red.pgm --line 557.7=green.pgm --line 427.8=red.pgm --line 486.1=red.pgm -o none.csv
expect_exit 3 profile --line 630=red.pgm --line 557.7=small.pgm -o none.csv
expect_exit 2 profile --line 557.7=green.pgm -o green.pgm --overwrite
expect_exit 2 fit "$SCENES/small.toml" --line 557.7=green.pgm --out run
expect_exit 2 fit "$SCENES/small.toml" --photo green.pgm --line 557.7=green.pgm --out run
[[ ! -e none.csv && ! -e run ]] || fail "a refused command has left something"

# The scene's lines say which channel is whose, and the files give the picture's size.
grep -v -e '^width = ' -e '^height = ' "$SCENES/small.toml" >sizeless.toml
cat >>sizeless.toml <<'END'

[sensor]
response = "filters"
END
expect_exit 0 profile --scene sizeless.toml --line 557.7=green.pgm --line 630=red.pgm -o ordered.csv
grep -q '^# r: 630 nm, red.pgm' ordered.csv || fail "the first line of the scene is not in the first channel"
expect_exit 2 profile --scene sizeless.toml --line 486.1=green.pgm -o none.csv
