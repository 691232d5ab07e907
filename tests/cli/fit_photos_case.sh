# Two photographs that the scene names, of two stations: one run with the files of each, and a best scene that
# can be fitted again. What does not go together is refused.
source "$(dirname "$0")/case.sh"
mkdir pictures
cat "$SCENES/small.toml" - >both.toml <<'TOML'

[fit]
bands = 4
free = ["sheet.main.center_km.north", "sheet.main.energy_kev",
  { path = "camera.elevation_deg", photo = "far", prior = { mean = 40.0, sigma = 0.1 } }]
model_error = 0.01
scan_points = 0

[[fit.photo]]
file = "pictures/south.png"

[[fit.photo]]
name = "far"
file = "pictures/north.png"
set.site.latitude_deg = 65.6
set.camera.elevation_deg = 40.0
TOML
expect_exit 0 render "$SCENES/small.toml" -o pictures/south.png
# The other station's picture of the same sheet: 0.6 degrees of the meridian are 67.9 km at 110 km altitude.
expect_exit 0 render "$SCENES/small.toml" -o pictures/north.png --set site.latitude_deg=65.6 \
  --set camera.elevation_deg=40 --set sheet.main.center_km.north=152.2 --set sheet.main.center_km.east=19.6
expect_exit 0 fit both.toml --out runs/both --set sheet.main.center_km.north=228 --set sheet.main.energy_kev=3.6
expect_stdout "Believable"
expect_stdout "camera.elevation_deg of far"
found=$(find runs/both -mindepth 1 -printf '%f\n' | LC_ALL=C sort | xargs)
[[ $found == "best.toml map.svg model-far.exr model-south.exr profiles-far.csv profiles-south.csv report.html residual-far.exr residual-south.exr result.json trace.csv" ]] ||
  fail "the run holds: $found"
for text in '"photos": [' '"name": "south"' '"name": "far"' '"name": "north.png"' '"photo": "far"'; do
  grep -qF -- "$text" runs/both/result.json || fail "no '$text' in result.json"
done
# The best scene finds its photographs from where it stands.
grep -qF 'file = "../../pictures/south.png"' runs/both/best.toml || fail "best.toml names no photograph"
expect_exit 0 fit runs/both/best.toml --out runs/again
expect_exit 0 params runs/both/best.toml

expect_exit 2 fit both.toml --photo pictures/south.png --out run
expect_stderr "names its photographs"
expect_exit 2 fit "$SCENES/fit.toml" --out run
expect_stderr "no photograph"
mv pictures/north.png pictures/moved.png
expect_exit 3 fit both.toml --out run
expect_stderr "photograph 'far'"
expect_one_message
[[ ! -e run ]] || fail "a run was written"
