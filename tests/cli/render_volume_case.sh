# How volumes meet the rest of the picture: their layer in an EXR, and the depths of what stands before them.
source "$(dirname "$0")/case.sh"
mkdir scene
cp "$SCENES/small.toml" scene/plain.toml
cp "$SCENES/small.toml" scene/small.toml
cat >>scene/small.toml <<'END'
[[footprint]]
name = "arc"
source = "spline"
shape = "box"
east_km = [-60.0, 60.0]
north_km = [150.0, 150.0]
END
expect_exit 0 render scene/plain.toml -o plain.exr --lines scene/depth.exr
expect_exit 0 render scene/small.toml -o with.exr
for channel in volume.R volume.G volume.B volume.A; do
  LC_ALL=C grep -qaF "$channel" with.exr || fail "no channel $channel"
  ! LC_ALL=C grep -qaF "$channel" plain.exr || fail "a layer of what the scene does not have"
done
expect_exit 0 render scene/small.toml -o add.exr --set march.blend=add

# The depths: a missing or damaged file, or one of another size: exit 3, its name and the key, and no output.
head -c 2000 plain.exr >scene/truncated.exr
expect_exit 0 render scene/small.toml -o large.exr --set camera.width=70
cp large.exr scene/large.exr
for file in missing.exr truncated.exr large.exr; do
  expect_exit 3 render scene/small.toml -o bad.png --set "march.depth=$file"
  expect_stderr "scene/$file: march.depth: "
  expect_one_message
done
expect_exit 0 render scene/small.toml -o standing.png --set march.depth=depth.exr
expect_only add.exr large.exr plain.exr scene standing.png with.exr
