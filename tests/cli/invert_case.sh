# vegard invert: lines and maps of them, and how it refuses.
source "$2/tests/cli/case.sh"

# invert CODE ARGUMENTS...; what is told, as JSON, a plot.
invert() {
  local code=$1
  shift
  expect_exit "$code" invert "$@"
}
three=(--line 427.8=2300±50 --line 557.7=12800+-200 --line 630.0=330±5%)
invert 0 "${three[@]}" -o answer.json --plot answer.svg
expect_only answer.json answer.svg
expect_stdout "verdict: well constrained"
expect_stdout "1 degree of freedom"
grep -qF '"verdict": "well constrained"' answer.json || fail "the verdict in JSON"
head -c 4 answer.svg | grep -q '<svg' || fail "the plot is no SVG"
invert 0 "${three[@]}" --json
grep -qF '"energy_kev": {' "$stdout" || fail "--json prints no JSON"
invert 2 "${three[@]}" -o answer.json
expect_one_message
cp answer.json first.json
invert 0 "${three[@]}" -o answer.json --plot answer.svg --overwrite
expect_same answer.json first.json

# The tables' uncertainty makes intervals wider, and bears what exact tables do not.
invert 0 --line 427.8=2361±3% --line 557.7=9838±3% --line 630.0=348±3% --json
grep -qF '"sigma_ln_of_tables"' "$stdout" || fail "no corrections in JSON"
invert 5 --line 427.8=2361±3% --line 557.7=14500±3% --line 630.0=348±3% --uncertainty none
invert 0 --line 427.8=2361±3% --line 557.7=14500±3% --line 630.0=348±3%

# What the verdicts are.
invert 0 --line 557.7=1600±1% --line 337.1=496±1% --uncertainty none
expect_stdout "verdict: two solutions"
invert 0 --line 427.8=124±3 --line 630.0=1400±80
expect_stdout "verdict: | one side | E0"
invert 5 --line 427.8=2300±50 --line 557.7=30000±200 --line 630.0=330±10 -o against.json
expect_stdout "contradict each other"
expect_file against.json
invert 0 --line 427.8=2300±50 --free flux --energy-kev 5
expect_stdout "held"
for spectrum in gaussian mono kappa; do
  invert 0 "${three[@]}" --model-error 20 --spectrum $spectrum
  expect_stdout "electrons: $spectrum"
done
invert 0 --line 427.8=2300 --line 630.0=330 --relative-error 5 --threads 1
cp "$stdout" one.txt
invert 0 --line 427.8=2300±5% --line 630.0=330±5% --threads 2
expect_same "$stdout" one.txt

# A soft component: given, found, and asked for by lines that one Maxwellian does not make (6 keV and 0.3 keV, GLOW's tables: 2.6 mW m-2, of which 0.76 soft).
invert 0 "${three[@]}" --soft-ratio 0.02 --soft-kev 0.2
expect_stdout "a Maxwellian of 0.2 keV"
two=(--line 427.8=584±3% --line 557.7=2504±3% --line 630.0=1159±3% --line 844.6=369±3% --tables glow)
invert 5 "${two[@]}" -o asks.json
expect_stdout "another spectrum | soft"
grep -qF '"soft_ratio": 0.' asks.json || fail "the trial with a soft component is not in JSON"
invert 0 "${two[@]}" --free energy,flux,soft
expect_stdout "soft flux / rest"

# A night: rows together, with what is not of lines copied; the same for every number of threads.
printf 'hour,427.8,557.7,557.7_error,630.0\n8.0,2361,9838,300,348\n8.1,1180,4900,150,210\n8.2,2500,9000,280,300\n' >night.csv
invert 0 --table night.csv --relative-error 3 -o electrons.csv --threads 1
expect_stdout "by 3 rows"
[[ $(grep -vc '^#' electrons.csv) -eq 4 ]] || fail "not a row for each row"
grep -q '^hour,energy_flux_mw_m2,energy_flux_mw_m2_68_low' electrons.csv || fail "columns of the table"
cp electrons.csv first.csv
invert 0 --table night.csv --relative-error 3 -o electrons.csv --threads 2 --overwrite
expect_same electrons.csv first.csv
invert 0 --table night.csv --relative-error 3 -o exact.csv --uncertainty none

