# Voxels of a scene's light, whole or not at all, the same for any number of threads; and back into a picture.
source "$(dirname "$0")/case.sh"
small=$SCENES/small.toml
expect_exit 0 volume "$small" -o one.vdb --voxel-km 2 --threads 1
expect_stdout "8 x 8 x 8 | 2 km"
expect_exit 0 volume "$small" -o two.vdb --voxel-km 2 --threads 2
expect_same one.vdb two.vdb
grep -qa "emission_5577" one.vdb || fail "no grid of the green line"
grep -qa "photons cm^-3 s^-1" one.vdb || fail "no unit"
grep -qa "voxel_centre_index" one.vdb || fail "no word of where the centres are"
expect_exit 0 volume "$small" -o green.vdb --voxel-km 2 --lines 557.7 --for houdini
expect_different one.vdb green.vdb
! grep -qa "emission_6300" green.vdb || fail "a line that was not asked for"
expect_exit 2 volume "$small" -o one.vdb --voxel-km 2
expect_stderr "--overwrite"
expect_exit 2 volume "$small" -o bad.ply
expect_stderr ".vdb"
expect_exit 2 volume "$small" -o bad.vdb --lines 500
expect_stderr "--lines"
expect_exit 2 volume "$small" -o bad.vdb --of nobody
expect_stderr "--of"
expect_exit 2 volume "$small" -o bad.vdb --box 0,1,2,3,5,4
expect_stderr "--box"
expect_exit 2 volume "$small" -o bad.vdb --memory-limit 0.001
expect_stderr "would do"
expect_one_message
# What a refusal says would do does: of sheets, of a footprint, of both.
follow_the_hint() { # VOXEL ARGUMENTS...: a refused command; the voxel that its hint names is taken
  local voxel=$1
  shift
  expect_exit 2 volume "$@" -o hint.vdb --voxel "$voxel"
  expect_one_message
  voxel=$(sed -n 's/.*Voxels of \([0-9.e-]*\) would do.*/\1/p' "$stderr")
  [[ -n $voxel ]] || fail "no hint"
  expect_exit 0 volume "$@" -o hint.vdb --voxel "$voxel"
  rm hint.vdb
}
few=(--set sheet.main.beams=20)
follow_the_hint 0.01 "$small" "${few[@]}" --memory-limit 100M
follow_the_hint 0.3 "$small" "${few[@]}" --memory-limit 0.05
expect_exit 2 volume "$small" -o bad.vdb --box 9000,9001,0,1,5,6
expect_stderr "nothing"
printf '[[footprint]]\nname = "foot"\nsource = "sheets"\n' | cat "$small" - >foot.toml
expect_exit 0 volume foot.toml -o foot.vdb --voxel-km 4 --of foot
expect_stdout "bricks of"
follow_the_hint 1 foot.toml "${few[@]}" --memory-limit 80M --of foot
follow_the_hint 1.5 foot.toml "${few[@]}" --memory-limit 20M
rm -f foot.toml
expect_exit 6 volume "$small" -o no/such/folder/out.vdb
status=0
(ulimit -f 64 && exec "$VEGARD" volume "$small" -o full.vdb --voxel-km 2 >"$stdout" 2>"$stderr") || status=$?
[[ $status -eq 6 ]] || fail "exit $status instead of 6 on a full disk"
# Read back: as bright from either convention, and dark to a scene of other lines.
sed '/^\[\[sheet\]\]/,/^$/d' "$small" >seen.toml
printf '[[volume]]\nname = "band"\nfile = "one.vdb"\n' >>seen.toml
expect_exit 0 render seen.toml -o seen.png --lines seen.exr
expect_stdout "peak"
green() { sed 's/.*[ ,]\([0-9]*\) R at 557.7 nm.*/\1/' "$stdout"; }
brightness=$(green)
[[ $brightness -gt 100 ]] || fail "a peak of $brightness R"
sed 's/one.vdb/green.vdb/' seen.toml >other.toml
expect_exit 0 render other.toml -o other.png
[[ $(green) -eq $brightness ]] || fail "the conventions differ"
expect_exit 3 render other.toml -o none.png --set 'emission.lines=[630.0]'
expect_stderr "emission_5577"
# Never over what the scene reads; and the ending counts however it is written.
cp one.vdb before.vdb
expect_exit 2 volume seen.toml -o one.vdb --voxel-km 2 --overwrite
expect_stderr "scene reads"
expect_one_message
expect_same one.vdb before.vdb
expect_exit 0 volume "$small" -o Three.VDB --voxel-km 2
expect_same one.vdb Three.VDB
# Light without sheets has no deflection points, and none are listed.
expect_exit 2 points seen.toml -o none.csv
expect_stderr "vegard volume"
expect_one_message
# The stars of the Sun's scene as spheres: alone, and shining in their places when they are read back.
cat >stars.toml <<'EOF'
site = { altitude_m = 1e9 }
camera = { width = 96, height = 64, hfov_deg = 20, azimuth_deg = 180, elevation_deg = 40 }
emission = { lines = [630.0, 557.7, 427.8] }
sensor = { response = "filters" }
stars = { shown = true, width_deg = 0.2, gain = 1e3, sphere_distance = 1.5 }
sun = { shown = true, azimuth_deg = 180, elevation_deg = 40, unit_km = 1000, radius = 10, distance_km = 700000 }
[[corona]]
name = "halo"
rayleigh = [10, 10, 10]
EOF
expect_exit 0 volume stars.toml -o stars.vdb --of stars
sed '/^\[\[corona/,$d' stars.toml | sed 's/shown = true, width/shown = false, width/' >seen.toml
printf '[[volume]]\nname = "spheres"\nfile = "stars.vdb"\nframe = "sun"\n' >>seen.toml
expect_exit 0 render seen.toml -o stars.png
[[ $(green) -gt 1000 ]] || fail "stars of $(green) R at most"
expect_exit 2 volume stars.toml -o none.vdb --of stars --set stars.sphere_distance=0
expect_stderr "stars"
rm -f seen.toml other.toml before.vdb stars.toml stars.vdb stars.png
expect_only one.vdb two.vdb green.vdb foot.vdb Three.VDB seen.png seen.exr other.png
