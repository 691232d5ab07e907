# When a picture was taken: zones in names, clocks that contradict each other, the middle of an exposure; and tables that
# spreadsheets write.
source "$(dirname "$0")/case.sh"
source "$SOURCE/tests/cli/star_field.sh"
photo=$SOURCE/data/examples/h000/photo.jpg

# A zone in a name is applied; letters of a zone are refused, and so is no zone beside one.
for minute in 10 11; do
  cp "$photo" "2019-03-01T23-$minute-03+0100.jpg"
  cp "$photo" "20190301_171${minute:1}03_-0500.jpg"
  cp "$photo" "2019-03-01_10-$minute-03_PM.jpg"
  cp "$photo" "20190301_23${minute}03_CET.jpg"
done
for names in "*+0100.jpg" "*_-0500.jpg" "*_PM.jpg"; do
  # shellcheck disable=SC2086
  expect_exit 0 keogram $names -o k.csv --overwrite
  grep -q '2019-03-01T22:10:03Z' k.csv || fail "another time of $names"
done
expect_exit 2 keogram ./*_CET.jpg -o k.csv --overwrite
expect_stderr "CET | --times"
expect_one_message
expect_exit 2 keogram 2019-03-01T23-10-03+0100.jpg 2019-03-01_10-11-03_PM.jpg -o k.csv --overwrite
expect_stderr "--times"

# The stars are those of the middle of the exposure, by the header of a FITS file and by --exposure.
sky_to 0 >sky.pgm
python3 - <<'PYTHON'
import struct
words = open("sky.pgm").read().split()
width, height, values = int(words[1]), int(words[2]), list(map(int, words[4:]))
rows = [values[y * width:(y + 1) * width] for y in range(height)][::-1]
def card(key, value):
    return f"{key:8}= {value:>20}".ljust(80).encode()
def write(name, *more):
    head = card("SIMPLE", "T") + card("BITPIX", 32) + card("NAXIS", 2) + card("NAXIS1", width) + card("NAXIS2", height)
    head += b"".join(card(*one) for one in more) + b"END".ljust(80)
    data = b"".join(struct.pack(f">{width}i", *row) for row in rows)
    fill = lambda b, c: b + c * (-len(b) % 2880)
    open(name, "wb").write(fill(head, b" ") + fill(data, b"\0"))
write("begun.fits", ("DATE-OBS", "'2020-12-21T23:59:30'"), ("EXPTIME", "60.0"))
write("whole.fits", ("DATE-BEG", "'2020-12-21T23:59:30'"), ("DATE-END", "'2020-12-22T00:00:30'"))
PYTHON
angles() { awk '/^(azimuth|elevation|roll)_deg/ { printf "%.3f ", $3 }' "$1"; }
at_once=(--decoding linear --site 0,0)
expect_exit 0 calibrate --image sky.pgm "${at_once[@]}" --time 2020-12-22T00:00:00Z -o middle.toml
expect_stdout "--time | error of"
for file in begun.fits whole.fits; do
  expect_exit 0 calibrate --image "$file" "${at_once[@]}" -o "${file%.fits}.toml"
  expect_stdout "stars at 2020-12-22T00:00:00Z | 30 s"
  [[ $(angles "${file%.fits}.toml") == "$(angles middle.toml)" ]] || fail "another direction by $file"
  grep -q '^time_utc = "2020-12-22T00:00:00Z"' "${file%.fits}.toml" || fail "the time is not that of the stars"
done
expect_exit 0 calibrate --image sky.pgm "${at_once[@]}" --time 2020-12-21T23:59:30Z --exposure 60 -o asked.toml
[[ $(angles asked.toml) == "$(angles middle.toml)" ]] || fail "another direction by --exposure"
# A time to the minute turns the camera about the pole by 0.07 degrees, which its errors say.
expect_exit 0 calibrate --image sky.pgm "${at_once[@]}" --time 2020-12-22T00:00Z -o minute.toml
expect_stdout "error of 17 s | 0.072 deg"
awk '/^# the axis is known to/ { exit !($7 > 0.07 || $14 > 0.07) }' minute.toml || fail "the time's error is missing"

# A camera's file that was cut after any line is refused.
lines=$(wc -l <middle.toml)
for ((line = 3; line < lines; line += 4)); do
  head -n "$line" middle.toml >cut.toml
  expect_exit 2 directions cut.toml -o cut.fits
  expect_one_message
done
expect_stderr "cut"

# Small inputs that went wrong, with their right values.
cases=${VEGARD_CASES:-$SOURCE/../shared/cases}
[[ -d $cases ]] || { echo "no $cases: its inputs are not tried"; exit 0; }
describes() { # FILE TIME [NOTE]
  expect_exit 0 describe "$cases/$1"
  expect_stdout "site.time_utc = \"$2\""
  [[ -z ${3:-} ]] || expect_stdout "note: | $3"
}
describes gps_contradicts_clock/gps_1980rollover.jpg 2024-01-18T11:35:40Z "2024-01-18T12:35:41 | 2004-06-03T11:35:40Z | 1024 weeks"
describes gps_contradicts_clock/gps_midnight.jpg 2024-01-18T23:35:40Z "2024-01-19T23:35:40Z | day off"
# A receiver that has never seen a satellite tells neither date nor time.
expect_exit 0 describe "$cases/gps_contradicts_clock/gps_1970.jpg"
expect_stdout "note: | 1970-01-01T00:00:00Z | used: none"
! grep -q 'site.time_utc' "$stdout" || fail "a time out of nothing"
describes mef_time/mef.fits 2014-02-21T19:30:40Z
for table in t_semi t_tab t_caps; do
  expect_exit 0 calibrate "$cases/table_separator/$table.csv" --time 2014-02-21T19:30:40Z --site 67,20,400 --size 700,700 -o "$table.toml"
done
expect_exit 3 calibrate "$cases/table_separator/t_hours_as_deg.csv" --time 2014-02-21T19:30:40Z --site 67,20,400 --size 700,700 -o hours.toml
expect_stderr "ra_deg | hours | ra_hours"
expect_one_message

# From the space station, 395 km up over North America: the middle of its picture looks below the horizontal, to the
# Earth's edge 20 degrees down. The place is that of its solution's POS*SHIF, 13 s before the camera's clock.
photos=${VEGARD_PHOTOS:-$SOURCE/../shared/photos}
solution=$photos/iss030/ISS030-E-102170_dc.wcs
[[ -e $solution ]] || { echo "no $solution: it is not tried"; exit 0; }
orbit=(--time 2012-01-25T09:26:55.06Z)
expect_exit 0 calibrate --wcs "$solution" "${orbit[@]}" --site 44.3484,-92.0606,394568 -o iss.toml
awk '/^elevation_deg/ { exit !($3 < 0 && $3 > -20) }' iss.toml || fail "the camera looks elsewhere"
expect_exit 3 calibrate --wcs "$solution" "${orbit[@]}" --site 44.3484,-92.0606,0 -o ground.toml
