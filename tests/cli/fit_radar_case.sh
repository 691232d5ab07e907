# A radar's densities beside a photograph: one run with its panel, the same bytes for any number of threads, a best scene that
# can be fitted again, and how what cannot be compared is refused.
source "$(dirname "$0")/case.sh"

# The sheet of small.toml with one straight layer, whose middle the radar looks at: 20 km east and 220 km north of the site.
sed -e 's/^layers = .*/layers = 1/' -e 's/^width_km = .*/width_km = 6.0/' -e 's/^thickness_km = .*/thickness_km = 0.5/' \
  -e 's/^latitude_deg = .*/&\nlongitude_deg = 20.0/' "$SCENES/small.toml" >truth.toml
# The picture's shape then says nothing of the energy flux: what is found is the radar's.
printf '\n[emission]\nflux_law = "linear"\n' >>truth.toml
expect_exit 0 render truth.toml -o photo.png
read -r latitude longitude < <(python3 -c '
import math
r, site = 6481.0, math.radians(65.0)
e, n = 20.0 / r, 220.0 / r
u = math.sqrt(1 - e * e - n * n)
out = math.cos(site) * u - math.sin(site) * n
print(math.degrees(math.atan2(math.cos(site) * n + math.sin(site) * u, math.hypot(e, out))),
      20 + math.degrees(math.atan2(e, out)))')
expect_exit 0 ionosphere --energy-kev 3 --flux-mw-m2 5 --steady --uncertainty none -o profile.csv
awk -F, '
  BEGIN { print "altitude_km,density_m3,density_m3_error" }
  /^[0-9]/ && $1 >= 90 && $1 <= 150 && $1 % 5 == 0 { printf "%s,%s,%g\n", $1, $2, 0.05 * $2 + 5e9 }' profile.csv >density.csv
mkdir radar
mv density.csv radar/
cat truth.toml - >joint.toml <<END

[fit]
bands = 4
free = [{ path = "sheet.main.center_km.north", start = 222.0 }, { path = "sheet.main.energy_kev", start = 3.5 },
  "sheet.main.energy_flux_mw_m2"]
model_error = 0.01
scan_points = 0

[[fit.radar]]
name = "made"
file = "radar/density.csv"
latitude_deg = $latitude
longitude_deg = $longitude
scale_sigma = 0.1
END
expect_exit 0 fit joint.toml --photo photo.png --out runs/one --threads 1
expect_stdout "Believable"
python3 - <<'END' || fail "not the radar's numbers"
import json
result = json.load(open("runs/one/result.json"))
radar, = result["radars"]
assert radar["name"] == "made" and radar["values"] == 11 == len(radar["altitude_km"]), radar
assert abs(radar["scale"] - 1) < 2 * radar["scale_sigma"] < 0.2, radar
assert abs(radar["energy_kev"] / 3 - 1) < 0.1 and radar["time_s"] is None, radar
assert {"role": "radar", "name": "density.csv"}.items() <= result["inputs"][-1].items(), result["inputs"]
assert any(check["name"] == "radar made" and check["passed"] for check in result["checks"]), result["checks"]
assert any(s["name"] == "radar made" and s["residuals"] == 11 for s in result["statistics"]), result["statistics"]
assert all(p["sigma"] for p in result["parameters"]), result["parameters"]
END
grep -qF "Density of electrons" runs/one/report.html || fail "no panel in the report"
expect_exit 0 fit joint.toml --photo photo.png --out runs/two --threads 2
expect_same runs/one/trace.csv runs/two/trace.csv
grep -qF 'file = "../../radar/density.csv"' runs/one/best.toml || fail "best.toml names no radar"
expect_exit 0 fit runs/one/best.toml --photo photo.png --out runs/again

# Densities twice as large as the light's electrons allow.
awk -F, -v OFS=, 'NR > 1 { $2 *= NR % 2 ? 3 : 1; $3 = 0.02 * $2 } 1' radar/density.csv >radar/saw.csv
sed 's/density.csv/saw.csv/' joint.toml >saw.toml
expect_exit 5 fit saw.toml --photo photo.png --out runs/saw
expect_stdout "radar made"

# refuses CODE FACTS SCENE COMMAND...
refuses() {
  local code=$1 facts=$2
  shift 2
  expect_exit "$code" "$@"
  expect_one_message
  expect_stderr "$facts"
}
cut -d, -f1,2 radar/density.csv >radar/bare.csv
sed 's/density.csv/bare.csv/' joint.toml >bare.toml
refuses 3 "bare.csv | errors | density_m3_error" fit bare.toml --photo photo.png --out run
sed 's/^altitude_km/height/' radar/density.csv >radar/columns.csv
sed 's/density.csv/columns.csv/' joint.toml >columns.toml
refuses 3 "columns.csv | altitude_km" fit columns.toml --photo photo.png --out run
sed "s/^latitude_deg = $latitude/latitude_deg = 68.0/" joint.toml >outside.toml
refuses 2 "outside.toml | radar 'made' | km away" fit outside.toml --photo photo.png --out run
sed '/^longitude_deg = 20.0/d' joint.toml >nowhere.toml
refuses 2 "nowhere.toml | site.longitude_deg" fit nowhere.toml --photo photo.png --out run
sed 's/^scale_sigma/scale_sgma/' joint.toml >misspelt.toml
refuses 2 "misspelt.toml | scale_sgma | did you mean 'scale_sigma'?" fit misspelt.toml --photo photo.png --out run
refuses 2 "fit.radar" map joint.toml --photo photo.png --out run
refuses 2 "fit.radar" fit joint.toml --photo photo.png --decoding unknown --out run
refuses 2 "a radar's file | density.csv" fit joint.toml --photo photo.png --out radar --overwrite
[[ ! -e run ]] || fail "a run was written"
