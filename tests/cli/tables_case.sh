# vegard tables: a folder of emission tables as a whole or not at all, and how it refuses.
source "$2/tests/cli/case.sh"

# refuses CODE TEXT ARGUMENTS...
refuses() {
  local code=$1 text=$2
  shift 2
  expect_exit "$code" tables "$@"
  expect_one_message
  expect_stderr "$text"
  [[ ! -e out ]] || fail "something is left"
}
refuses 2 "--output"
refuses 2 "--oxygen-factors" -o out --oxygen-factors 0.5,2
refuses 2 "--oxygen-factors" -o out --oxygen-factors 1,0.5
refuses 2 "--oxygen-factors" -o out --oxygen-factors 1,nan
refuses 2 "--refinement" -o out --refinement 0.01
refuses 2 "--steady | --seconds" -o out --steady --seconds 60
refuses 2 "--seed | --ensemble" -o out --seed 3
refuses 3 "missing.csv" -o out --atmosphere missing.csv
printf 'altitude_km,T_K,nN2,nO2,nO\n90,190,4e13,1e13,2e11\n400,1000,4e6,1e5,1e8\n' >short.csv
refuses 3 "80 km | 640 km" -o out --atmosphere short.csv
printf 'altitude_km,T_K,nN2,nO2,nO\n80,190,4e14,1e14,2e11\n640,1000,-4,1e5,1e8\n' >negative.csv
refuses 3 "negative.csv" -o out --atmosphere negative.csv
printf 'number,value,exponent,activation_K,of\n9,1,0,0,0\n' >reactions.csv
refuses 3 "no reaction" -o out --reactions reactions.csv

# A folder of somebody else stays, whatever is asked.
mkdir thesis
echo mine >thesis/about.json
expect_exit 2 tables -o thesis
expect_one_message
expect_exit 2 tables -o thesis --overwrite
expect_stderr "about.json"
[[ $(cat thesis/about.json) == mine ]] || fail "the thesis"
