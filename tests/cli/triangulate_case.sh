# Heights and places by two cameras' lines of sight. Pixels are computed here, on a sphere, by another way than the program's.
source "$(dirname "$0")/case.sh"
cat >made.py <<'PY'
import math

SITES = {"a": (69.35, 20.36), "b": (68.03, 21.69)}


def place(latitude, longitude, height):
    la, lo = math.radians(latitude), math.radians(longitude)
    r = 6371.0 + height
    return (r * math.cos(la) * math.cos(lo), r * math.cos(la) * math.sin(lo), r * math.sin(la))


def pixel(site, at):
    """By the angles of an equidistant lens at the zenith, north up and east to the right."""
    here = place(*SITES[site], 0.0)
    d = [x - y for x, y in zip(at, here)]
    la, lo = map(math.radians, SITES[site])
    east = -math.sin(lo) * d[0] + math.cos(lo) * d[1]
    north = -math.sin(la) * math.cos(lo) * d[0] - math.sin(la) * math.sin(lo) * d[1] + math.cos(la) * d[2]
    up = math.cos(la) * math.cos(lo) * d[0] + math.cos(la) * math.sin(lo) * d[1] + math.sin(la) * d[2]
    zenith, azimuth = math.atan2(math.hypot(east, north), up), math.atan2(east, north)
    # Azimuth 0, elevation 90: the picture's top is where the camera's upper side points, to the south.
    return 500 + 300 * zenith * math.sin(azimuth), 500 + 300 * zenith * math.cos(azimuth)


for name, (latitude, longitude) in SITES.items():
    with open(f"{name}.toml", "w") as f:
        f.write(f"[site]\nlatitude_deg = {latitude}\nlongitude_deg = {longitude}\naltitude_m = 0.0\n")
        f.write('[camera]\nmodel = "equidistant"\nwidth = 1000\nheight = 1000\nfocal_px = 300.0\n')
        f.write("azimuth_deg = 0.0\nelevation_deg = 90.0\nroll_deg = 0.0\n")
with open("sights.csv", "w") as f:
    f.write("name;camera;x_px;y_px\n")
    for camera, site in enumerate("ab"):
        x, y = pixel(site, place(68.8, 20.0, 118.0))
        f.write(f"knot;{camera + 1};{x:.4f};{y:.4f}\n".replace(".", ","))
        # Points of a border 105 km high, others in one picture than in the other.
        for k in range(30):
            longitude = 17 + 0.2 * k + 0.09 * camera
            x, y = pixel(site, place(68.9 + 0.05 * math.sin(longitude), longitude, 105.0))
            f.write(f"border;{site}.toml;{x:.4f};{y:.4f}\n".replace(".toml", "#").replace(".", ",").replace("#", ".toml"))
with open("bad.csv", "w") as f:
    f.write("name,camera,x_px,y_px\nswapped,1,500,900\nswapped,2,500,100\n")
PY
python3 made.py
two=(--camera a.toml --camera b.toml)
exact=(--earth sphere --no-refraction --pointing-error 0.01 --pixel-error 0.1)
expect_exit 0 triangulate sights.csv "${two[@]}" "${exact[@]}" -o out.csv --geojson out.geojson --kml out.kml
expect_stdout "knot: height 118.0"
expect_stdout "border (a.toml+b.toml): height 105.0"
python3 - <<'PY' || fail "other places than those of the table"
import csv, json, xml.dom.minidom

rows = list(csv.DictReader(line for line in open("out.csv") if line[0] != "#"))
knot = rows[0]
assert abs(float(knot["height_km"]) - 118) < 0.01 and abs(float(knot["latitude_deg"]) - 68.8) < 1e-4, knot
heights = [float(r["height_km"]) for r in rows if r["name"] == "border"]
assert len(heights) > 25 and max(abs(h - 105) for h in heights) < 0.1, heights
features = json.load(open("out.geojson"))["features"]
point = next(f for f in features if f["properties"]["kind"] == "point")
assert abs(point["geometry"]["coordinates"][2] - 118000) < 10
assert sum(f["properties"]["kind"] == "curve" for f in features) == 1
xml.dom.minidom.parse("out.kml")
PY
# On the ellipsoid the same pixels are another place: the table does not say that they are a sphere's.
expect_exit 5 triangulate sights.csv "${two[@]}" --no-refraction --pointing-error 0.001 --pixel-error 0.01
# Without a place: the reason, and not a number.
expect_exit 5 triangulate bad.csv "${two[@]}" "${exact[@]}" -o none.csv
expect_stdout "behind a camera"
grep -q "NaN,NaN,NaN" none.csv || fail "a place that is none has a number"
# One message each.
expect_exit 2 triangulate sights.csv "${two[@]}"
expect_one_message
expect_stderr "--pointing-error"
expect_exit 2 triangulate sights.csv --camera a.toml --pointing-error 0.1
expect_one_message
expect_exit 2 triangulate sights.csv "${two[@]}" --pointing-error 0.1,0.1,0.1
expect_one_message
expect_exit 2 triangulate sights.csv "${two[@]}" --pointing-error nan
expect_stderr "nan"
expect_exit 3 triangulate "${two[@]}" nothing.csv "${exact[@]}"
expect_stderr "nothing.csv"
expect_exit 2 triangulate sights.csv "${two[@]}" "${exact[@]}" -o out.csv
expect_stderr "--overwrite"
expect_exit 2 triangulate sights.csv "${two[@]}" "${exact[@]}" -o a.toml --overwrite
expect_one_message
expect_exit 3 triangulate nothing.csv "${two[@]}" "${exact[@]}"
expect_one_message
for rows in 'p,3,1,1' 'p,1,1,x' 'p,1,1,1' 'p,1,1' 'p,1,1,1\np,2,1,1\np,2,2,2'; do
  printf 'name,camera,x_px,y_px\n%b\n' "$rows" >wrong.csv
  expect_exit 3 triangulate wrong.csv "${two[@]}" "${exact[@]}"
  expect_one_message
  expect_stderr "wrong.csv:"
done
# A name that two cameras have says neither of them.
mkdir other
cp b.toml other/a.toml
printf 'name,camera,x_px,y_px\np,a.toml,500,400\np,2,500,600\n' >twice.csv
expect_exit 3 triangulate twice.csv --camera a.toml --camera other/a.toml "${exact[@]}"
expect_stderr "twice.csv:2: | its number"
# A curve of so many points would take hours.
{ echo name,camera,x_px,y_px && for camera in 1 2; do seq 5001 | awk -v c=$camera '{ print "c," c "," 400 + $1 / 50 ",500" }'; done; } >long.csv
expect_exit 3 triangulate long.csv "${two[@]}" "${exact[@]}"
expect_stderr "5000"
