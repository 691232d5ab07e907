# False colour is of display files alone, and grey light needs no eye.
source "$(dirname "$0")/case.sh"
cat > ball.toml <<'SCENE'
[camera]
width = 24
height = 16
hfov_deg = 1
azimuth_deg = 180
elevation_deg = 45
[sun]
shown = true
azimuth_deg = 180
elevation_deg = 45
photosphere_rayleigh = [200]
[emission]
lines = [17.1]
[sensor]
response = "grey"
gain_per_kilorayleigh = 1
tone = "linear"
SCENE
render() { local out=$1; shift; expect_exit 0 render ball.toml -o "$out" "$@"; }
render grey.png
render gold.png --set sensor.colour_table=171
render grey.exr
render gold.exr --set sensor.colour_table=171
expect_different grey.png gold.png
# The scene is in the file's metadata: the pixels are what must not differ.
expect_exit 0 profile grey.exr -o grey.csv
expect_exit 0 profile gold.exr -o gold.csv
numbers() { grep -v '^# ' "$1" > "$1.numbers"; }
for csv in grey gold; do numbers $csv.csv; done
expect_same grey.csv.numbers gold.csv.numbers
# A table of one's own that says the same as none.
printf 'grey,red,green,blue\n0,0,0,0\n1,1,1,1\n' > own.csv
render own.png --set sensor.colour_table=own.csv
expect_exit 0 profile own.png -o own_profile.csv
expect_exit 0 profile grey.png -o grey_profile.csv
for csv in own grey; do numbers ${csv}_profile.csv; done
expect_same own_profile.csv.numbers grey_profile.csv.numbers
# Refused, before any work.
expect_exit 2 render ball.toml -o no.png --set sensor.colour_table=17
expect_stderr '"171"'
expect_one_message
printf 'grey,red,green,blue\n0,0,0,0\n1,1,2,1\n' > bad.csv
expect_exit 3 render ball.toml -o no.png --set sensor.colour_table=bad.csv
expect_stderr "bad.csv:3"
expect_one_message
expect_only ball.toml grey.png gold.png grey.exr gold.exr grey.csv gold.csv own.csv own.png own_profile.csv grey_profile.csv bad.csv \
  grey.csv.numbers gold.csv.numbers own_profile.csv.numbers grey_profile.csv.numbers