# Tables of one's own, with several amounts of atomic oxygen: twice of it halves the red line of the same electrons.
cp -r "$SOURCE/data/glow" own
awk -F, -v OFS=, '
  NR == 1 { print "oxygen_factor," $0; next }
  { rows[++count] = $0 }
  END {
    for (f = 0.5; f <= 2; f *= 2)
      for (i = 1; i <= count; ++i) { $0 = rows[i]; $7 = $7 / f; print f, $0 }
  }' "$SOURCE/data/glow/ver_maxwellian.csv" >own/ver_maxwellian.csv
oxygen=(--line 427.8=2300±1% --line 557.7=9000±1% --line 630.0=330±1%)
invert 0 "${oxygen[@]}" --tables own --free energy,flux,oxygen
expect_stdout "oxygen factor"
invert 0 "${oxygen[@]}" --tables own --oxygen-factor 1.5 --model-error 20 --json
grep -qF '"uncertainty": "none"' "$stdout" || fail "tables without modes have an uncertainty"

# refuses CODE TEXT ARGUMENTS...
refuses() {
  local code=$1 text=$2
  shift 2
  expect_exit "$code" invert "$@"
  expect_one_message
  expect_stderr "$text"
}
refuses 2 "no line"
refuses 2 "--kappa" "${three[@]}" --kappa 4
refuses 2 "--soft-kev" "${three[@]}" --soft-kev 0.2
refuses 2 "3 unknowns" --line 427.8=2300±50 --line 630.0=330±15 --free energy,flux,soft
refuses 2 "--output" --table night.csv --relative-error 3
refuses 3 "error of 427.8 nm" --table night.csv -o new.csv
printf 'hour,blue\n8,1\n' >no_lines.csv
refuses 3 "no_lines.csv | 427.8_error" --table no_lines.csv --relative-error 3 -o new.csv
refuses 2 "no line | 500 nm" --line 500=1±1 --line 630.0=5±1
refuses 2 "no line | 656.3 nm" --line 656.3=1±1 --line 630.0=5±1
refuses 2 "brightness of 427.8 nm | -3" --line 427.8=-3±1 --line 630.0=5±1
refuses 2 "error of 0" --line 427.8=3±0 --line 630.0=5±1
refuses 2 "error of 427.8 nm" --line 427.8=3 --line 630.0=5±1
refuses 2 "not understood" --line 427.8:3 --line 630.0=5±1
refuses 2 "427.8 nm | twice" --line 427.8=3±1 --line 427.8=5±1
refuses 2 "1 line | 2 unknowns" --line 427.8=2300±50
expect_stderr "630.0 with 427.8"
refuses 2 "one upper state" --line 427.8=2300±50 --line 391.4=7500±50
refuses 2 "atomic oxygen" "${oxygen[@]}" --tables glow --free energy,flux,oxygen
refuses 2 "2 lines | 3 unknowns" --line 427.8=2300±50 --line 630.0=330±5 --tables own --free energy,flux,oxygen
refuses 2 "neither" "${three[@]}" --free flux
refuses 2 "--energy-kev" "${three[@]}" --energy-kev 5
refuses 2 "outside" --line 427.8=2300±50 --free flux --energy-kev 50
refuses 2 "--free" "${three[@]}" --free colour
refuses 2 "--spread" "${three[@]}" --spread 0.2
refuses 2 "--relative-error" --line 427.8=3 --line 630.0=5 --relative-error 0
refuses 2 "--plot" "${three[@]}" --plot answer.gif
refuses 2 "--error" "${three[@]}" --error 427.8=5
refuses 3 "missing" "${three[@]}" --tables ./missing
refuses 6 "missing" "${three[@]}" -o missing/answer.json

# Maps, of brightnesses of 5 keV and 10 mW m^-2, with a pixel that is not measured, one without light and one that contradicts.
python3 - <<EOF
import struct
def fits(name, rows):
    cards = [("SIMPLE", "T"), ("BITPIX", "-32"), ("NAXIS", "2"), ("NAXIS1", str(len(rows[0]))), ("NAXIS2", str(len(rows)))]
    head = "".join(f"{key:<8}= {value:>20}".ljust(80) for key, value in cards) + "END".ljust(80)
    data = b"".join(struct.pack(">f", value) for row in rows for value in row)
    open(name, "wb").write(head.ljust(2880).encode() + data.ljust(2880, b"\0"))
