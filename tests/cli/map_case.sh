# A map of precipitation: its files, the same bytes for any number of threads and after an interruption, and its refusals.
source "$(dirname "$0")/case.sh"
expect_exit 0 render "$SCENES/map_light.toml" -o photo.png
# The sensor is not calibrated: the flux is relative, and the exit code says that something is to be taken with care.
expect_exit 5 map "$SCENES/map.toml" --photo photo.png --out run --replicates 2 --sparsity 16 --threads 2
for file in map.json precipitation.fits curtains.csv model.exr residual.exr report.html; do expect_file "run/$file"; done
expect_stdout "explained: good"
expect_stdout "relative: "
expect_starts run/precipitation.fits 53494d504c4520203d
grep -q "^curtain,point,east_km,north_km,distance_km," run/curtains.csv || fail "another head of the table"
grep -qF "FLUXCAL = 'relative'" run/precipitation.fits || fail "a scale that nobody knows"
# With it the flux is good; the height of the border is not to be had from one station.
expect_exit 5 map "$SCENES/map.toml" --photo photo.png --out calibrated --replicates 2 --sparsity 16 --threads 1 \
  --set sensor.calibration_error=0.1
expect_stdout "lower border: doubtful"
for file in curtains.csv model.exr residual.exr; do expect_same "run/$file" "calibrated/$file"; done

# An existing map stays; with --overwrite it is replaced, but nothing that is not ours.
expect_exit 2 map "$SCENES/map.toml" --photo photo.png --out run
expect_one_message
cp run/precipitation.fits before.fits
echo thesis >run/thesis.tex
expect_exit 2 map "$SCENES/map.toml" --photo photo.png --out run --overwrite --replicates 2 --sparsity 16
expect_stderr thesis.tex
expect_file run/thesis.tex
expect_same run/precipitation.fits before.fits
rm run/thesis.tex

# Cut off by Ctrl-C and gone on with: the same bytes.
set -m
"$VEGARD" map "$SCENES/map.toml" --photo photo.png --out cut --replicates 2 --sparsity 16 --threads 1 >"$stdout" 2>"$stderr" &
interrupt $!
[[ $status -eq 130 || $status -eq 5 ]] || fail "exit $status instead of 130"
if [[ $status -eq 130 ]]; then
  # Before there was a map nothing is written but the journal.
  [[ ! -e cut/map.json ]] || grep -q '"interrupted": true' cut/map.json || fail "another end"
  expect_exit 5 map "$SCENES/map.toml" --photo photo.png --out cut --replicates 2 --sparsity 16 --resume
fi
for file in precipitation.fits curtains.csv model.exr; do expect_same "run/$file" "cut/$file"; done

# Of another spectrum, which is written down.
expect_exit 5 map "$SCENES/map.toml" --photo photo.png --out narrow --replicates 0 --sparsity 16 --spectrum gaussian \
  --spread 0.1 --netcdf --geojson --kml --magnetic-grid
grep -q '"spectrum": "gaussian"' narrow/map.json || fail "no spectrum"
grep -q '"spread": 0.1' narrow/map.json || fail "no spread"
grep -qF "SPECTRUM= 'gaussian" narrow/precipitation.fits || fail "no spectrum in the header"
! grep -qF "SPECTRUM=" run/precipitation.fits || fail "a spectrum in the header of a usual map"

# The curtains for other maps: a line for each that the table has.
python3 - <<'END'
import csv, json, xml.dom.minidom
rows = list(csv.DictReader(open("narrow/curtains.csv")))
features = json.load(open("narrow/curtains.geojson"))["features"]
assert len(features) == len({row["curtain"] for row in rows}), len(features)
assert sum(len(f["properties"]["energy_kev"]) for f in features) == len(rows)
assert all(point[2] == 110000.0 for f in features for point in f["geometry"]["coordinates"])
assert len(xml.dom.minidom.parse("narrow/curtains.kml").getElementsByTagName("LineString")) == len(features)
END
grep -q "dipole latitude" narrow/report.html || fail "no magnetic grid"
! grep -q "dipole latitude" run/report.html || fail "a magnetic grid unasked"
[[ ! -e run/curtains.kml ]] || fail "a file unasked"

# Refusals, each in one line.
expect_exit 2 map "$SCENES/map.toml" --sequence photo.png --out none --kml
expect_one_message
expect_stderr "--kml"
expect_exit 2 map "$SCENES/map.toml" --out none
expect_one_message
expect_stderr "no photograph"
expect_exit 2 map "$SCENES/map.toml" --photo photo.png
expect_stderr "--out"
expect_exit 0 render "$SCENES/map.toml" -o dark.png
expect_exit 3 map "$SCENES/map.toml" --photo dark.png --out none
expect_stderr "noise"
expect_exit 2 map "$SCENES/map.toml" --photo photo.png --out none --set camera.elevation_deg=-70
expect_stderr "the sky"
expect_exit 2 map "$SCENES/map.toml" --photo photo.png --out none --set camera.width=97 --no-metadata
expect_stderr "97 x 64"
expect_exit 2 map "$SCENES/map.toml" --photo photo.png --out none --kappa 4
expect_one_message
expect_stderr "--kappa"
expect_exit 2 map "$SCENES/map.toml" --photo photo.png --out none --spectrum kappa --spread 0.2
expect_stderr "--spread"
[[ ! -e none && ! -e none.part ]] || fail "something was left of a map that was refused"
