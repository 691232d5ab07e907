# vegard track: a satellite's table and its two-line elements over a map, and how it refuses.
source "$2/tests/cli/case.sh"

few=(--set camera.width=48 --set camera.height=32)
expect_exit 0 render "$SCENES/map_light.toml" -o photo.png "${few[@]}"
expect_exit 5 map "$SCENES/map.toml" --photo photo.png --out map --replicates 2 --sparsity 16 --set sensor.calibration_error=0.1 "${few[@]}"
expect_exit 5 map "$SCENES/map.toml" --photo photo.png --out relative --replicates 0 --sparsity 16 "${few[@]}"

# A satellite goes northwards past the map's site at 67 N 0 E, in half a minute.
awk 'BEGIN {
  print "Timestamp,Latitude,Longitude,alt_km"
  for (i = 0; i < 40; i++) printf "2014-03-10T06:05:%02dZ,%.3f,-0.5,460\n", i + 15, 66.2 + 0.063 * i
}' >track.csv
time=(--time 2014-03-10T06:05:33Z)
expect_exit 0 track map --along track.csv "${time[@]}" -o met.csv --plot met.svg
expect_stdout "of 40 points"
expect_stdout "IGRF-14, down to 110 km"
grep -q '^time_utc,latitude_deg,longitude_deg,altitude_km,foot_latitude_deg,' met.csv || fail "the table's head"
[[ $(grep -c '^2014-03-10T06:05' met.csv) -eq 40 ]] || fail "not a row a point"
head -c 4 met.svg | grep -q '<svg' || fail "the plot is no SVG"
expect_exit 2 track map --along track.csv "${time[@]}" -o met.csv
expect_one_message
expect_exit 0 track map --along track.csv "${time[@]}" -o met.nc
expect_starts met.nc 89484446
# Its own output is a track too: the same places have the same feet and electrons.
expect_exit 0 track map --along met.csv "${time[@]}" -o again.csv
cut -d, -f2- met.csv | grep -v '^#' >first && cut -d, -f2- again.csv | grep -v '^#' >second
[[ $(sed -n 2p first | cut -d, -f1-5) == "$(sed -n 2p second | cut -d, -f1-5)" ]] || fail "other places"
expect_exit 0 track relative --along track.csv "${time[@]}" --flux-factor 2
expect_exit 0 track map --along track.csv "${time[@]}" --time-tolerance 3

# Elements near the Earth, of 2006.
cat >one.tle <<'TLE'
DELTA 1 DEB
1 06251U 62025E   06176.82412014  .00008885  00000-0  12808-3 0  3985
2 06251  58.0579  54.0425 0030035 139.1568 221.1854 15.56387291  6774
TLE
day=(--times 2006-06-25T20:00:00Z/60/2006-06-25T22:00:00Z)

# refuses CODE TEXT ARGUMENTS...
refuses() {
  local code=$1 text=$2
  shift 2
  expect_exit "$code" track "$@"
  expect_one_message
  expect_stderr "$text"
}
refuses 3 "one.tle" map --tle one.tle "${day[@]}" --time 2006-06-25T21:00:00Z
refuses 3 "days older" map --tle one.tle --times 2014-03-10T06:05:00Z/1/2014-03-10T06:06:00Z "${time[@]}"
refuses 3 "the map's time" map --along track.csv --time 2014-03-10T09:00:00Z
sed 's/-0.5,460/40,460/' track.csv >far.csv
refuses 3 "far.csv" map --along far.csv "${time[@]}"
refuses 3 "no time" map --along track.csv
refuses 3 "--flux-factor" relative --along track.csv "${time[@]}"
refuses 3 "nowhere" nowhere --along track.csv "${time[@]}"
refuses 3 "lines.csv" map --along lines.csv "${time[@]}"
refuses 2 "--along" map "${time[@]}"
refuses 2 "--along" map --along track.csv --tle one.tle "${time[@]}"
refuses 2 "--times" map --tle one.tle "${time[@]}"
refuses 2 "--times" map --tle one.tle --times now "${time[@]}"
refuses 2 "--times" map --along track.csv "${day[@]}" "${time[@]}"
refuses 2 "--satellite" map --tle one.tle "${day[@]}" "${time[@]}" --satellite 25544
refuses 2 "--output" map --along track.csv "${time[@]}" -o met.txt
refuses 2 "an input" map --along track.csv "${time[@]}" -o track.csv --overwrite
refuses 2 "--time" map relative --along track.csv "${time[@]}"
