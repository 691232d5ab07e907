# How numbers become light: every word on the command line and in a scene, what is refused, and that each output
# says what was taken.
source "$(dirname "$0")/case.sh"
expect_exit 0 render "$SCENES/small.toml" -o photo.png
printf 'linear,encoded\n0,0\n0.2,0.5\n1,1\n' >curve.csv
mean() { awk -F, '!/^#/ && head++ { sum += $5 } END { print sum }' "$1"; }
for pair in 'srgb|sRGB (8-bit PNG, as asked)' 'auto|sRGB (8-bit PNG, by its PNG sRGB)' 'srgb:1.3|sRGB^1.3 (8-bit PNG, as asked)' \
  'srgb:1.3:0.8|sRGB^1.3 to 0.8 (8-bit PNG, as asked)' 'linear|linear (8-bit PNG, as asked)' \
  'gamma:2.2|gamma 2.2 (8-bit PNG, as asked)' 'curve:curve.csv|curve curve.csv, SHA-256 ' \
  'unknown|unknown, taken as sRGB (8-bit PNG, as asked)' \
  'unknown:2|unknown with two exponents, taken as sRGB (8-bit PNG, as asked)'; do
  word=${pair%%|*} text=${pair#*|}
  expect_exit 0 profile photo.png -o out.csv --overwrite --decoding "$word"
  expect_stdout "decoding: $text"
  grep -qF "# decoding: $text" out.csv || fail "'$text' is not in the table"
  cp out.csv "${word//:/_}.csv"
done
[[ $(mean srgb.csv) == "$(mean auto.csv)" && $(mean srgb.csv) == "$(mean unknown.csv)" ]] || fail "the default is not sRGB"
for word in linear gamma_2.2 srgb_1.3 curve_curve.csv; do
  [[ $(mean srgb.csv) != "$(mean $word.csv)" ]] || fail "$word decodes as sRGB does"
done
# The sensor's curve of the same name does the same as the short word.
cp "$SCENES/small.toml" sensor.toml
printf '\n[sensor]\ntone = "gamma"\ngamma = 2.2\n' >>sensor.toml
expect_exit 0 profile photo.png -o sensor.csv --scene sensor.toml --decoding sensor
[[ $(mean sensor.csv) == "$(mean gamma_2.2.csv)" ]] || fail "gamma:2.2 is not the sensor's gamma 2.2"
# In a scene; a curve stands beside it, and goes with the best scene.
fit_with() { sed "s/^\[fit\].*/&\ndecoding = \"$1\"/" "$SCENES/fit.toml" >"$2"; }
mkdir scenes
cp curve.csv scenes
fit_with curve:curve.csv scenes/curved.toml
expect_exit 0 profile photo.png -o beside.csv --scene scenes/curved.toml --bands 24
[[ $(mean beside.csv) == "$(mean curve_curve.csv.csv)" ]] || fail "the scene's curve is another"
"$VEGARD" fit scenes/curved.toml --photo photo.png --out curved >"$stdout" 2>"$stderr" || [[ $? -eq 5 ]] || fail "no run"
expect_stdout "decoding: curve curve.csv, SHA-256 "
expect_same curve.csv curved/curve.csv
grep -qF 'decoding = "curve:curve.csv"' curved/best.toml || fail "the best scene has lost its decoding"
expect_exit 0 params curved/best.toml
for file in result.json report.html profiles.csv best.toml model.exr residual.exr; do
  grep -qaF "curve curve.csv, SHA-256 " "curved/$file" || fail "$file does not say how the photograph was decoded"
done
# Refused, with one message each.
refused() {
  local code=$1 word=$2 text=$3
  expect_exit "$code" profile photo.png -o refused.csv --decoding "$word"
  expect_stderr "$text"
  [[ ! -e refused.csv ]] || fail "something was written"
}
refused 2 gamma "which gamma"
refused 2 gamma:0 "no increasing curve"
refused 2 gamma:-1 "no increasing curve"
refused 2 srbg "is no decoding"
refused 2 curve:curve.txt "names no table"
refused 3 curve:none.csv "no such file"
bad() { printf 'linear,encoded\n%s' "$1" >bad.csv; refused 3 curve:bad.csv "$2"; expect_one_message; }
bad $'0,0\n0.5,0.6\n0.6,0.5\n1,1\n' "bad.csv"
bad $'0,0\n' "one row is no curve"
bad $'0,0\n1,1.5\n' "1.5"
bad $'0,0\n0.9,1\n' "from black to white"
fit_with gamma:0 zero.toml
expect_exit 2 fit zero.toml --photo photo.png --out zero
expect_stderr "fit.decoding"
expect_one_message
# Unknown: found with the scene; told everywhere; not for floats, nor for what cannot be weighed with it.
"$VEGARD" fit "$SCENES/fit.toml" --photo photo.png --out found --decoding unknown >"$stdout" 2>"$stderr" ||
  [[ $? -eq 5 ]] || fail "no run with an unknown curve"
expect_stdout "decoding: unknown | sRGB"
expect_stdout "exponent of the transfer curve over sRGB of all light: "
word=$(sed -n 's/^to take the curve as known: --decoding //p' "$stdout")
for file in result.json report.html profiles.csv best.toml model.exr residual.exr; do
  grep -qaF "unknown, found as sRGB to the power of " "found/$file" || fail "$file does not tell the curve"
done
grep -qF '"curve": {' found/result.json || fail "no curve in result.json"
expect_exit 0 profile photo.png -o known.csv --decoding "$word"
expect_exit 2 fit "$SCENES/fit.toml" --photo photo.png --out no --decoding unknown --set fit.colour_weight=1
expect_stderr "fit.colour_weight"
expect_exit 2 fit "$SCENES/fit.toml" --photo photo.png --out no --decoding unknown --mcmc 10
expect_stderr "unknown transfer curve"
expect_exit 2 sequence "$SCENES/fit.toml" --photos photo.png -o no --decoding unknown
expect_stderr "one transfer curve"
[[ ! -e no ]] || fail "something was written"
expect_exit 0 sequence "$SCENES/fit.toml" --photos photo.png -o frames --decoding srgb
grep -qF "# decoding: sRGB (8-bit PNG, as asked)" frames/sequence.csv || fail "the sequence does not tell the decoding"
grep -qF '"decoding": "sRGB (8-bit PNG, as asked)"' frames/frames/photo.json || fail "the frame does not tell the decoding"
expect_exit 0 compare frames/frames/photo frames/frames/photo
expect_stdout "decoding: sRGB (8-bit PNG, as asked)"
expect_exit 2 compare frames/frames/photo found
expect_stderr "another decoding"
