# vegard lines --sources: brightness and sources, as words, table and plot.
source "$2/tests/cli/case.sh"

expect_exit 0 lines --sources --energy-kev 0.3 -o sources.csv --plot sources.svg
expect_only sources.csv sources.svg
expect_stdout "557.7 nm"
expect_stdout "O2+ + e"
grep -q '^altitude_km,electrons_cm3,.*,lifetime_s_6300,' sources.csv || fail "the table's head"
cp "$stdout" first.txt
expect_exit 2 lines --sources --energy-kev 0.3 -o sources.csv
expect_one_message
expect_exit 0 lines --sources --energy-kev 0.3 -o sources.csv --overwrite
cmp -s "$stdout" first.txt || fail "the same electrons make other light"

# The air by its name: winter has the more oxygen.
expect_exit 0 lines --sources --energy-kev 0.3 --atmosphere us76
cmp -s "$stdout" first.txt || fail "the standard air has a name"
expect_exit 0 lines --sources --energy-kev 0.3 --atmosphere winter_quiet
expect_stdout "winter_quiet"

# Red comes late; a user's reaction replaces one.
expect_exit 0 lines --sources --energy-kev 0.3 --seconds 1
! cmp -s "$stdout" first.txt || fail "red is there at once"
printf 'number,value,exponent,activation_K,of\n43,0,0,0,0\n' >none.csv
expect_exit 0 lines --sources --energy-kev 0.3 --reactions none.csv
! grep -q 'N2(A) + O' "$stdout" || fail "the reaction was not replaced"

# refuses CODE TEXT ARGUMENTS...
refuses() {
  local code=$1 text=$2
  shift 2
  expect_exit "$code" lines "$@"
  expect_one_message
  expect_stderr "$text"
}
refuses 2 "--sources" --energy-kev 2
refuses 2 "--energy-kev" --sources
refuses 2 "--seconds" --sources --energy-kev 1 --seconds 0
refuses 2 "--oxygen-factor" --sources --energy-kev 1 --oxygen-factor nan
refuses 3 "none.csv" --sources --energy-kev 1 --atmosphere none.csv
