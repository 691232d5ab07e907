# Imagers' frames in HDF5, MATLAB and CDF files and in tars (tests/data/imagers, by other writers), films, and skymaps.
source "$(dirname "$0")/case.sh"
made=$SCENES/../../data/imagers
cp "$made"/{rgb.h5,stack.mat,stack_v73.mat,asi.cdf,asi_packed.cdf,minute.png.tar,minute.pgm.gz,frame.fits.gz,huge.h5,skymap.sav} .

# What there is to choose from, and one frame by its number and its time.
for file in rgb.h5 stack.mat stack_v73.mat asi.cdf asi_packed.cdf minute.png.tar minute.pgm.gz; do
  expect_exit 0 describe $file
  expect_stdout "3 frames, 2021-10-30T06:05:00.25"
  expect_stdout "#2     2021-10-30T06:05:06.25"
  expect_exit 0 profile $file --at 2021-10-30T06:05:06Z -o at.csv --bands 1 --overwrite
  expect_exit 0 profile $file#2 -o number.csv --bands 1 --overwrite
  expect_same at.csv number.csv
done
expect_exit 0 describe stack.mat#1
expect_stdout 'site.time_utc = "2021-10-30T06:05:03.25'
expect_exit 0 keogram asi.cdf -o k.csv
expect_stdout "3 pictures | 5 x 4"
expect_exit 2 profile rgb.h5 -o no.csv
expect_stderr "one picture | 3 frames"
expect_one_message
expect_exit 2 profile minute.png.tar#3 -o no.csv
expect_stderr "no frame 3"
expect_exit 0 describe rgb.h5#0
expect_stdout 'time.exposure_s = 2.8 (HDF5 word "subframe_requested_exposure")'
expect_exit 0 describe minute.png.tar#0
expect_stdout "rgb-04"
expect_exit 0 describe minute.pgm.gz
expect_stdout "themis19"
expect_stdout "packed by gzip"
expect_exit 0 describe frame.fits.gz
expect_stdout '5 x 4 pixels'
expect_stdout 'site.time_utc = "2021-10-30T06:05:03.25'
expect_exit 0 describe skymap.sav
expect_stdout "is a skymap"
expect_stdout "6 x 4 pixels"
expect_stdout "skymap/full_azimuth, skymap/full_elevation"
expect_exit 2 describe skymap.sav -o no.toml
expect_one_message
[[ ! -e no.toml ]] || fail "a scene of a skymap was written"

