# Sheets of grids: of both formats and of a scene, and what is refused.
source "$(dirname "$0")/case.sh"
cat > a.pbrt <<'TEXT'
Volume "volumegrid" "integer nx" [3] "integer ny" [3] "integer nz" [3]
  "point p0" [-4 -4 696] "point p1" [2 2 702]
  "float density" [ 0 0 0 0 1 0 0 0 0  0 1 0 1 2 1 0 1 0  0 0 0 0 1 0 0 0 0 ]
TEXT
expect_exit 0 slices a.pbrt -o a.png
expect_stdout "a.png: density: | 2; | 3 × 3 × 3 | 2 units"
expect_starts a.png 89504e470d0a1a0a
expect_exit 0 grid a.pbrt -o a.vdb
expect_exit 0 slices a.vdb -o a.svg
grep -q "slice at z = 699" a.svg || fail "the middle slice"
grep -q "largest along y" a.svg || fail "the largest along y"
expect_exit 0 slices a.vdb -o at.svg --at 0,0,701 --gamma 2 --colours gold
grep -q "slice at z = 701" at.svg || fail "the slice that was asked for"
grep -q "gamma 2" at.svg || fail "the gamma"
expect_exit 0 slices a.vdb -o row.svg --along z --count 3 --log --decades 2
for z in 697 699 701; do grep -q "slice at z = $z" row.svg || fail "the slice at $z"; done
grep -q "2 decades below" row.svg || fail "the logarithm"
# A scene whose volume stands on the Sun, and the grid that is made of it.
cat > sun.toml <<'SCENE'
[emission]
lines = [17.1]
[sun]
shown = true
[[volume]]
name = "cross"
file = "a.vdb"
frame = "sun"
density_rayleigh = [10]
SCENE
expect_exit 0 slices sun.toml -o sun.svg --voxel 2 --channel emission_171
grep -q "voxels of 2 units of 1000 km" sun.svg || fail "the Sun's unit"
grep -q "white is 0.2 photons" sun.svg || fail "10 R to a megametre of density 1"
expect_exit 0 volume sun.toml -o light.vdb --voxel 2
cat > again.toml <<'SCENE'
[emission]
lines = [17.1]
[sun]
shown = true
[[volume]]
name = "made"
file = "light.vdb"
SCENE
expect_exit 3 slices again.toml -o no.png
expect_stderr "the Sun"
expect_one_message
expect_exit 0 slices again.toml -o again.svg --set volume.made.frame=sun --voxel 2 --channel emission_171
grep -q "white is 0.2 photons" again.svg || fail "the same light again"
# Without a word about voxels some 300 to a side, of what is in the box; and of things by their names.
expect_exit 0 slices sun.toml -o usual.svg --box=-5,3,-5,3,695,703
expect_stdout "0.026 units of 1000"
rm usual.svg
cat > strands.toml <<'SCENE'
[emission]
lines = [17.1]
[sun]
shown = true
[[chromosphere]]
name = "cloud"
outerradius = 710
extinction = 0.1
[[loop]]
name = "thin"
latitude_deg = 0
longitude_deg = 0
strands = 1
spread = 0
height = 10
width = 10
strand_radius = 0.2
rayleigh = [10]
SCENE
expect_exit 0 slices strands.toml -o thin.svg --of thin
expect_stdout "density: white is 1"
expect_stdout "voxels of 0.0"
# Where something absorbs density is not light, and the first line is shown.
expect_exit 0 slices strands.toml -o dark.svg --box 695,712,-8,8,-2,2 --voxel 0.2
expect_stdout "emission_171: white is"
expect_exit 0 slices strands.toml -o cloud.svg --box 695,712,-8,8,-2,2 --voxel 0.2 --channel density
expect_stdout "density: white is"
rm thin.svg dark.svg cloud.svg
expect_exit 2 slices strands.toml -o no.png --voxel 0.5
expect_stderr "--voxel: | 'thin' | radius 0.2 | voxels of 0.5"
expect_one_message
expect_exit 2 volume strands.toml -o no.vdb --voxel 0.5
expect_stderr "--voxel: | 'thin' | radius 0.2 | voxels of 0.5"
expect_one_message
expect_exit 2 slices strands.toml -o no.png --memory-limit 0.01
expect_stderr "--memory-limit: | 0.2"
expect_stderr "--of NAME"
expect_one_message
# Refused.
for option in --voxel --memory-limit --gamma; do
  expect_exit 2 slices sun.toml -o no.png $option nan
  expect_stderr "$option"
  expect_one_message
done
expect_exit 2 slices a.vdb -o no.png --log --decades nan
expect_stderr "--decades"
expect_exit 2 slices a.vdb -o no.png --at 0,nan,0
expect_stderr "--at"
expect_exit 2 volume sun.toml -o no.vdb --voxel nan
expect_stderr "--voxel"
expect_exit 2 slices a.pbrt -o no.png --voxel 3
expect_stderr "--voxel: a.pbrt is no scene"
expect_one_message
expect_exit 2 slices a.vdb -o no.png --box 0,1,0,1,0,1
expect_stderr "--box: a.vdb is no scene"
sed 's/ [12]\b/ -1/g' a.pbrt > below.pbrt
sed -i 's/\[-1\]/[3]/g; s/p1" \[.*\]/p1" [2 2 702]/' below.pbrt
expect_exit 2 slices below.pbrt -o no.png
expect_stderr "nothing above 0"
expect_one_message
expect_exit 2 slices a.vdb -o a.png
expect_stderr "a.png"
expect_exit 2 slices a.vdb -o a.vdb
expect_one_message
expect_exit 2 slices a.vdb -o no.jpg
expect_one_message
expect_exit 2 slices a.vdb -o no.png --channel light
expect_stderr "density"
expect_one_message
expect_exit 2 slices a.vdb -o no.png --at 0,0,20
expect_stderr "--at: z = 20 is beside"
expect_one_message
expect_exit 2 slices a.vdb -o no.png --along z --at 0,0,700
expect_exit 2 slices a.vdb -o no.png --count 3
expect_exit 2 slices a.vdb -o no.png --log --gamma 2
expect_exit 2 slices a.vdb -o no.png --set sun.shown=true
expect_one_message
expect_exit 3 slices none.toml -o no.png
expect_exit 2 slices notes.doc -o no.png
expect_one_message
expect_only a.pbrt a.png a.vdb a.svg at.svg row.svg sun.toml sun.svg light.vdb again.toml again.svg strands.toml below.pbrt
