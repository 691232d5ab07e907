# Commands of seconds: Ctrl-C and its like end them at once, with the exit code of the signal, and no half of an
# output is left.
source "$(dirname "$0")/case.sh"
set -m # jobs of their own; else the shell has them ignore the signal
# A photograph of 24 megapixels, so that there is time to interrupt its reading.
{
  printf 'P6\n6000 4000\n255\n'
  yes 'a photograph of no aurora' | head -c 72000000
} >photo.ppm || true # yes is told that nobody listens any more
# The same as a grey TIFF, its header (nine entries: size, 8 bits, not packed, one strip from byte 122 on) by hand.
{
  base64 -d <<<"SUkqAAgAAAAJAAABBAABAAAAcBcAAAEBBAABAAAAoA8AAAIBAwABAAAACAAAAAMBAwABAAAAAQAAAAYBAwABAAAA\
AQAAABEBBAABAAAAegAAABUBAwABAAAAAQAAABYBBAABAAAAoA8AABcBBAABAAAAADZuAQAAAAA="
  yes 'a photograph of no aurora' | head -c 24000000
} >photo.tif || true
large=(--set camera.width=6000 --set camera.height=4000)
printf 'name,azimuth_deg,zenith_deg,x_px,y_px\n' >stars.csv
for i in $(seq 9); do echo "star $i,$((77 * i % 360)),$((8 + 6 * i)),$((300 + 40 * i * i)),$((200 + 90 * i))"; done >>stars.csv

# interrupted SIGNAL CODE ARGUMENTS...
interrupted() {
  local signal=$1 code=$2 status=0
  shift 2
  "$VEGARD" "$@" >"$stdout" 2>"$stderr" &
  local job=$!
  wait_until_interruptible "$job"
  kill "-$signal" "$job"
  wait "$job" || status=$?
  [[ $status -eq $code ]] || fail "exit $status instead of $code: vegard $*"
  expect_stderr "vegard: interrupted"
  expect_one_message
  expect_only photo.ppm photo.tif stars.csv
}
for signal in INT:130 TERM:143 HUP:129; do
  interrupted "${signal%:*}" "${signal#*:}" linearise photo.ppm "$SCENES/small.toml" "${large[@]}" -o out.exr
done
interrupted INT 130 directions "$SCENES/small.toml" "${large[@]}" -o out.fits
interrupted INT 130 keogram photo.ppm photo.ppm -o out.csv -o out.png
interrupted INT 130 profile photo.ppm -o out.csv
interrupted INT 130 mask photo.ppm --stars -o out.png
interrupted INT 130 sdf photo.tif --threshold 0.4 -o out.exr
interrupted INT 130 calibrate stars.csv --image photo.ppm -o out.toml
interrupted TERM 143 brightness "$SCENES/small.toml" --set sheet.main.beams=3000000 --threads 1
# A folder that is not finished goes with its files.
"$VEGARD" tables -o out --threads 1 >"$stdout" 2>"$stderr" &
job=$!
wait_until_interruptible "$job"
for _ in $(seq 500); do
  compgen -G '.out.partial-*' >/dev/null && break
  sleep 0.02
done
compgen -G '.out.partial-*' >/dev/null || fail "no folder was begun"
touch "$(compgen -G '.out.partial-*')/half.csv"
kill -TERM "$job"
status=0
wait "$job" || status=$?
[[ $status -eq 143 ]] || fail "exit $status instead of 143"
expect_only photo.ppm photo.tif stars.csv
