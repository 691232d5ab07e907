# Maps over time: their files, a curtain that is followed, the same bytes for any number of threads and after an interruption,
# and refusals.
source "$(dirname "$0")/case.sh"
small=(--set camera.width=48 --set camera.height=32)
expect_exit 0 animate "$SCENES/map_light.toml" --frames 0:2 -o frames/####.png --set time.frames_per_second=0.1 \
  --set 'footprint.band.drift_km_s=[0.0,0.3]' "${small[@]}"
# The sensor is not calibrated, so that the flux of each frame is relative.
expect_exit 5 map "$SCENES/map.toml" "${small[@]}" --sequence frames/*.png --step 10 --out run --replicates 2 --sparsity 16 --threads 2
for file in map_sequence.json precipitation.nc tracks.csv frames.csv report.html; do expect_file "run/$file"; done
grep -q "^track,frame,time_s,curtain,length_km," run/tracks.csv || fail "another head of the table"
[[ $(wc -l <run/frames.csv) -eq 4 ]] || fail "not a row for each of three frames"
grep -q '"kind": "vegard map --sequence"' run/map_sequence.json || fail "no kind"
# The arc is in all frames, and moves away at 0.3 km/s; a velocity is known to some 0.1 km/s from three small pictures.
[[ $(grep -c "^1," run/tracks.csv) -eq 3 ]] || fail "the arc was not followed"
awk -F, '$1 == 1 { v = $19 } END { exit !(v > 0.0 && v < 0.6) }' run/tracks.csv || fail "another velocity to the north"

# An existing sequence stays.
cp run/tracks.csv before.csv
expect_exit 2 map "$SCENES/map.toml" "${small[@]}" --sequence frames/*.png --step 10 --out run
expect_one_message
expect_same run/tracks.csv before.csv

# Cut off by Ctrl-C and gone on with, on one thread: the same bytes.
set -m
"$VEGARD" map "$SCENES/map.toml" "${small[@]}" --sequence frames/*.png --step 10 --out cut --replicates 2 --sparsity 16 --threads 1 \
  >"$stdout" 2>"$stderr" &
interrupt $!
[[ $status -eq 130 || $status -eq 5 ]] || fail "exit $status instead of 130"
if [[ $status -eq 130 ]]; then
  [[ ! -e cut ]] || fail "something of a sequence that was cut off"
  expect_exit 5 map "$SCENES/map.toml" "${small[@]}" --sequence frames/*.png --step 10 --out cut --replicates 2 --sparsity 16 \
    --threads 1 --resume
fi
for file in tracks.csv frames.csv; do expect_same "run/$file" "cut/$file"; done

# Refusals, each in one line.
printf 'frames/0001.png 10\nframes/0000.png 10\n' >list.txt
expect_exit 2 map "$SCENES/map.toml" "${small[@]}" --sequence list.txt --out none
expect_one_message
expect_stderr "--sequence"
expect_exit 2 map "$SCENES/map.toml" "${small[@]}" --sequence frames/*.png --out none
expect_one_message
expect_stderr "--step"
expect_exit 2 map "$SCENES/map.toml" "${small[@]}" --sequence frames/*.png --photo frames/0000.png --out none
expect_stderr "--photo"
expect_exit 2 map "$SCENES/map.toml" "${small[@]}" --sequence frames/*.png --out none --step 10 \
  --set 'fit.free=[{path="camera.azimuth_deg",prior={mean=0.0,sigma=0.1}}]'
expect_stderr "fit.free"
expect_exit 2 map "$SCENES/map.toml" "${small[@]}" --sequence frames/0000.png --out none
expect_stderr "two pictures"

# The stars tell whether the camera stood still.
larger=(--set camera.width=300 --set camera.height=200)
starry=(--set site.longitude_deg=20 --set stars.shown=true --set 'stars.source="catalogue"' --set stars.gain=20)
sky() {
  expect_exit 0 render "$SCENES/map_light.toml" "${larger[@]}" "${starry[@]}" \
    --set "site.time_utc=\"2021-01-10T20:00:$2Z\"" -o "sky_$1.png" "${@:3}"
}
sky 0 00
sky 1 10
sky 2 20 --set camera.azimuth_deg=2
sky 3 30 --set camera.azimuth_deg=2
expect_exit 3 map "$SCENES/map.toml" "${larger[@]}" --sequence sky_?.png --step 10 --out none
expect_one_message
expect_stderr "sky_2.png: the camera was turned by 2"
[[ ! -e none && ! -e none.part ]] || fail "something was left of a sequence that was refused"
