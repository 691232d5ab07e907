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
# An animation of them leaves no folder behind either.
for file in missing.exr truncated.exr large.exr; do
  expect_exit 3 animate scene/small.toml -o frames/##.png --frames 0:0 --set "march.depth=$file"
  expect_stderr "scene/$file: march.depth: "
  expect_one_message
  [[ ! -e frames ]] || fail "a folder is left"
done

# Only sheets have deflection points.
expect_exit 0 render scene/plain.toml -o some.png
expect_stdout "deflection points"
cat >scene/literal.toml <<'END'
[camera]
width = 40
height = 30
[[node]]
name = "ball"
[[nebula]]
method = "literal"
gas = "ball"
END
expect_exit 0 render scene/literal.toml -o literal.png
! grep -qF "deflection points" "$stdout" || fail "deflection points of no sheet"
# A footprint in view that is dark: not out of view, and the warning says no such thing.
cat >scene/dark.toml <<'END'
[camera]
width = 40
height = 30
azimuth_deg = 0.0
[[footprint]]
name = "black"
source = "image"
image = "black.png"
END
printf 'iVBORw0KGgoAAAANSUhEUgAAAAgAAAAICAAAAADhZOFXAAAADElEQVR42mNgoA4AAABIAAEQRe/SAAAAAElFTkSuQmCC' |
  base64 -d >scene/black.png
expect_exit 0 render scene/dark.toml -o dark.png
expect_stderr "warning: no light"
expect_stderr "'black' | azimuth 0"
expect_only add.exr dark.png large.exr literal.png plain.exr scene some.png standing.png with.exr
