# A curtain of free course, from a table of curtains: rendered, animated, as points and as a volume, and its derivatives; a map of
# precipitation that is none.
source "$(dirname "$0")/case.sh"
cat >curtains.csv <<'END'
curtain,point,east_km,north_km,distance_km,azimuth_deg,lower_border_km,energy_flux_mw_m2,energy_kev,width_km,energy_kev_error
1,1,-60,300,306,349,100,1,2,2,nan
1,2,60,300,306,11,100,1,2,2,nan
2,1,-90,190,210,335,100,4,2.1,1.5,0.1
2,2,-20,215,216,355,100,8,3.3,1,0.1
2,3,30,180,182,9,100,6,5.2,1.8,0.1
2,4,110,205,233,28,100,3,4.3,2,0.1
END
cat >scene.toml <<'END'
seed = 7
[camera]
width = 160
height = 120
hfov_deg = 60.0
elevation_deg = 38.0
[time]
frames = 2
frames_per_second = 1
[[sheet]]
course = "curve"
curve_file = "curtains.csv"
curve = 2
layers = 1
beams = 400
drift_km_s = [0.0, -3.0]
[fit]
bands = 12
free = ["sheet.main.north_km", "sheet.main.east_km.1", "sheet.main.point_energy_kev", "sheet.main.point_brightness.1",
        "sheet.main.point_width_km.2", "sheet.main.energy_flux_mw_m2"]
END
expect_exit 0 render scene.toml -o one.png --threads 1
expect_exit 0 render scene.toml -o two.png --threads 2
expect_same one.png two.png
expect_exit 0 render scene.toml -o other.png --set 'sheet.main.point_energy_kev=[1.0, 1.0, 1.0, 1.0]'
expect_different one.png other.png
expect_exit 0 animate scene.toml -o "frame_#.png"
expect_different frame_0.png frame_1.png
# Each beam falls with the two profiles about its own energy.
expect_exit 0 points scene.toml -o points.csv
[[ $(grep -vc '^[#x]' points.csv) -gt 400000 ]] || fail "$(grep -vc '^[#x]' points.csv) points of twice 400 beams of some 600"
expect_exit 0 brightness scene.toml
expect_stdout main
expect_exit 0 volume scene.toml -o beams.vdb --voxel 4
expect_file beams.vdb
sed '/^\[fit\]/,$d' scene.toml >volume.toml
printf '[[footprint]]\nsource = "sheets"\nsize_km = [300, 120]\ncell_km = 2\n' >>volume.toml
expect_exit 0 volume volume.toml -o curve.vdb --voxel 4
expect_file curve.vdb
expect_exit 0 fit scene.toml --photo one.png --check-derivatives
expect_stdout "All derivatives"
# One message for each table that cannot be used.
sed 's/,energy_kev,/,energy,/' curtains.csv >other.csv
sed 's/curtains.csv/other.csv/' scene.toml >bad.toml
expect_exit 3 render bad.toml -o none.png
expect_stderr other.csv
expect_stderr energy_kev
expect_one_message
sed 's/^curve = 2/curve = 5/' scene.toml >bad.toml
expect_exit 3 render bad.toml -o none.png
expect_stderr "no curtain 5"
expect_one_message
expect_exit 2 render scene.toml -o none.png --set sheet.main.curve=1
expect_stderr "scene files only"
expect_one_message
# A map of precipitation.
printf '[[footprint]]\nsource = "precipitation"\nfile = "map.fits"\n' >map.toml
expect_exit 3 render map.toml -o none.png
expect_stderr "footprint.arc.file"
expect_one_message
cp one.png map.fits
expect_exit 3 render map.toml -o none.png
expect_stderr map.fits
expect_one_message
printf '[[footprint]]\nsource = "precipitation"\n' >map.toml
expect_exit 2 render map.toml -o none.png
expect_stderr "file names none"
expect_one_message
[[ ! -e none.png ]] || fail "none.png was written"
