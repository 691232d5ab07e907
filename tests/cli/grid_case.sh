# Grids from one format to the other, filtered on the way, and what is refused.
source "$(dirname "$0")/case.sh"
cat > a.pbrt <<'TEXT'
# Two voxels of 3 x 3 x 2.
Volume "volumegrid" "integer nx" [3] "integer ny" 3 "integer nz" [2]
  "point p0" [10 20 700] "point p1" [16 26 704]
  "color Le" [1 0.8 0.2] "float density" [ 0 0 0  0 1.5 0  0 0 0
   0 0 0  0 0 0  0 0 0.25 ]
TEXT
expect_exit 0 grid a.pbrt -o a.vdb
expect_stdout "a.vdb: | 1 bricks | 8 x 8 x 8 | 2 units | density"
expect_starts a.vdb 20424456
# The way back gives the same numbers; the empty edges of the box are gone, which OpenVDB does not know.
expect_exit 0 grid a.vdb -o back.volumegrid
grep -q '"integer nx" \[2\] "integer ny" \[2\] "integer nz" \[2\]' back.volumegrid || fail "the box"
grep -q '"point p0" \[12 22 700\] "point p1" \[16 26 704\]' back.volumegrid || fail "its place"
grep -qx '1.5 0' back.volumegrid || fail "1.5 is not there"
grep -qx '0 0.25' back.volumegrid || fail "0.25 is not there"
# From text to text the box and the colours stay.
expect_exit 0 grid a.pbrt -o b.txt
grep -q '"integer nx" \[3\] "integer ny" \[3\] "integer nz" \[2\]' b.txt || fail "the whole box"
grep -q '"color Le" \[1 0.8 0.2\]' b.txt || fail "the colour"
expect_exit 0 grid b.txt -o c.txt
expect_same b.txt c.txt
# What vegard volume writes shines again from text as from OpenVDB: each line its own light, and for pbrt a colour.
cat > arch.toml <<'TOML'
seed = 3
emission = { lines = [17.1, 19.5] }
camera = { width = 48, height = 48, hfov_deg = 0.1, azimuth_deg = 180, elevation_deg = 45 }
sensor = { response = "grey" }
[sun]
shown = true
azimuth_deg = 179.82
elevation_deg = 44.88
TOML
cp arch.toml from_vdb.toml
cp arch.toml from_text.toml
cp arch.toml from_line.toml
cat >> arch.toml <<'TOML'
[[loop]]
latitude_deg = 27
longitude_deg = 30
width = 110
height = 70
strands = 3
spread = 6
strand_radius = 8
rayleigh = [100, 30]
TOML
expect_exit 0 volume arch.toml -o arch.vdb --voxel 4
expect_exit 0 grid arch.vdb -o arch.pbrt
grep -q '"float emission_171" \[' arch.pbrt || fail "no light of 17.1 nm"
grep -q '"color Le" \[' arch.pbrt || fail "no colour of its light"
expect_exit 0 grid arch.vdb -o line.pbrt --channel emission_195
printf '[[volume]]\nfile = "arch.vdb"\nframe = "sun"\n' >> from_vdb.toml
printf '[[volume]]\nfile = "arch.pbrt"\nframe = "sun"\n' >> from_text.toml
printf '[[volume]]\nfile = "line.pbrt"\nframe = "sun"\n' >> from_line.toml
expect_exit 0 render from_vdb.toml -o vdb.exr
peaks=$(sed 's/.*peak//' "$stdout")
expect_exit 0 render from_text.toml -o text.exr
expect_stdout "peak$peaks"
expect_exit 0 render from_line.toml -o line.exr
expect_stdout "peak 0 R at 17.1 nm |${peaks##*,}"
# Filters in the order of the command line, by any number of threads; a mask of one in the middle does nothing.
(for i in $(seq 62); do echo 0; done; echo 1; for i in $(seq 62); do echo 0; done) > one.mask
expect_exit 0 grid a.pbrt -o same.txt --mask one.mask
expect_same same.txt b.txt
expect_exit 0 grid a.pbrt -o blurred.txt --blur 2 --sharpen 1 --threads 1
expect_stdout "; blur 2; sharpen 1"
expect_exit 0 grid a.pbrt -o again.txt --blur 1 --blur 1 --sharpen 1 --mask one.mask --threads 3
expect_same blurred.txt again.txt
expect_exit 0 grid a.pbrt -o other.txt --sharpen 1 --blur 2
expect_different blurred.txt other.txt
# Refused: names, outputs, masks, channels and broken files; nothing is left behind.
expect_exit 2 grid a.pbrt -o a.vdb
expect_stderr "a.vdb"
expect_exit 0 grid a.pbrt -o a.vdb --overwrite
expect_exit 2 grid a.pbrt -o a.pbrt --overwrite
expect_one_message
expect_exit 2 grid a.pbrt -o one.mask --overwrite --mask one.mask
expect_one_message
expect_exit 2 grid a.pbrt -o no.png
expect_stderr "kind of grid"
expect_one_message
expect_exit 2 grid a.vdb -o no.vdb --channel light
expect_stderr "grids: density"
expect_one_message
expect_exit 2 grid a.vdb -o no.vdb --blur 0
expect_exit 3 grid none.vdb -o no.vdb
expect_one_message
expect_exit 3 grid a.pbrt -o no.vdb --mask none.mask
expect_stderr "--mask"
expect_one_message
echo "1 2 x" > bad.mask
expect_exit 3 grid a.pbrt -o no.vdb --mask bad.mask
expect_stderr "bad.mask:1"
expect_one_message
for i in $(seq 125); do echo 1e38; done > large.mask
expect_exit 3 grid a.pbrt -o no.vdb --mask large.mask
expect_stderr "large.mask:1: | 1e38"
expect_one_message
# Weights that are allowed, too often.
for i in $(seq 125); do echo 1e6; done > many.mask
expect_exit 2 grid a.pbrt -o no.txt --mask many.mask --mask many.mask --mask many.mask --mask many.mask --mask many.mask
expect_stderr "--mask: | 'mask many.mask' | 1e30"
expect_one_message
sed 's/p0" \[10 20 700\] "point p1" \[16 26 704\]/p0" [-1e308 -1e308 -1e308] "point p1" [1e308 1e308 1e308]/' a.pbrt > wide.pbrt
expect_exit 3 grid wide.pbrt -o no.vdb
expect_stderr 'wide.pbrt:3: | p0 | -1e+308'
expect_one_message
sed 's/"integer nz" \[2\]/"integer nz" [2] "integer nz" [2]/' a.pbrt > twice.pbrt
expect_exit 3 grid twice.pbrt -o no.vdb
expect_stderr 'twice.pbrt:2: | nz | twice'
expect_one_message
head -c 200 a.pbrt > cut.pbrt
expect_exit 3 grid cut.pbrt -o no.vdb
expect_stderr "cut.pbrt:4"
expect_stderr "cut off"
expect_one_message
expect_exit 6 grid a.pbrt -o no/such/folder/out.vdb
expect_one_message
expect_only arch.toml arch.vdb arch.pbrt line.pbrt from_vdb.toml from_text.toml from_line.toml vdb.exr text.exr line.exr a.pbrt a.vdb back.volumegrid b.txt c.txt one.mask same.txt blurred.txt again.txt other.txt bad.mask large.mask many.mask wide.pbrt twice.pbrt cut.pbrt
