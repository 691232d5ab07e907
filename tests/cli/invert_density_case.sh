# vegard invert --density: a profile, a sequence, a Madrigal file, the same bytes for any number of threads, and how it refuses.
source "$2/tests/cli/case.sh"

# The density that vegard ionosphere has for 4 keV and 8 mW m-2 in a steady state, with errors of 5 % and 5e9 m-3, at six times.
expect_exit 0 ionosphere --energy-kev 4 --flux-mw-m2 8 --steady --uncertainty none -o profile.csv
awk -F, '
  BEGIN { print "altitude_km,density_m3,density_m3_error" }
  /^[0-9]/ && $1 >= 85 && $1 <= 150 && $1 % 5 == 0 { printf "%s,%s,%g\n", $1, $2, 0.05 * $2 + 5e9 }' profile.csv >density.csv
awk -F, 'BEGIN { print "time_s,altitude_km,density_m3,density_m3_error" }
  NR > 1 { for (t = 0; t < 3; ++t) print 60 * t "," $0 }' density.csv >sequence.csv

expect_exit 0 invert --density density.csv -o out.json -o out.csv -o out.nc --plot out.svg --threads 1
expect_only density.csv out.csv out.json out.nc out.svg profile.csv sequence.csv
expect_stdout "verdict: | explained"
expect_starts out.nc 89484446
grep -q '^energy_flux_mw_m2,energy_flux_mw_m2_68_low' out.csv || fail "columns of the table"
python3 - <<'EOF' || fail "not the electrons that were put in"
import json
profile = json.load(open("out.json"))["profiles"][0]
# 8 mW m-2 and 2 E0, but for what is below 1.4 keV, in the intervals of 95 %.
for name, truth in (("energy_flux_mw_m2", 7.9), ("mean_energy_kev", 8.4)):
    low, high = profile[name]["95"]
    assert low < truth < high < 2 * low, (name, profile[name])
assert any(bin["flux_cm2_s_kev"]["value"] is None for bin in profile["spectrum"]), "80 keV are known"
EOF
cp out.json first.json
cp out.nc first.nc
expect_exit 2 invert --density density.csv -o out.json
expect_one_message
expect_exit 0 invert --density density.csv -o out.json -o out.nc --threads 2 --overwrite
expect_same out.json first.json
expect_same out.nc first.nc

# In time, and each by itself; other recombination, air and altitudes; energies that are told.
expect_exit 0 invert --density sequence.csv -o night.csv --uncertainty none
expect_stdout "in time"
[[ $(grep -vc '^#' night.csv) -eq 4 ]] || fail "not a row for each profile"
expect_exit 0 invert --density sequence.csv --steady --recombination vickrey --atmosphere winter_quiet --altitudes-km 90 140 \
  --energies-kev 2 20 --uncertainty none
expect_stdout "3 profiles"
expect_stdout "explain | 3 of 3"
expect_stdout "Vickrey"
expect_exit 0 invert --density "$SOURCE/tests/data/imagers/madrigal.h5" --beam 1 --json --uncertainty none
grep -qF '"time_s": 1206515030' "$stdout" || fail "the times of Madrigal"

# Noise.
awk -F, -v OFS=, 'NR > 1 { $2 = NR % 2 ? 8e9 : -9e9; $3 = 1e10 } 1' density.csv >noise.csv
expect_exit 0 invert --density noise.csv -o noise.json
expect_stdout "energy flux below"
expect_stdout "no electrons | seen"

# No electrons make a density that halves from one altitude to the next and back.
awk -F, -v OFS=, 'NR > 1 { $2 = NR % 2 ? 1e11 : 2e11; $3 = 1e9 } 1' density.csv >saw.csv
expect_exit 5 invert --density saw.csv -o saw.json --uncertainty none
expect_stdout "no electrons | explain"
grep -qF '"value": null' saw.json || fail "numbers without an answer"

# refuses CODE FACTS ARGUMENTS...
refuses() {
  local code=$1 facts=$2
  shift 2
  expect_exit "$code" invert "$@"
  expect_one_message
  expect_stderr "$facts"
}
cut -d, -f1,2 density.csv >no_errors.csv
refuses 3 "no_errors.csv | errors | density_m3_error" --density no_errors.csv
sed '1s/density_m3/density/g' density.csv >no_unit.csv
refuses 3 "no_unit.csv | unit" --density no_unit.csv
sed '3s/,.*/,nan,1e9/' density.csv >nan.csv
refuses 3 "nan.csv:3" --density nan.csv
head -4 density.csv >short.csv
head -6 sequence.csv >sparse.csv
refuses 3 "short.csv | 3 altitudes" --density short.csv
refuses 3 "sparse.csv | fullest | 2 altitudes" --density sparse.csv
refuses 3 "missing.csv" --density missing.csv
refuses 3 "2 beams | --beam" --density "$SOURCE/tests/data/imagers/madrigal.h5"
refuses 3 "Table Layout" --density "$SOURCE/tests/data/imagers/rgb.h5"
refuses 2 "--beam" --density density.csv --beam 1
refuses 2 "--line" --density density.csv --line 427.8=2300±50
refuses 2 "--spread" --density density.csv --spread 0.3
refuses 2 "--kappa" --density density.csv --kappa 4
awk -F, -v OFS=, 'NR > 1 { $3 = 0.05 } 1' density.csv >relative.csv
refuses 3 "relative.csv:2 | unit" --density relative.csv
refuses 2 "--altitudes-km" --density density.csv --altitudes-km 120 100
refuses 2 "--energies-kev" --density density.csv --energies-kev 0.1 0.2
refuses 2 "--density" --line 427.8=2300±50 --line 630.0=330±15 --steady
refuses 2 "--output" --density density.csv -o out.fits
refuses 2 "an input" --density density.csv -o density.csv --overwrite
refuses 2 "--plot" --density sequence.csv --plot new.svg
