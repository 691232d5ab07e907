# vegard electrons: rates, budget and plot, and how it refuses.
source "$2/tests/cli/case.sh"

expect_exit 0 electrons --energy-kev 5 --spectrum mono -o rates.csv --plot rates.svg
expect_only rates.csv rates.svg
expect_stdout "excites molecules and atoms"
expect_stdout "Fang et al. 2010"
grep -q '^altitude_km,ion_pairs_cm3_s,ion_pairs_N2_cm3_s,' rates.csv || fail "the table's head"
head -c 4 rates.svg | grep -q '<svg' || fail "the plot is no SVG"
cp rates.csv first.csv

# What is there stays, unless it is to be replaced; and the same comes out.
expect_exit 2 electrons --energy-kev 5 --spectrum mono -o rates.csv
expect_one_message
expect_exit 0 electrons --energy-kev 5 --spectrum mono -o rates.csv --overwrite
expect_same rates.csv first.csv

# Every spectrum.
expect_exit 0 electrons --spectrum gaussian --energy-kev 1 --spread 0.2
expect_exit 0 electrons --energy-kev 0.5 --pitch field-aligned --dip-deg 77 --flux-mw-m2 3
! grep -q Fang "$stdout" || fail "Fang's formula is for isotropic electrons"
expect_exit 0 electrons --spectrum kappa --energy-kev 0.3 --kappa 4
expect_exit 0 electrons --spectrum accelerated --energy-kev 0.2 --potential-kev 1
printf 'energy_keV,flux\n0.5,1\n1,2\n2,0\n' >spectrum.csv
expect_exit 0 electrons --spectrum table --spectrum-table spectrum.csv
printf 'altitude_km,T_K,nN2,nO2,nO\n90,190,4e13,1e13,2e11\n400,1000,4e6,1e5,1e8\n' >air.csv
expect_exit 0 electrons --energy-kev 0.5 --atmosphere air.csv
expect_stdout "atmosphere: air.csv, 90 to 400 km"

# Air that is built in, by its name.
expect_exit 0 electrons --energy-kev 5 --spectrum mono --atmosphere us76 -o rates.csv --overwrite
expect_same rates.csv first.csv
expect_exit 0 electrons --energy-kev 0.5 --atmosphere winter_active
expect_stdout "atmosphere: winter_active (NRLMSISE-00, 2014-12-21T09:52:00Z, 65 N 148 W"

# refuses CODE TEXT ARGUMENTS...
refuses() {
  local code=$1 text=$2
  shift 2
  expect_exit "$code" electrons "$@"
  expect_one_message
  expect_stderr "$text"
}
refuses 2 "--energy-kev"
refuses 2 "--energy-kev" --energy-kev 500
refuses 2 "--energy-kev" --energy-kev nan
refuses 2 "--spectrum" --energy-kev 5 --spectrum square
refuses 2 "--kappa" --energy-kev 5 --kappa 4
refuses 2 "--potential-kev" --energy-kev 5 --spectrum accelerated
refuses 2 "--spectrum-table" --spectrum table
refuses 2 "--spectrum-table" --energy-kev 5 --spectrum-table spectrum.csv
refuses 2 "--dip-deg" --energy-kev 5 --dip-deg 0
refuses 2 "--plot" --energy-kev 5 --plot rates.gif
refuses 2 "an input" --energy-kev 5 --atmosphere air.csv -o air.csv --overwrite
refuses 3 "missing.csv" --energy-kev 5 --atmosphere missing.csv
refuses 3 "summer_quiet" --energy-kev 5 --atmosphere autumn
printf 'energy_keV,flux\n1,2\n0.5,1\n' >wrong.csv
refuses 3 "wrong.csv:3" --spectrum table --spectrum-table wrong.csv
printf 'energy_keV,flux\n0.5,0\n1,0\n' >wrong.csv
refuses 3 "no electrons" --spectrum table --spectrum-table wrong.csv
printf 'altitude_km,T_K,nN2,nO2,nO\n90,190,4e13,1e13,2e11\n200,1000,4e6,1e5,1e8\n' >wrong.csv
refuses 3 "300 km" --energy-kev 5 --atmosphere wrong.csv
printf 'altitude_km,T_K,nN2,nO2,nO\n90,190,4e13,1e13,2e11\n400,1000,4e13,1e13,2e11\n' >wrong.csv
refuses 3 "does not balance" --energy-kev 0.5 --atmosphere wrong.csv -o thick.csv
[[ ! -e thick.csv ]] || fail "a refused air leaves a table"
refuses 6 "missing" --energy-kev 5 -o missing/rates.csv
