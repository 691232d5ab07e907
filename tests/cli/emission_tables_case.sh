# Emission tables that a scene names: a folder with GLOW's own files gives GLOW's light, a run finds it again, and what is wrong with
# a folder is told before any work.
source "$(dirname "$0")/case.sh"
mkdir scenes
cp "$SCENES/small.toml" scenes/default.toml
{
  cat "$SCENES/small.toml"
  printf '[emission]\ntables = "glow"\n'
} >scenes/plain.toml
{
  cat "$SCENES/small.toml"
  printf '[emission]\ntables = "own"\n'
} >scenes/scene.toml
cp -r "$SOURCE/data/glow" scenes/own
# Points have the light of each line as floats, and nothing of what their scene says.
light() { expect_exit 0 points "$1" -o "$2" --max-points 2000 --overwrite "${@:3}"; }

light scenes/plain.toml plain.ply
light scenes/scene.toml own.ply
expect_same plain.ply own.ply
light scenes/plain.toml own.ply --set 'emission.tables="own"'
expect_same plain.ply own.ply

# The default tables are the program's own, which are those of data/emission; GLOW's are others.
light scenes/default.toml default.ply
cp -r "$SOURCE/data/emission" scenes/ours
for tables in vegard ours; do
  light scenes/plain.toml own.ply --set "emission.tables=\"$tables\""
  expect_same default.ply own.ply
done
if cmp -s default.ply plain.ply; then fail "GLOW's tables and the default ones give the same light"; fi

# Several factors of oxygen: 557.7 nm goes as the inverse of the factor.
awk -F, -v OFS=, '
  NR == 1 { print "oxygen_factor," $0; next }
  { rows[++count] = $0 }
  END {
    for (f = 0.5; f <= 2; f *= 2)
      for (i = 1; i <= count; ++i) { $0 = rows[i]; $6 = sprintf("%.9e", $6 / f); print f, $0 }
  }' "$SOURCE/data/glow/ver_maxwellian.csv" >scenes/own/ver_maxwellian.csv
light scenes/scene.toml own.ply
expect_same plain.ply own.ply
green() {  # FACTOR: rayleighs of 557.7 nm of one layer
  expect_exit 0 brightness scenes/scene.toml --set "emission.oxygen_factor=$1"
  sed -n 's/^ *557.7 nm *\([0-9.]*\) kR$/\1/p' "$stdout"
}
awk -v half="$(green 0.5)" -v one="$(green 1)" -v more="$(green 1.6)" 'BEGIN {
  exit !(half / one > 1.99 && half / one < 2.01 && more * 1.6 / one > 0.99 && more * 1.6 / one < 1.01) }' ||
  fail "the light of 557.7 nm does not go as the factor"

# It may be free, within the factors that there are; the run finds its folder again.
{
  cat scenes/scene.toml
  printf '[fit]\nbands = 4\nscan_points = 0\nfree = ["emission.oxygen_factor", "sheet.main.bearing_deg"]\n'
} >scenes/fit.toml
expect_exit 0 render scenes/scene.toml -o photo.png --set emission.oxygen_factor=1.4
expect_exit 0 fit scenes/fit.toml --photo photo.png --check-derivatives
status=0
"$VEGARD" fit scenes/fit.toml --photo photo.png --out run >"$stdout" 2>"$stderr" || status=$?
[[ $status -eq 0 || $status -eq 5 ]] || fail "the fit ends with $status"
grep -qF 'tables = "../scenes/own"' run/best.toml || fail "best.toml looks for its tables elsewhere"
expect_exit 0 render run/best.toml -o best.png
expect_exit 2 render scenes/scene.toml -o out.png --set emission.oxygen_factor=2.5
expect_stderr "from 0.5 to 2"
expect_exit 2 render scenes/plain.toml -o out.png --set emission.oxygen_factor=1.1
expect_stderr "atomic oxygen"
expect_one_message
sed 's/^tables = .*/tables = "glow"/' scenes/fit.toml >scenes/fit_glow.toml
expect_exit 2 fit scenes/fit_glow.toml --photo photo.png --out out
expect_stderr "no emission.oxygen_factor in fit.free"
expect_one_message

# What is wrong.
refused() {  # WORDS...
  local command words
  for command in "render scenes/scene.toml -o out.png" "fit scenes/fit.toml --photo photo.png --out out"; do
    # shellcheck disable=SC2086
    expect_exit 3 $command
    for words in "$@"; do expect_stderr "$words"; done
    expect_one_message
    [[ ! -e out.png && ! -e out ]] || fail "something was written"
  done
}
anew() { rm -rf scenes/own && cp -r "$SOURCE/data/glow" scenes/own; }
anew
sed -i '105s/,[^,]*$/,-1/' scenes/own/ver_maxwellian.csv
refused "scenes/own/ver_maxwellian.csv:105" "-1 in column 'ionisation_electron'"
anew
sed -i 105d scenes/own/ver_maxwellian.csv
refused "scenes/own/ver_maxwellian.csv:105"
anew
rm scenes/own/atmosphere.csv
refused "emission.tables" "own/atmosphere.csv"
rm -r scenes/own
refused "emission.tables" "no such folder" "scene's file"
touch scenes/own
refused "no such folder"
