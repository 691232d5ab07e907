# The product's command with one kind of emitters more, which it was not compiled with: parameters, render, grid, preview,
# fit and report. $3 is the command without it.
source "$2/tests/cli/case.sh"
PRODUCT=$3
unset DISPLAY WAYLAND_DISPLAY
cat >ball.toml <<'TOML'
seed = 3
[emission]
lines = [557.7]
[blur]
width_deg = [0.0]
[camera]
width = 96
height = 72
hfov_deg = 40
azimuth_deg = 0
elevation_deg = 22
[[glow_ball]]
name = "lamp"
place_km = [3.0, 100.0, 40.0]
width_km = 6.0
rayleigh = [4000.0]
[sensor]
gain_per_kilorayleigh = 0.1
[sky]
level = [0.02, 0.02, 0.02]
[fit]
bands = 4
sky_terms = 1
model_error = 0.01
scan_points = 0
free = ["glow_ball.lamp.width_km", "glow_ball.lamp.place_km.up"]
TOML
peak() { sed -n 's/.*[ ,]\([0-9]*\) R at 557.7 nm.*/\1/p' "$stdout"; }

# Parameters: listed like any others, and known by name.
expect_exit 0 params
expect_stdout "glow_ball.<name>.width_km"
expect_stdout "standard deviation of its light in space"
expect_exit 2 render ball.toml -o none.png --set glow_ball.lamp.width_km=-1
expect_stderr "glow_ball.lamp.width_km"
expect_exit 2 render ball.toml -o none.png --set glow_ball.lamp.girth=1
expect_stderr "no such parameter"

# Render, by TOML and by --set.
expect_exit 0 render ball.toml -o ball.png
bright=$(peak)
[[ $bright -gt 3900 && $bright -le 4000 ]] || fail "a peak of $bright R"
expect_exit 0 render ball.toml -o again.png --threads 2
expect_same ball.png again.png
expect_exit 0 render ball.toml -o dim.png --set glow_ball.lamp.rayleigh.5577=1000
[[ $(peak) -gt 970 && $(peak) -le 1000 ]] || fail "a peak of $(peak) R"
expect_exit 0 render ball.toml -o away.png --set camera.azimuth_deg=180
expect_stderr "the middle of glowing ball 'lamp' is at azimuth 2°, elevation 22°"

# A grid of its light, which is as bright again; by name, and not too coarse for it.
expect_exit 0 volume ball.toml -o ball.vdb --voxel-km 1 --of lamp
expect_stdout "bricks of"
expect_exit 2 volume ball.toml -o none.vdb --of nobody
expect_stderr "nothing that shines is called 'nobody'"
expect_exit 2 volume ball.toml -o none.vdb --voxel-km 7
expect_stderr "glow_ball 'lamp'"
sed '/^\[\[glow_ball\]\]/,/^rayleigh/d; /^free = /d' ball.toml >grid.toml
printf '[[volume]]\nname = "ball"\nfile = "ball.vdb"\n' >>grid.toml
expect_exit 0 render grid.toml -o grid.png
[[ $(peak) -gt 3850 && $(peak) -lt 4100 ]] || fail "a peak of $(peak) R from the grid"

# A preview, in which it rises with the clock.
expect_exit 0 preview ball.toml -o still --frames 2 --turn 0 --size 60x60 --run --fps 1
expect_same still/frame_0000.png still/frame_0001.png
expect_exit 0 preview ball.toml -o rising --frames 2 --turn 0 --size 60x60 --run --fps 1 --set glow_ball.lamp.rise_km_s=2
expect_different rising/frame_0000.png rising/frame_0001.png

# A fit finds it, and reports.
expect_exit 0 fit ball.toml --photo ball.png --out run --set glow_ball.lamp.width_km=8 --set glow_ball.lamp.place_km.up=41.5
expect_stdout "glow_ball.lamp.width_km"
grep -qF "glow_ball.lamp.width_km" run/report.html || fail "the report does not name it"
found=$(sed -n '/^\[\[glow_ball\]\]/,/^rayleigh/s/^width_km = \([0-9.]*\).*/\1/p' run/best.toml)
awk -v found="$found" 'BEGIN { exit !(found > 5.7 && found < 6.3) }' || fail "a width of $found km"
up=$(sed -n '/^\[\[glow_ball\]\]/,/^rayleigh/s/^place_km = .*, \([0-9.]*\)\].*/\1/p' run/best.toml)
awk -v up="$up" 'BEGIN { exit !(up > 39.7 && up < 40.3) }' || fail "$up km up"
expect_exit 0 render run/best.toml -o best.png

# The product itself does not have it.
VEGARD=$PRODUCT
expect_exit 0 params
! grep -q glow_ball "$stdout" || fail "the product has the test's kind"
expect_exit 2 render ball.toml -o none.png
expect_stderr "unknown table 'glow_ball'"
