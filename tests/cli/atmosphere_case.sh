# vegard atmosphere: the table, the plot, names of conditions, and how it refuses.
source "$2/tests/cli/case.sh"

here=(--time 2014-03-10T06:05:33Z --latitude-deg 65 --longitude-deg -148)
expect_exit 0 atmosphere "${here[@]}" --f107 150 --f107a 140 --ap 20 -o air.csv --plot air.svg
expect_only air.csv air.svg
expect_stdout "65 N 148 W | 20:14 | F10.7 150 | 140 | Ap 20"
expect_stdout "O overtakes N2"
grep -q '^altitude_km,T_K,nN2,nO2,nO,' air.csv || fail "the table's head"
grep -q '^75,' air.csv && grep -q '^640,' air.csv || fail "the table's ends"
head -c 4 air.svg | grep -q '<svg' || fail "the plot is no SVG"
cp air.csv first.csv

# Electrons go down through it; the time may have a zone, the longitude another turn; what is there stays.
expect_exit 0 electrons --energy-kev 0.5 --atmosphere air.csv
expect_stdout "atmosphere: air.csv, 75 to 640 km"
expect_exit 2 atmosphere "${here[@]}" --f107 150 --f107a 140 --ap 20 -o air.csv
expect_one_message
expect_exit 0 atmosphere --time 2014-03-09T21:05:33-09:00 --latitude-deg 65 --longitude-deg -148 --f107 150 --f107a 140 --ap 20 \
  -o air.csv --overwrite
expect_same air.csv first.csv

# The mean flux is that of the day unless told.
expect_exit 0 atmosphere "${here[@]}" --f107 150 --ap 20
expect_stdout "F10.7 150, mean 150, Ap 20"

# Names, alone and with something in the place of what they have.
expect_exit 0 atmosphere --list
expect_stdout "winter_quiet"
expect_exit 0 atmosphere --conditions equinox -o equinox.csv
expect_exit 0 atmosphere --conditions equinox --ap 50 --bottom-km 72.5 --top-km 1000 -o other.csv
expect_stdout "F10.7 150, mean 150, Ap 50"
grep -q '^72.5,' other.csv && grep -q '^1000,' other.csv || fail "the ends that were asked for"
expect_exit 0 atmosphere --conditions equinox --ap-history 20,80,60,40,30,20,10
expect_stdout "ap 20 80 60 40 30 20 10"

# refuses CODE TEXT ARGUMENTS...
refuses() {
  local code=$1 text=$2
  shift 2
  expect_exit "$code" atmosphere "$@"
  expect_one_message
  expect_stderr "$text"
}
refuses 2 "--time"
refuses 2 "--time" --conditions equinox --time yesterday
refuses 2 "--latitude-deg" --time 2014-03-10T06:00:00Z --f107 100 --ap 4
refuses 2 "--latitude-deg" --conditions equinox --latitude-deg 91
refuses 2 "--longitude-deg" "${here[@]:0:4}" --f107 100 --ap 4
refuses 2 "--f107" "${here[@]}" --ap 4
refuses 2 "--f107" --conditions equinox --f107 nan
refuses 2 "--ap" "${here[@]}" --f107 100
refuses 2 "--ap" --conditions equinox --ap 401
refuses 2 "--ap-history" --conditions equinox --ap 4 --ap-history 4,4,4,4,4,4,4
refuses 2 "--ap-history" --conditions equinox --ap-history 4,4,4
refuses 2 "--ap-history" --conditions equinox --ap-history 4,4,4,4,4,4,nan
refuses 2 "no air for" --conditions equinox --latitude-deg -90 --ap 400
refuses 2 "winter_quiet" --conditions autumn
refuses 2 "--bottom-km" --conditions equinox --bottom-km 50
refuses 2 "--bottom-km" --conditions equinox --bottom-km 200 --top-km 150
refuses 2 "--plot" --conditions equinox --plot air.gif
refuses 2 "another output" --conditions equinox -o both.svg --plot both.svg
refuses 6 "missing" --conditions equinox -o missing/air.csv