nan = float("nan")
fits("blue.fits", [[2631, 2631, 0, 2631], [1316, 2631, 2631, 263]])
fits("green.fits", [[9584, nan, 0, 42000], [4700, 9584, 9584, 853]])
fits("red.fits", [[298.5, 298.5, -2, 298.5], [149, 298.5, 298.5, 29.6]])
fits("small.fits", [[1, 2], [3, 4]])
EOF
maps=(--map 427.8=blue.fits --map 557.7=green.fits --map 630.0=red.fits)
errors=(--error 427.8=3% --error 427.8=5 --error 557.7=3% --error 557.7=5 --error 630.0=3% --error 630.0=5)
invert 0 "${maps[@]}" "${errors[@]}" -o map.fits -o map.nc --threads 1
expect_stdout "5  well constrained"
expect_stdout "1  lines contradict each other"
expect_stdout "1  no light"
expect_stdout "1  not measured"
expect_starts map.fits 53494d504c45
expect_starts map.nc 89484446
cp map.fits one.fits && cp map.nc one.nc
invert 0 "${maps[@]}" "${errors[@]}" -o map.fits -o map.nc --threads 2 --overwrite
expect_same map.fits one.fits
expect_same map.nc one.nc
python3 - <<EOF || fail "the map holds other numbers"
import math, struct
data = open("map.fits", "rb").read()
at = 0
while b"END     " not in [data[i:i + 8] for i in range(at, at + 2880, 80)]: at += 2880
at += 2880
value = lambda plane, i: struct.unpack_from(">f", data, at + 4 * (plane * 8 + i))[0]
# Rows from the bottom up, as they came: pixel 0 has light, 1 is not measured, 2 without light, 3 contradicts.
assert abs(value(0, 0) / 10 - 1) < 0.03 and abs(value(1, 0) / 5 - 1) < 0.03, (value(0, 0), value(1, 0))
assert all(math.isnan(value(plane, i)) for plane in (0, 1, 2, 3) for i in (1, 2))
assert all(math.isnan(value(plane, 3)) for plane in (0, 1)) and value(8, 0) > 0.9 and value(8, 3) < 0.0027
assert [value(9, i) for i in range(4)] == [0, 6, 5, 4]
EOF
# Most of the pixels with light contradict the tables.
invert 5 --map 427.8=blue.fits --map 557.7=blue.fits --map 630.0=blue.fits --relative-error 3 -o against.fits --uncertainty none
expect_file against.fits
invert 0 "${maps[@]}" "${errors[@]}" -o common.fits --common-physics
invert 0 "${maps[@]}" "${errors[@]}" -o soft.fits --free energy,flux,soft
grep -aq PLANE11 soft.fits || fail "no plane of the soft component"
# An image of errors, and lines as a rendering has them.
invert 0 "${maps[@]}" --relative-error 5 --error 630.0=blue.fits -o with_errors.nc
expect_exit 0 render "$SCENES/small.toml" --lines lines.exr -o photo.png
invert 0 --map 427.8=lines.exr --map 557.7=lines.exr --map 630.0=lines.exr --relative-error 5 -o rendered.fits
refuses 2 "--output" "${maps[@]}" "${errors[@]}"
refuses 2 ".fits or .nc" "${maps[@]}" "${errors[@]}" -o map.png
refuses 2 "error of 427.8 nm" "${maps[@]}" -o new.nc
refuses 2 "337.1 nm" "${maps[@]}" "${errors[@]}" --error 337.1=5 -o new.nc
refuses 2 "an input" "${maps[@]}" "${errors[@]}" -o blue.fits --overwrite
refuses 2 "--plot" "${maps[@]}" "${errors[@]}" -o new.nc --plot new.svg
refuses 2 "excludes" "${maps[@]}" "${three[@]}" -o new.nc
refuses 3 "2 x 2" --map 427.8=blue.fits --map 630.0=small.fits --relative-error 5 -o new.nc
refuses 3 "missing.fits" --map 427.8=blue.fits --map 630.0=missing.fits --relative-error 5 -o new.nc
refuses 3 "integers" --map 427.8=photo.png --map 630.0=red.fits --relative-error 5 -o new.nc
[[ ! -e new.nc ]] || fail "what is refused leaves a map"
