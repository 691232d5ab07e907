# vegard lines: the listing, the page, the table, the plot, and how they refuse.
set -eu
vegard=$1
source=$2

fail() {
  echo "FAILED: $*" >&2
  exit 1
}

# expect_exit CODE PART COMMAND...: the exit code, and one line "vegard: …PART…" on the error stream.
expect_exit() {
  local code=$1 part=$2 got=0
  shift 2
  "$@" > out.txt 2> err.txt || got=$?
  [ "$got" = "$code" ] || fail "$* gave $got, not $code: $(cat err.txt)"
  [ "$code" = 0 ] && return
  [ "$(wc -l < err.txt)" = 1 ] || fail "$*: more than one line: $(cat err.txt)"
  grep -qF -- "$part" err.txt || fail "$*: no '$part' in: $(cat err.txt)"
}

rm -f quenching.svg quenching.png
expect_exit 0 "" "$vegard" lines
grep -q '^636.4 nm  O    (1D)-(3P); lives 116.6 s; light: 0.3337 × ver_6300$' out.txt || fail "the listing lacks 636.4 nm"
grep -q 'blended with N2 first positive (2,0) 775.4' out.txt || fail "777.4 nm is not named as a blend"

expect_exit 0 "" "$vegard" lines --csv
[ "$(head -1 out.txt | cut -d, -f1-4)" = wavelength_nm,species,transition,lifetime_s ] || fail "the table's head"
[ "$(wc -l < out.txt)" = 31 ] || fail "the table has not thirty lines"

expect_exit 0 "" "$vegard" lines --markdown
diff -u "$source/docs/lines.md" out.txt || fail "docs/lines.md is out of date: vegard lines --markdown > docs/lines.md"

expect_exit 0 "" "$vegard" lines --quenching quenching.svg
[ ! -s out.txt ] || fail "the plot prints something"
diff -q "$source/docs/pictures/quenching.svg" quenching.svg || fail "docs/pictures/quenching.svg is out of date"
expect_exit 2 "quenching.svg" "$vegard" lines --quenching quenching.svg
expect_exit 0 "" "$vegard" lines --quenching quenching.svg --overwrite
expect_exit 0 "" "$vegard" lines --quenching quenching.png
expect_exit 2 "names no kind of picture" "$vegard" lines --quenching quenching.jpg
expect_exit 2 "excludes" "$vegard" lines --csv --markdown
expect_exit 6 "" "$vegard" lines --quenching missing/quenching.svg

# A scene with the lines that have no column of their own.
cat > lines.toml <<'SCENE'
[emission]
lines = [391.4, 630.0, 636.4, 670.5]
[[sheet]]
beams = 50
SCENE
expect_exit 0 "" "$vegard" params lines.toml
grep -q '^blur\.width_deg\.6364  *0\.43 ' out.txt || fail "636.4 nm is not blurred as 630.0 nm"
sed -i 's/391.4, /600, /' lines.toml
expect_exit 2 "no emission line at 600 nm" "$vegard" params lines.toml
