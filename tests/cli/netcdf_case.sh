# Runs, maps, sequences, profiles and keograms as netCDF: by the commands and afterwards the same bytes, opened by xarray
# with the units of the documentation where it is installed, and what is refused.
source "$(dirname "$0")/case.sh"
docs=$SOURCE/docs/file_formats.md
python=
for one in /usr/bin/python3 python3; do
  if "$one" -c 'import xarray, netCDF4' 2>/dev/null; then python=$one && break; fi
done
[[ -n $python ]] || echo "xarray is not installed: units are not compared with the documentation"
# units HEADING FILE COORDINATES...
units() {
  [[ -z $python ]] || "$python" "$(dirname "$0")/netcdf_units.py" "$docs" "$@" >"$stdout" 2>"$stderr" || fail "units of $2"
}
kHdf5=89484446

# A fit; with the file and without it all others are the same.
sed "s/^beams = .*/beams = 20/" "$SCENES/small.toml" >few.toml
expect_exit 0 render few.toml -o a.png
expect_exit 0 render few.toml -o b.png --set sheet.main.energy_kev=3.2
fit=(fit "$SCENES/fit.toml" --photo a.png --max-evaluations 3 --set sheet.main.beams=20)
"$VEGARD" "${fit[@]}" --out plain >/dev/null 2>&1 || true
"$VEGARD" "${fit[@]}" --out run --netcdf >/dev/null 2>&1 || true
expect_starts run/result.nc $kHdf5
expect_same plain/profiles.csv run/profiles.csv
[[ ! -e plain/result.nc ]] || fail "netCDF that nobody asked for"
units "A fit:" run/result.nc parameter other_parameter band row_px channel
expect_exit 0 to-netcdf plain -o of_plain.nc
expect_stdout "of_plain.nc: "
units "A fit:" of_plain.nc
expect_exit 0 to-netcdf run -o again.nc
expect_same again.nc run/result.nc
"$VEGARD" "${fit[@]}" --out run --overwrite >/dev/null 2>&1 || true
[[ ! -e run/result.nc ]] || fail "the old run's netCDF is still there"

# A sequence.
"$VEGARD" sequence "$SCENES/fit.toml" --photos a.png b.png -o seq --max-evaluations 3 --set sheet.main.beams=20 --netcdf >/dev/null 2>&1 || true
expect_starts seq/sequence.nc $kHdf5
expect_file seq/frames/a/result.nc
units "A sequence, by" seq/sequence.nc time
expect_exit 0 to-netcdf seq -o seq.nc
expect_same seq.nc seq/sequence.nc

# A map whose flux is not calibrated, and one whose flux is.
expect_exit 0 render "$SCENES/map_light.toml" -o band.png
map=(map "$SCENES/map.toml" --photo band.png --replicates 2 --sparsity 16)
expect_exit 5 "${map[@]}" --out relative --netcdf
expect_starts relative/precipitation.nc $kHdf5
expect_exit 5 "${map[@]}" --out absolute --netcdf --set sensor.calibration_error=0.1
units "A map, by" absolute/precipitation.nc north east latitude longitude magnetic_latitude altitude
expect_exit 0 to-netcdf absolute -o absolute.nc
expect_same absolute.nc absolute/precipitation.nc
if [[ -n $python ]]; then
  "$python" - <<'PY' >"$stdout" 2>"$stderr" || fail "the map holds other numbers"
import math
import xarray
data = xarray.open_dataset("absolute/precipitation.nc")
assert data.energy_flux.dims == ("north", "east")
assert "flux" in xarray.open_dataset("relative/precipitation.nc").energy_flux.long_name
assert xarray.open_dataset("relative/precipitation.nc").energy_flux.attrs["units"] == "1"
near = data.latitude.sel(north=0, east=0, method="nearest")
# The nearest cell may be some way to the north: the foot there is as far from the site on the sphere.
north_km, east_km = float(near.north), float(near.east)
away_deg = math.degrees(math.asin(math.hypot(north_km, east_km) / (6371.0 + float(data.altitude))))
assert abs(float(near) - float(data.site_latitude)) <= away_deg + 0.1, (near, away_deg)
relative = abs(data.energy_flux_sigma / data.energy_flux - data.energy_flux_error)
assert int(relative.notnull().sum()) > 0
assert float(relative.max()) < 1e-9, float(relative.max())
PY
fi

# Profiles and keograms.
expect_exit 0 profile a.png -o p.csv --scene few.toml
expect_exit 0 profile a.png -o p.nc --scene few.toml
expect_exit 0 to-netcdf p.csv -o of_p.nc
units "Profiles by" p.nc band row_px elevation_deg
units "Profiles by" of_p.nc
expect_exit 0 profile a.png -o directions.nc --scene few.toml --azimuths 350,0,10
units "Profiles by" directions.nc azimuth_deg elevation_deg
cp a.png sky_20140221_193000.png && cp b.png sky_20140221_193010.png
expect_exit 0 keogram sky_*.png -o k.csv -o k.nc
units "Profiles by" k.nc time row_px
expect_exit 0 to-netcdf k.csv -o of_k.nc
expect_same of_k.nc k.nc
expect_exit 0 to-netcdf run/profiles.csv -o profiles.nc

# What they say of themselves.
expect_exit 0 describe of_plain.nc
expect_stdout "CF-1.8"
expect_stdout "sheet_main_"
expect_stdout "keV"
expect_exit 0 describe absolute.nc
expect_stdout "energy_flux"

# What is refused, in one line each, leaves nothing.
refuses() {
  local code=$1 words=$2
  shift 2
  expect_exit "$code" "$@"
  expect_one_message
  expect_stderr "$words"
}
refuses 2 ".nc" to-netcdf run -o out.png
refuses 2 "--overwrite" to-netcdf run -o again.nc
refuses 3 "no such file" to-netcdf missing -o out.nc
mkdir empty
refuses 3 "no result.json" to-netcdf empty -o out.nc
echo '{' >empty/result.json
refuses 3 "no JSON" to-netcdf empty -o out.nc
cp -r absolute broken
head -c 3000 absolute/precipitation.fits >broken/precipitation.fits
refuses 3 "truncated" to-netcdf broken -o out.nc
printf 'a,b\n1,2\n' >other.csv
refuses 3 "none of those" to-netcdf other.csv -o out.nc
sed 's/^\([^#].*\)$/\1,1/' p.csv | sed '0,/^band/s/,1$//' >cells.csv
refuses 3 "cells.csv:" to-netcdf cells.csv -o out.nc
refuses 6 "nowhere" to-netcdf run -o nowhere/out.nc
[[ ! -e out.nc ]] || fail "what is refused leaves a file"
