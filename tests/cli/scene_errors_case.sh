# A scene that cannot be used: exit 2, and one message with file, line and what would be right.
source "$(dirname "$0")/case.sh"
line_of() { grep -n -m1 -- "$1" scene.toml | cut -d: -f1; }
expect_refusal() {  # TEXT_OF_THE_LINE WORDS...
  local line
  line=$(line_of "$1")
  shift
  expect_exit 2 render scene.toml -o out.exr
  expect_stderr "scene.toml:$line"
  for words in "$@"; do expect_stderr "$words"; done
  expect_one_message
  [[ ! -e out.exr ]] || fail "out.exr was written"
}
scene_with 's/^energy_kev/energy_kevs/'
expect_refusal energy_kevs energy_kevs "'energy_kev'"
scene_with 's/^\[camera\]/[kamera]/'
expect_refusal kamera camera
scene_with 's/^energy_kev = .*/energy_kev = nan/'
expect_refusal 'energy_kev = nan' energy_kev
scene_with 's/^energy_kev = .*/energy_kev = "three"/'
expect_refusal '"three"' energy_kev number
scene_with 's/^width = 160/width = 160.5/'
expect_refusal '160.5' width
scene_with 's/^length_km = .*/length_km = -330.0/'
expect_refusal 'length_km = -' length_km
scene_with 's/^center_km = .*/center_km = [20.0, inf]/'
expect_refusal 'inf' center_km
scene_with 's/^center_km = .*/center_km = [20.0]/'
expect_refusal 'center_km' center_km
scene_with 's/^seed = 7/seed = /'
expect_exit 2 render scene.toml -o out.exr
expect_stderr "scene.toml:"
expect_exit 3 render missing.toml -o out.exr
expect_stderr missing.toml
# What would exhaust the parser, or the search for a name that is meant, is refused at once.
parts=a$(printf '.a%.0s' $(seq 50000))
printf 'seed = 1\n%s = 1\n' "$parts" >parts.toml
printf '[fit]\nfree = %s\n' "$(printf '[%.0s' $(seq 50000))" >deep.toml
printf '[[fit.photo]]\nfile = "a.png"\nset = { %s = 1 }\n' "$parts" >set.toml
{ printf 'k%.0s' $(seq 100000); echo ' = 1'; } >long.toml
for refusal in "parts.toml:2: a key has more than 32 parts" "deep.toml:2: arrays and tables are nested more than 32 deep" \
               "set.toml:3: a key has more than 32 parts" "long.toml:1: a key is longer than 256 bytes"; do
  expect_exit 2 render "${refusal%%:*}" -o out.exr
  expect_stderr "$refusal"
  expect_one_message
  expect_exit 2 render "$SCENES/small.toml" --camera "${refusal%%:*}" -o out.exr
  expect_stderr "$refusal"
done
expect_exit 2 render "$SCENES/small.toml" -o out.exr --set "camera.width=$(printf '[%.0s' $(seq 50000))"
expect_stderr "camera.width: | 32 deep"
expect_exit 2 render "$SCENES/small.toml" -o out.exr --set "sensor.$(printf 'k%.0s' $(seq 100000))=1"
# A picture for a scene is told to be one, with what makes a scene of it.
cp "$SOURCE/data/examples/h000/photo.jpg" photo.jpg
for words in "fit photo.jpg" "fit photo.jpg --photo photo.jpg --out run" "render photo.jpg -o out.png" \
  "render $SCENES/small.toml --camera photo.jpg -o out.png" "params photo.jpg"; do
  # shellcheck disable=SC2086
  expect_exit 2 $words
  expect_stderr "photo.jpg: | JPEG"
  expect_stderr "'vegard measure photo.jpg'"
  expect_stderr "'vegard describe photo.jpg -o scene.toml'"
  expect_one_message
done
