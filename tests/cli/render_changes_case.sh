# --seed and --set change the picture, and say the same as the scene file would.
source "$(dirname "$0")/case.sh"
expect_exit 0 render "$SCENES/small.toml" -o plain.exr
expect_exit 0 render "$SCENES/small.toml" -o seed.exr --seed 8
expect_different plain.exr seed.exr
expect_exit 0 render "$SCENES/small.toml" -o same_seed.exr --seed 7
expect_same plain.exr same_seed.exr
expect_exit 0 render --set sheet.main.energy_kev=6 --set 'sheet.main.center_km=[0.0, 250.0]' "$SCENES/small.toml" -o set.exr
expect_different plain.exr set.exr
scene_with 's/energy_kev = 3.0/energy_kev = 6.0/; s/center_km = .*/center_km = [0.0, 250.0]/'
expect_exit 0 render scene.toml -o edited.exr
expect_same set.exr edited.exr
expect_exit 0 render "$SCENES/small.toml" -o small.png --set camera.width=80
expect_stdout "80 x 120 pixels"
for bad in sheet.main.energy_kevv=3 sheet.main.energy_kev=-3 sheet.main.energy_kev=nan camera.width=wide; do
  expect_exit 2 render "$SCENES/small.toml" -o bad.exr --set "$bad"
  expect_one_message
done
expect_exit 2 render "$SCENES/small.toml" -o bad.exr --set sheet.main.energy_kev
expect_stderr "path=value"
[[ ! -e bad.exr ]] || fail "bad.exr was written"
