# Maps of precipitation as GEMINI's and Lompe's inputs.
source "$(dirname "$0")/case.sh"
expect_exit 0 render "$SCENES/map_light.toml" -o band.png
map=(map "$SCENES/map.toml" --photo band.png --replicates 2 --sparsity 16)
expect_exit 5 "${map[@]}" --out relative
expect_exit 5 "${map[@]}" --out absolute --set sensor.calibration_error=0.1
time=(--time 2014-03-10T06:05:33Z)

expect_exit 0 to-gemini absolute --out prec "${time[@]}" --step-deg 0.1
expect_stdout "prec/20140310_21933.000000.h5"
(cd prec && [[ $(find . -type f | sort | tr '\n' ' ') == "./20140310_21933.000000.h5 ./simgrid.h5 ./simsize.h5 ./vegard.json " ]]) ||
  fail "other files"
for file in simsize simgrid 20140310_21933.000000; do expect_starts prec/$file.h5 89484446; done
expect_exit 0 to-lompe absolute -o lompe.nc "${time[@]}" --step-deg 0.1
expect_starts lompe.nc 89484446
expect_exit 0 to-lompe absolute -o again.nc "${time[@]}" --step-deg 0.1
expect_same lompe.nc again.nc
python=
for one in /usr/bin/python3 python3; do
  if "$one" -c 'import xarray, netCDF4, h5py' 2>/dev/null; then python=$one && break; fi
done
if [[ -n $python ]]; then
  "$python" "$(dirname "$0")/netcdf_units.py" "$SOURCE/docs/file_formats.md" "**[Lompe]" lompe.nc time lat lon >"$stdout" 2>"$stderr" ||
    fail "units of lompe.nc"
  "$python" - <<'PY' >"$stdout" 2>"$stderr" || fail "GEMINI would read something else"
import h5py
import numpy as np
import xarray
size, grid = h5py.File("prec/simsize.h5"), h5py.File("prec/simgrid.h5")
frame = h5py.File("prec/20140310_21933.000000.h5")
# As pygemini writes it: scalars, vectors, and arrays (llat, llon) in C's order.
assert size["llon"][()] == grid["mlon"].size and size["llat"][()] == grid["mlat"].size
assert frame["Qp"].shape == frame["E0p"].shape == (grid["mlat"].size, grid["mlon"].size)
assert np.all(np.isfinite(frame["Qp"][:])) and np.all(frame["Qp"][:] >= 0)
assert np.all(frame["E0p"][:] > 100)
assert np.all(np.diff(grid["mlat"][:]) > 0) and np.all(np.diff(grid["mlon"][:]) > 0)
# Both grids have the same light: the sums of flux times area agree (on other cells of a tenth of a degree).
lompe = xarray.open_dataset("lompe.nc").isel(time=0)
area = np.cos(np.radians(lompe.lat)) * float(lompe.lat.diff("lat")[0]) * float(lompe.lon.diff("lon")[0])
geographic = float((lompe.energy_flux.fillna(0) * area).sum())
mlat, mlon = grid["mlat"][:], grid["mlon"][:]
magnetic = float((frame["Qp"][:] * np.cos(np.radians(mlat))[:, None]).sum() * (mlat[1] - mlat[0]) * (mlon[1] - mlon[0]))
assert abs(magnetic / geographic - 1) < 0.03, (magnetic, geographic)
lit = lompe.where(lompe.energy_flux > 1e-3)
mean, q = lit.mean_energy, lit.energy_flux
assert float(abs(lit.SP / (40 * mean / (16 + mean**2) * q**0.5) - 1).max()) < 1e-9
assert float(abs(lit.SH / lit.SP / (0.45 * mean**0.85) - 1).max()) < 1e-9
PY
else
  echo "xarray or h5py is not installed: layouts and units are not looked at"
fi

refuses() {
  local code=$1 words=$2
  shift 2
  expect_exit "$code" "$@"
  expect_one_message
  expect_stderr "$words"
}
refuses 3 "--flux-factor" to-lompe relative -o out.nc "${time[@]}"
expect_exit 0 to-lompe relative -o scaled.nc "${time[@]}" --flux-factor 2 --step-deg 0.2
refuses 2 "--flux-factor" to-lompe relative -o out.nc "${time[@]}" --flux-factor -2
refuses 2 "no time" to-lompe absolute -o out.nc --time soon
refuses 3 "no time" to-lompe absolute -o out.nc
refuses 2 ".nc" to-lompe absolute -o out.h5 "${time[@]}"
refuses 2 "--step-deg" to-lompe absolute -o out.nc "${time[@]}" --step-deg 0.0001
refuses 2 "--step-deg" to-lompe absolute -o out.nc "${time[@]}" --step-deg 9
refuses 2 "--time" to-lompe absolute relative -o out.nc "${time[@]}"
refuses 3 "no such file" to-gemini missing --out out "${time[@]}"
refuses 2 "prec" to-gemini absolute --out prec "${time[@]}"
expect_exit 0 to-gemini absolute --out prec "${time[@]}" --overwrite --step-deg 0.2
echo mine >prec/notes.txt
refuses 2 "notes.txt" to-gemini absolute --out prec "${time[@]}" --overwrite
expect_file prec/notes.txt
[[ ! -e out.nc && ! -e out ]] || fail "what is refused leaves something"
