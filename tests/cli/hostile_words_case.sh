# Words of inputs act on nothing: neither on the terminal, nor in pages, nor on those who read JSON; and none fills the screen.
# shellcheck disable=SC2154  # stdout, stderr: of case.sh
source "$(dirname "$0")/case.sh"
export LC_ALL=C
esc=$'\x1b' title=$'\x1b]0;owned\x07' csi=$'\x9b31m' turned=$'\xe2\x80\xae'

# harmless: the last run gave the terminal nothing but text.
harmless() {
  local file
  for file in "$stdout" "$stderr"; do
    if grep -qP '[\x00-\x08\x0b-\x1f\x7f]|\xc2[\x80-\x9f]|\xe2\x80[\xa8-\xae]|\xe2\x81[\xa6-\xa9]' "$file"; then
      fail "control characters"
    fi
    iconv -f UTF-8 -t UTF-8 "$file" >/dev/null 2>&1 || fail "no UTF-8"
    [[ $(wc -c <"$file") -le 4000 ]] || fail "$(wc -c <"$file") bytes of words"
  done
}

# refused CODE SHOWN ARGUMENTS...
refused() {
  local code=$1 words=$2
  shift 2
  expect_exit "$code" "$@"
  expect_stderr "$words"
  expect_one_message
  harmless
}

# --- Names of files, of options and their values ---
refused 3 '\x1b]0;owned\x07' render "$title.toml" -o out.png
refused 3 '\x9b31m' render "$csi.toml" -o out.png
refused 3 '\u202e' render "a${turned}b.toml" -o out.png
refused 3 'a\x0ab' render $'a\nb.toml' -o out.png
refused 2 '\x1b' "$title"
refused 2 '\x1b' render "$SCENES/small.toml" -o out.png "--$title"
refused 2 '\x1b' render "$SCENES/small.toml" -o out.png --threads "$title"
refused 2 '\x1b' render "$SCENES/small.toml" -o out.png --set "sheet.$title.energy_kev=3"
refused 2 'bytes left out' render "$SCENES/small.toml" -o out.png --set "sheet.main.$(printf 'k%.0s' $(seq 4000))=3"
refused 2 'bytes left out' render "$SCENES/small.toml" -o out.png --set "camera.model=\"$(printf 'm%.0s' $(seq 9000))\""
refused 6 '\x1b' render "$SCENES/small.toml" -o "no/$title/out.png"

# --- Scenes: keys and values ---
{ cat "$SCENES/small.toml"; printf '[camera.\x1b]\n'; } >raw.toml
refused 2 'raw.toml' render raw.toml -o out.png
{ printf '"\\u001b[31m\\u202e" = 3\n'; cat "$SCENES/small.toml"; } >key.toml
refused 2 '\x1b[31m\u202e' render key.toml -o out.png
{ head -c 100000 /dev/zero | tr '\0' k; printf ' = 3\n'; cat "$SCENES/small.toml"; } >long.toml
expect_exit 2 render long.toml -o out.png
harmless
{ cat "$SCENES/small.toml"; printf '[sensor]\nresponse = "'; head -c 100000 /dev/zero | tr '\0' v; printf '"\n'; } >value.toml
refused 2 'bytes left out' render value.toml -o out.png

# --- Pictures: an EXR's channels, a list's lines ---
expect_exit 0 render "$SCENES/small.toml" -o lines.png --lines lines.exr
expect_exit 0 render "$SCENES/small.toml" -o photo.png
# A channel's name with an escape in it, of the same length.
channel=$(strings -n 4 lines.exr | grep -m1 'nm' || true)
[[ -n $channel ]] || fail "no channel of a line"
sed "s/${channel:0:4}/$esc[1m/" lines.exr >channel.exr
expect_exit 3 profile channel.exr -o out.csv
harmless
printf 'missing\x1b[2J.png 3\nphoto.png 4\n' >list.txt
refused 3 '\x1b[2J.png' keogram list.txt -o out.csv

# --- A photograph whose name is a page, and one whose name is no UTF-8 ---
page='<script>alert(1)<\script>"x".png' latin=$'caf\xe9.png'
cp photo.png "$page"
cp photo.png "$latin"
expect_exit 0 describe "$latin"
expect_stdout 'caf\xe9.png says'
harmless
for name in "$page" "$latin"; do
  "$VEGARD" fit "$SCENES/fit.toml" --photo "$name" --out run --max-evaluations 3 --set sheet.main.beams=20 --overwrite \
    >"$stdout" 2>"$stderr" || [[ $? -eq 4 || $? -eq 5 ]] || fail "a fit of $name"
  harmless
  for file in result.json report.html; do
    expect_file "run/$file"
    iconv -f UTF-8 -t UTF-8 "run/$file" >/dev/null || fail "$file of $name is no UTF-8"
  done
  ! grep -q '<script>alert' run/report.html || fail "a name became a script"
  ! grep -rqF '<script>alert' run --include='*.svg' || fail "a name became a script of a plot"
done
grep -qF 'caf' run/result.json || fail "the photograph's name"
expect_exit 0 animate "$SCENES/small.toml" -o $'fr\xe9\x1b/##.png' --frames 0:0
harmless
expect_exit 0 animate "$SCENES/small.toml" -o $'fr\xe9\x1b/##.png' --frames 0:0
expect_stdout "1 of them"
awk 'BEGIN {
  print "name,azimuth_deg,zenith_deg,x_px,y_px"
  for (i = 0; i < 12; ++i) {
    azimuth = 77 * i % 360; zenith = 8 + 6 * i; r = 15 * zenith * atan2(0, -1) / 180; a = azimuth * atan2(0, -1) / 180
    printf "st\xe9r\033 %d,%g,%g,%.6f,%.6f\n", i, azimuth, zenith, 33 + r * sin(a), 23 + r * cos(a)
  }
}' >stars.csv
expect_exit 0 calibrate stars.csv -o camera.toml --size 64,48 --site 65,20,100 --time 2020-01-01T20:00:00Z --json stars.json \
  --plot stars.svg
harmless
for file in stars.json stars.svg; do
  expect_file $file
  iconv -f UTF-8 -t UTF-8 $file >/dev/null || fail "$file is no UTF-8"
  ! grep -q "$esc" $file || fail "an escape in $file"
done
