# vegard ionosphere: of numbers, an inversion, a table and a map, the same bytes for any number of threads, and how it refuses.
source "$2/tests/cli/case.sh"

exact=(--uncertainty none) # in a third of the time
electrons=(--energy-kev 3 --energy-error 15 --flux-mw-m2 8 --flux-error 10)
expect_exit 0 ionosphere "${electrons[@]}" -o point.nc --plot point.svg --threads 1
expect_only point.nc point.svg
expect_stdout "IGRF-14, 65 N 212 E"
expect_stdout "Pedersen conductance"
expect_starts point.nc 89484446
cp point.nc one.nc
expect_exit 2 ionosphere "${electrons[@]}" -o point.nc
expect_one_message
expect_exit 0 ionosphere "${electrons[@]}" -o point.nc --overwrite --threads 3
expect_same point.nc one.nc
expect_exit 0 ionosphere "${electrons[@]}" -o point.csv "${exact[@]}"
grep -q '^altitude_km,electron_density,electron_density_sigma,o_plus_density,' point.csv || fail "the table's head"
grep -q '^110,' point.csv || fail "110 km"

# number KEY OPTIONS...: one number of the answer.
number() {
  local key=$1
  shift
  "$VEGARD" ionosphere "$@" --json | tr -d ' \n' | grep -o "\"$key\":{\"value\":[^,}]*" | sed 's/.*://'
}
larger() { [[ -n $1 && -n $2 ]] && awk -v a="$1" -v b="$2" 'BEGIN { exit !(a > b) }' || fail "$1 is not larger than $2"; }
# Harder electrons stop lower and leave Hall currents; more of them leave more; airs and spectra differ.
soft=(--energy-kev 1 --flux-mw-m2 8 --uncertainty none)
hard=(--energy-kev 8 --flux-mw-m2 8 --uncertainty none)
larger "$(number peak_altitude_km "${soft[@]}")" "$(number peak_altitude_km "${hard[@]}")"
larger "$(number hall_conductance_s "${hard[@]}")" "$(number hall_conductance_s "${soft[@]}")"
larger "$(number peak_density_cm3 "${soft[@]}" --steady)" "$(number peak_density_cm3 "${soft[@]}" --seconds 20)"
larger "$(number peak_altitude_km "${hard[@]}" --spectrum mono)" "$(number peak_altitude_km "${hard[@]}")" # half the mean energy
[[ $(number hall_conductance_s "${hard[@]}") != $(number hall_conductance_s "${hard[@]}" --atmosphere winter_quiet) ]] ||
  fail "the air does not matter"
# A weaker field holds ions less.
larger "$(number pedersen_conductance_s "${hard[@]}" --latitude-deg -20 --longitude-deg -50)" "$(number pedersen_conductance_s "${hard[@]}")"

# An inversion, and a table of them.
expect_exit 0 invert --line 427.8=2300±50 --line 557.7=11000±300 --line 630=500±20 -o electrons.json
expect_exit 0 ionosphere electrons.json "${exact[@]}"
expect_stdout "the inversion electrons.json"
printf 'UT_h,427.8,557.7,630.0\n8.1,650,2722,115\n8.2,851,3683,135\n' >lines.csv
expect_exit 0 invert --table lines.csv --relative-error 5 -o night.csv
expect_exit 0 ionosphere night.csv -o night.nc "${exact[@]}"
expect_stdout "median"

# A map: its cells.
few=(--set camera.width=48 --set camera.height=32)
expect_exit 0 render "$SCENES/map_light.toml" -o photo.png "${few[@]}"
expect_exit 5 map "$SCENES/map.toml" --photo photo.png --out map --replicates 2 --sparsity 16 "${few[@]}"
expect_exit 3 ionosphere map -o map.nc
expect_one_message
expect_stderr "--flux-factor"
expect_exit 0 ionosphere map --flux-factor 1 -o map.nc --threads 1 "${exact[@]}"
expect_exit 0 ionosphere map/map.json --flux-factor 1 -o again.nc --threads 3 "${exact[@]}"
expect_same map.nc again.nc
python=
for one in /usr/bin/python3 python3; do
  if "$one" -c 'import xarray, netCDF4' 2>/dev/null; then python=$one && break; fi
done
if [[ -n $python ]]; then
  "$python" - <<'PY' >"$stdout" 2>"$stderr" || fail "other numbers: $(cat "$stderr")"
import numpy as np
import xarray
point, night, cells = (xarray.open_dataset(f, decode_times=False) for f in ("point.nc", "night.nc", "map.nc"))
for data in (point, night, cells):
    for name, variable in data.variables.items():
        assert name in ("UT_h",) or variable.attrs.get("units") or variable.dtype == object, name
assert point["electron_density"].dims == ("level",) and point["pedersen_conductance"].dims == ()
assert night["electron_density"].dims == ("level", "row") and list(night["UT_h"].values) == [8.1, 8.2]
assert cells["hall_conductance"].dims == ("north", "east") and "electron_density" not in cells
known = np.isfinite(cells["energy_flux"].values)
assert known.any()
conducts = np.isfinite(cells["hall_conductance"].values)
assert not (conducts & ~known).any() and conducts[known & np.isfinite(cells["energy"].values)].all()
# The integral of the profile is the conductance.
height = point["altitude"].values * 1e3
integral = np.sum(0.5 * np.diff(height) * (point["hall_conductivity"].values[1:] + point["hall_conductivity"].values[:-1]))
assert abs(integral / point["hall_conductance"].values - 1) < 2e-3, integral
PY
fi

# refuses CODE TEXT ARGUMENTS...
refuses() {
  local code=$1 text=$2
  shift 2
  expect_exit "$code" ionosphere "$@"
  expect_one_message
  expect_stderr "$text"
}
refuses 2 "--energy-kev"
refuses 2 "--flux-mw-m2" --energy-kev 3
refuses 2 "--energy-kev" electrons.json --energy-kev 3
refuses 2 "--flux-error" electrons.json --flux-error 3
refuses 2 "--spectrum" electrons.json --spectrum mono
refuses 2 "--name" electrons.json --name main
refuses 2 "--flux-factor" electrons.json --flux-factor 2
refuses 2 "--plot" night.csv --plot out.svg
refuses 2 "one ionosphere" night.csv -o out.csv
refuses 2 "--output" "${electrons[@]}" -o out.txt
refuses 2 "--time" "${electrons[@]}" --time 1066-10-14T09:00:00Z
refuses 3 "keV" --energy-kev 60 --flux-mw-m2 1
refuses 3 "tables" "${electrons[@]}" --tables nowhere
refuses 3 "energy_kev" lines.csv
refuses 3 "nowhere" nowhere
printf 'energy_kev,energy_flux_mw_m2\n3,-1\n' >negative.csv
refuses 3 "negative.csv:2" negative.csv
