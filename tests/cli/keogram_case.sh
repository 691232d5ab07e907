# Five frames of a sheet that comes nearer, one column of each side by side; where their times come from, and what
# is refused.
source "$(dirname "$0")/case.sh"
i=0
for time in 193000 193010 193020 193050 193100; do
  expect_exit 0 render "$SCENES/small.toml" -o "sky_20140221_$time.png" --set "sheet.main.center_km.north=$((210 - 10 * i))"
  i=$((i + 1))
done
expect_exit 0 keogram sky_*.png -o k.png -o k.svg -o k.exr -o k.csv
expect_stdout "UTC | 2014-02-21T19:30:00Z | 2014-02-21T19:31:00Z"
expect_stdout "3 columns from 78"
expect_starts k.png 89504e470d0a1a0a
expect_starts k.exr 762f3101
grep -q '^<svg' k.svg || fail "no SVG"
rows() { grep -c '^[0-9]' "$1"; }
[[ $(rows k.csv) -eq $((5 * 120)) ]] || fail "not a row for every picture and place"
# The order of the names does not count, that of the times does; and it is the same file again.
expect_exit 0 keogram sky_20140221_193100.png sky_20140221_193050.png sky_20140221_193020.png \
  sky_20140221_193010.png sky_20140221_193000.png -o again.csv
expect_same k.csv again.csv
# As part of the profile's command.
expect_exit 0 profile sky_*.png --keogram k2.png --keogram k2.csv
expect_same k.png k2.png
expect_same k.csv k2.csv

# With the camera the line is a meridian: the sheet that comes nearer climbs.
expect_exit 0 keogram sky_*.png -o meridian.csv --scene "$SCENES/small.toml"
expect_stdout "over the zenith"
grep -q '^# directions: the scene.s camera$' meridian.csv || fail "whose directions is not said"
brightest() { grep "^$1," meridian.csv | sort -t, -k4 -g | tail -1 | cut -d, -f2; }
first=$(brightest 2014-02-21T19:30:00Z) last=$(brightest 2014-02-21T19:31:00Z)
awk -v a="$first" -v b="$last" 'BEGIN { exit !(b > a + 3) }' || fail "brightest at $first, then at $last degrees"
# By a map of the same camera it is the same light at the same places.
expect_exit 0 directions "$SCENES/small.toml" -o maps.exr
expect_exit 0 keogram sky_*.png -o by_map.csv --azimuth-map maps.exr
expect_stdout "directions: maps maps.exr"
cmp -s <(grep -v '^#' meridian.csv) <(grep -v '^#' by_map.csv) || fail "camera and map disagree"
expect_exit 2 keogram sky_*.png -o no.csv --azimuth-map maps.exr --azimuth 90
expect_stderr "--azimuth"
expect_one_message

# Times from a table, from a list, and none.
printf 'file,time\nsky_20140221_193000.png,2014-02-21T20:00:00.5Z\nsky_20140221_193010.png,2014-02-21T19:59:00Z\n' >times.csv
expect_exit 0 keogram sky_20140221_1930[01]0.png -o table.csv --times times.csv
expect_stdout "times: table times.csv; 2014-02-21T19:59:00Z to 2014-02-21T20:00:00.5Z"
expect_exit 3 keogram sky_*.png -o no.csv --times times.csv
expect_stderr "times.csv: | sky_20140221_193020.png"
printf 'sky_20140221_193000.png,soon\n' >bad.csv
expect_exit 3 keogram sky_*.png -o no.csv --times bad.csv
expect_stderr "bad.csv:1"
printf '# seconds\nsky_20140221_193000.png 0\nsky_20140221_193010.png 2.5\n' >list.txt
expect_exit 0 keogram list.txt -o list.csv
expect_stdout "list.txt | 0 to 2.5"
cp sky_20140221_193000.png a.png
cp sky_20140221_193010.png b.png
expect_exit 0 keogram a.png b.png -o number.csv
expect_stdout "times: not known | 0 to 1"
expect_exit 2 keogram a.png sky_*.png -o no.csv
expect_stderr "a.png | time"

# What is refused, with the name of the picture that it is about.
expect_exit 2 keogram a.png -o no.csv
expect_stderr "two pictures"
expect_exit 2 keogram a.png b.png -o no.gif
expect_stderr "--output"
expect_exit 2 keogram a.png b.png -o a.png --overwrite
expect_stderr "an input"
expect_exit 2 keogram a.png b.png -o k.csv
expect_stderr "--overwrite"
expect_exit 2 keogram a.png b.png -o no.csv -o ./no.csv
expect_exit 2 keogram a.png b.png -o no.csv --azimuth 0
expect_stderr "--azimuth"
expect_exit 2 keogram a.png b.png -o no.csv --width 200
expect_stderr "--width"
expect_exit 2 keogram a.png b.png -o no.csv --roi 100,0,100,100
expect_stderr "--roi"
echo "no film" >night.mp4
expect_exit 3 keogram a.png night.mp4 -o no.png
expect_stderr night.mp4
expect_one_message
expect_exit 2 profile a.png b.png -o no.csv
expect_stderr "--keogram"
expect_exit 2 profile a.png
expect_stderr "--output"
expect_exit 2 profile a.png b.png --keogram no.png -o no.csv
expect_stderr "--keogram"
expect_exit 0 render "$SCENES/small.toml" -o c.png --set camera.width=80
expect_exit 3 keogram a.png b.png c.png -o no.csv -o no.png
expect_stderr "c.png"
expect_stderr "80 x 120"
expect_one_message
head -c 3000 b.png >cut.png
expect_exit 3 keogram a.png cut.png b.png -o no.csv
expect_stderr cut.png
expect_one_message
expect_exit 6 keogram a.png b.png -o nowhere/no.csv
# A full disk, in netCDF as well.
for full in no.nc no.csv; do
  status=0
  (ulimit -f 4 && exec "$VEGARD" keogram a.png b.png -o "$full" >"$stdout" 2>"$stderr") || status=$?
  [[ $status -eq 6 ]] || fail "exit $status instead of 6 on a full disk: $full"
  expect_one_message
  expect_stderr "$full"
done
[[ -z $(find . -name '*no.*') ]] || fail "something was written"