# What is declared and is not there, and what is cut short: one message, nothing written.
expect_exit 3 describe huge.h5
expect_stderr "400000 x 400000"
expect_one_message
for cut in 3000:rgb.h5 200:stack.mat 600:asi.cdf 700:minute.png.tar; do
  file=${cut#*:}
  head -c "${cut%%:*}" $file >cut_$file
  expect_exit 3 profile cut_$file#0 -o no.csv
  expect_stderr "cut_$file"
  expect_one_message
  [[ ! -e no.csv ]] || fail "something was written"
done

# A skymap is a camera. IDL's file is written here in XDR, rows from the bottom as in FITS, and FITS with two planes.
fisheye="--set camera.model=equisolid --set camera.focal_px=52 --set camera.elevation_deg=87 --set camera.roll_deg=33
  --set camera.principal_x_px=2.5"
expect_exit 0 directions "$SCENES/small.toml" $fisheye -o maps.fits
python3 - <<'EOF'
import struct
def planes(name):
    data = open(name, "rb").read()
    end = next(i for i in range(0, len(data), 80) if data[i:i + 80].strip() == b"END")
    cards = {data[i:i + 8].strip(): data[i + 10:i + 30].strip() for i in range(0, end, 80)}
    begin = (end // 2880 + 1) * 2880
    return int(cards[b"NAXIS1"]), int(cards[b"NAXIS2"]), data[begin:]
width, height, azimuth = planes("maps_az.fits")
_, _, elevation = planes("maps_el.fits")
size = 4 * width * height
card = lambda key, value: f"{key:<8}= {value:>20}".ljust(80)
head = "".join([card("SIMPLE", "T"), card("BITPIX", "-32"), card("NAXIS", "3"), card("NAXIS1", width), card("NAXIS2", height),
                card("NAXIS3", "2"), "END"]).ljust(2880).encode()
data = azimuth[:size] + elevation[:size]
open("sky.fits", "wb").write(head + data.ljust(-(-len(data) // 2880) * 2880, b"\0"))
number = lambda *n: struct.pack(">%di" % len(n), *n)
text = lambda t: number(len(t)) + t.encode().ljust(-(-len(t) // 4) * 4, b"\0")
shape = lambda *dims: number(8, 4, size, width * height if dims != (1,) else 1, len(dims), 0, 0, 8, *dims, *[1] * (8 - len(dims)))
tags = [("SITE_UID", 7, 0), ("SITE_MAP_LATITUDE", 4, 0), ("SITE_MAP_LONGITUDE", 4, 0), ("FULL_ELEVATION", 4, 4), ("FULL_AZIMUTH", 4, 4)]
body = text("SKYMAP") + number(8, 36) + shape(1) + number(9) + text("") + number(0, len(tags), 0)
body += b"".join(number(0, kind, flags) for _, kind, flags in tags) + b"".join(text(name) for name, _, _ in tags)
body += shape(width, height) * 2 + number(7)
body += number(4) + text("made") + struct.pack(">ff", 65.0, 340.0) + elevation[:size] + azimuth[:size]
begin = b"SR\0\4"
first = number(2, len(begin) + 16 + len(body), 0, 0)
open("sky.sav", "wb").write(begin + first + body + number(6, 0, 0, 0))
EOF
for file in sky.fits "sky.sav --skymap-flip rows"; do
  expect_exit 0 calibrate --skymap $file -o camera.toml --lens equisolid --residuals residuals.csv --json all.json --overwrite
  expect_stdout "lens: equisolid"
  expect_stdout "all 19200 pixels: rms"
  ! grep -q '^mirrored = true' camera.toml || fail "mirrored by $file"
  grep -q "^# maps: ${file%% *}" camera.toml || fail "it is not told where the camera comes from"
  awk '/^focal_px/ { found = $3 > 51.999 && $3 < 52.001 } END { exit !found }' camera.toml || fail "another scale by $file"
  awk -F'[:,]' '/"largest_px"/ { found = $2 < 1e-3 } END { exit !found }' all.json || fail "some pixel is off by $file"
done
grep -q '^latitude_deg = 65' camera.toml || fail "no site in camera.toml"
grep -q '^longitude_deg = -20' camera.toml || fail "no site in camera.toml"
# Used as it is, too.
expect_exit 0 render "$SCENES/small.toml" $fisheye -o sky.png
expect_exit 0 profile sky.png -o maps.csv --skymap sky.sav --skymap-flip rows --azimuths 350,0,10 --elevation-step 5
grep -q "skymap sky.sav" maps.csv || fail "it is not told by what the directions are known"
# Rows that run the other way are a mirror image.
expect_exit 0 calibrate --skymap sky.sav -o mirrored.toml --lens equisolid
grep -q '^mirrored = true' mirrored.toml || fail "not mirrored"
# What is refused.
refused() {  # EXIT WORDS ARGUMENTS...
  local code=$1 words=$2
  shift 2
  expect_exit "$code" calibrate -o no.toml "$@"
  expect_stderr "$words"
  expect_one_message
  [[ ! -e no.toml ]] || fail "something was written"
}
refused 2 "azimuths | elevations" --skymap sky.sav --azimuth-map maps_az.fits
refused 2 "flipped" --skymap sky.sav --skymap-flip sky
refused 2 "no skymap" --skymap-flip rows --image sky.png
refused 3 "azimuth" --skymap asi.cdf
refused 3 "missing.sav" --skymap missing.sav
refused 3 "one plane" --skymap maps_az.fits
head -c 3000 sky.sav >cut.sav
refused 3 "truncated" --skymap cut.sav
expect_exit 2 calibrate --skymap sky.sav -o sky.sav --overwrite
expect_stderr "sky.sav"

# Films: times by a start, light by what is assumed of it.
film=$made/film.mp4
expect_exit 0 describe "$film"
expect_stdout "#4 | 0.160 s"
expect_stdout "BT.709 | assumed"
expect_stdout "creation_time | 2021-03-05T22:10:00"
expect_exit 0 keogram "$film" -o film.csv --start 2021-03-05T22:00:00Z
expect_stdout "2021-03-05T22:00:00Z | 2021-03-05T22:00:00.16Z"
expect_exit 0 keogram "$film" -o step.csv --start 2021-03-05T22:00:00Z --step 30
expect_stdout "2021-03-05T22:02:00Z"
expect_exit 2 keogram "$film" "$made/film.avi" -o no.csv --start 2021-03-05T22:00:00Z
expect_stderr "--start | --step"
expect_exit 0 profile "$film#2" -o film2.csv
expect_exit 2 profile "$film" -o no.csv
expect_stderr "film.mp4 | #0 to #4"
head -c 700 "$film" >cut.mp4
expect_exit 3 describe cut.mp4
expect_stderr cut.mp4
mkdir lapse && cp "$made"/film.avi lapse/b.avi && cp "$made"/film.avi lapse/a.avi
expect_exit 0 keogram lapse -o lapse.csv --step 2
expect_stdout "0 to 18"
