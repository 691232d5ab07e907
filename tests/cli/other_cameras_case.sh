# Cameras of Astrometry.net and AIDA_tools, out and in again, and lists of stars.
source "$(dirname "$0")/case.sh"
cat >camera.toml <<'TOML'
[camera]
model = "equisolid"
width = 360
height = 240
focal_px = 260.0
azimuth_deg = 20.0
elevation_deg = 50.0
roll_deg = 5.0
[site]
latitude_deg = 65.1
longitude_deg = -147.4
altitude_m = 200.0
time_utc = "2014-03-10T06:05:33Z"
TOML
when=(--time 2014-03-10T06:05:33Z --site 65.1,-147.4,200)
# near KEY VALUE TOLERANCE: of the camera in back.toml.
near() {
  awk -v key="$1" -v wanted="$2" -v by="$3" '$1 == key { found = 1; exit !(($3 - wanted) ^ 2 <= by ^ 2) } END { if (!found) exit 1 }' back.toml ||
    fail "$1 is not $2 in $(grep "^$1" back.toml)"
}

expect_exit 0 directions camera.toml -o field.wcs
expect_stdout "field.wcs: SIP of order"
expect_starts field.wcs 53494d504c4520203d
[[ $(($(wc -c <field.wcs) % 2880)) -eq 0 ]] || fail "no whole blocks"
expect_exit 0 directions camera.toml -o again.wcs
expect_same field.wcs again.wcs
expect_exit 0 calibrate --wcs field.wcs "${when[@]}" -o back.toml --json back.json
near focal_px 260 0.05 && near azimuth_deg 20 0.01 && near elevation_deg 50 0.01 && near roll_deg 5 0.02
expect_stdout "points of the"
grep -q '"rms_px"' back.json || fail "no residual"

expect_exit 0 directions camera.toml -o station.acc
expect_stdout "station.acc: AIDA's lens 2: rms 0.000 px"
[[ $(wc -w <station.acc) -eq 15 ]] || fail "not fifteen numbers"
expect_exit 0 calibrate --acc station.acc --size 360,240 -o back.toml --overwrite
near focal_px 260 0.05 && near azimuth_deg 20 0.01 && near elevation_deg 50 0.01 && near roll_deg 5 0.02
cat station.acc station.acc >two.acc
expect_exit 0 calibrate --acc two.acc --acc-line 2 --size 360,240 -o back2.toml
# Upside down it is another camera: a mirrored one.
expect_exit 0 calibrate --acc station.acc --size 360,240 -o flipped.toml --skymap-flip rows
grep -q "^mirrored = true" flipped.toml || fail "a mirror image is not mirrored"

# Stars as solve-field lists them: the points of a picture, and those that are stars; both lead to the camera again.
source "$SOURCE/tests/cli/star_field.sh"
sky_to 0 >sky.pgm
stars=(--site 0,0 --time 2020-12-22T00:00:00Z)
expect_exit 0 calibrate --image sky.pgm --decoding linear "${stars[@]}" -o blind.toml --axy-out sky.axy --corr-out sky.corr
for file in sky.axy sky.corr; do expect_starts $file 53494d504c4520203d; done
expect_exit 0 calibrate sky.axy --camera blind.toml "${stars[@]}" -o back.toml --overwrite
expect_stdout "points of light"
near focal_px 250 0.5
expect_exit 0 calibrate sky.corr --size 480,360 "${stars[@]}" -o back.toml --overwrite
near focal_px 250 0.5

# What they say of themselves.
expect_exit 0 describe field.wcs
expect_stdout "SIP of order"
expect_stdout "360 x 240 pixels"
expect_exit 0 describe station.acc
expect_stdout "1 camera of AIDA_tools"
expect_exit 0 describe sky.axy
expect_stdout "points of light"
expect_exit 0 describe sky.corr
expect_stdout "stars that were"
expect_exit 0 directions camera.toml -o maps.fits
expect_exit 0 describe maps_az.fits
expect_stdout "360 x 240 pixels"

refuses() {
  local code=$1 words=$2
  shift 2
  expect_exit "$code" "$@"
  expect_one_message
  expect_stderr "$words"
}
refuses 2 "--camera" calibrate sky.axy "${stars[@]}" -o out.toml
refuses 2 "--time" calibrate --wcs field.wcs --site 65.1,-147.4 -o out.toml
refuses 2 "--size" calibrate --acc station.acc -o out.toml
refuses 2 "--acc-line" calibrate --acc two.acc --size 360,240 -o out.toml
refuses 2 "line 7" calibrate --acc two.acc --acc-line 7 --size 360,240 -o out.toml
refuses 2 "given twice" calibrate --acc station.acc --wcs field.wcs --size 360,240 "${when[@]}" -o out.toml
refuses 2 "--skymap-flip" calibrate --acc station.acc --size 360,240 -o out.toml --skymap-flip sideways
refuses 2 "an input" calibrate --acc station.acc --size 360,240 -o station.acc --overwrite
refuses 2 "--corr-out" calibrate --acc station.acc --size 360,240 -o out.toml --corr-out out.corr
refuses 2 "--axy-out" calibrate --acc station.acc --size 360,240 -o out.toml --axy-out out.axy
echo "1 2 3" >bad.acc
refuses 3 "bad.acc:1" calibrate --acc bad.acc --size 360,240 -o out.toml
refuses 3 "no FITS" calibrate --wcs bad.acc "${when[@]}" -o out.toml
head -c 1000 field.wcs >cut.wcs
expect_exit 3 calibrate --wcs cut.wcs "${when[@]}" -o out.toml
expect_one_message
refuses 2 "time_utc" directions camera.toml -o out.wcs --set site.time_utc=
refuses 2 "horizon" directions camera.toml -o out.wcs --set camera.elevation_deg=-80
refuses 2 ".wcs or .acc" directions camera.toml -o out.png
[[ ! -e out.toml && ! -e out.wcs && ! -e out.corr && ! -e out.axy ]] || fail "what is refused leaves something"
