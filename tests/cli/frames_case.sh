# Files with many frames in them, as imagers write a minute: written here by Python's gzip. A frame by number and by
# time wherever a photograph goes in, all of them where several do.
source "$(dirname "$0")/case.sh"

# write FILE [python code that changes `frames`, `size`, `words`]
write() {
  local file=$1 change=${2:-pass}
  python3 - "$file" <<EOF
import gzip, sys
size, words, first, seconds = (160, 120), [], 3, range(0, 12, 3)
pixels = lambda i: b"".join((1000 * (i + 1) + 100 * y + x % 7).to_bytes(2, "big") for y in range(120) for x in range(160))
minute, tail = "2014-03-10 06:03:", b""
$change
def frame(i, s):
    own = ['#"Site unique ID" gill', '#"Imager unique ID" themis19', '#"Geodetic latitude" 56.35',
           '#"Geodetic Longitude" -94.65'] if i == 0 else []
    own += words + [f'#"Exposure options" WIDTH={2 * size[0]} HEIGHT={size[1]} XBIN=2 YBIN=1 MSEC=999',
                    f'#"Image request start" {minute}{s:02d}.012345 UTC']
    return "\n".join(["P5", *own, f"{size[0]} {size[1]}", "65535", ""]).encode() + pixels(i)
data = b"".join(frame(i, s) for i, s in enumerate(seconds)) + tail
(gzip.open if sys.argv[1].endswith(".gz") else open)(sys.argv[1], "wb").write(data)
EOF
}
four=20140310_0603_gill_themis19_full.pgm.gz
write $four
write plain.pgm
write one.pgm.gz 'seconds = range(1)'

# What there is to choose from.
expect_exit 0 describe $four
expect_stdout "4 frames | 2014-03-10T06:03:00.012345Z | 2014-03-10T06:03:09.012345Z | gzip"
expect_stdout "#3     2014-03-10T06:03:09.012345Z  0.999 s"
expect_stdout 'site.latitude_deg = 56.35 (PGM comment "Geodetic latitude")'
! grep -q "site.time_utc" "$stdout" || fail "a time that is one frame's is told of all"
expect_exit 0 describe $four#2 -o start.toml
expect_stdout "note: | linear light is assumed; --decoding overrides"
expect_stdout 'site.time_utc = "2014-03-10T06:03:06.012345Z" (PGM comment "Image request start")'
grep -q '^exposure_s = 0.999  # PGM' start.toml || fail "the scene has no exposure"
expect_exit 2 describe $four -o other.toml
expect_stderr "one picture | 4 frames"
expect_one_message
expect_exit 0 describe one.pgm.gz
expect_stdout "2014-03-10T06:03:00.012345Z"

# One frame by its number and by its time, packed or not, is one picture.
expect_exit 0 profile $four#2 -o a.csv
expect_stdout "$four#2: | 160 x 120 | linear | 16-bit PGM"
expect_exit 0 profile $four --at 2014-03-10T06:03:05Z -o b.csv
expect_exit 0 profile plain.pgm#2014-03-10T07:03:06.5+01:00 -o c.csv
expect_same a.csv b.csv
cmp -s <(grep -v '^# photograph' a.csv) <(grep -v '^# photograph' c.csv) || fail "packed and plain frames differ"
expect_exit 0 profile $four#0 -o d.csv
expect_different a.csv d.csv
for words in "profile $four -o no.csv" "mask $four -o no.png --stars" "fit $SCENES/fit.toml --photo $four --out no" \
  "linearise $four $SCENES/small.toml -o no.exr" "map $SCENES/map.toml --photo $four --out no" "measure $four --out no" \
  "border $SCENES/small.toml --photo $four --out no" "horizon $four --points 2,12 30,13" "calibrate --image $four --stars-out no.csv"; do
  read -ra split <<<"$words"
  expect_exit 2 "${split[@]}"
  expect_stderr "4 frames, 2014-03-10T06:03:00.012345Z to 2014-03-10T06:03:09.012345Z"
  expect_one_message
done
expect_exit 2 profile $four#4 -o no.csv
expect_stderr "no frame 4"
expect_exit 3 profile $four --at 2014-03-10T06:04:00Z -o no.csv
expect_stderr "no frame"
expect_exit 2 profile $four#1 --at 2014-03-10T06:03:00Z -o no.csv
expect_stderr "a frame already"
expect_exit 2 profile $four --at noon -o no.csv
expect_stderr "--at"
expect_exit 0 render "$SCENES/small.toml" -o photo.png
expect_exit 2 profile photo.png --at 2014-03-10T06:03:00Z -o no.csv
expect_exit 2 profile photo.png#0 -o no.csv
# A frame's file is an input like any other.
cp plain.pgm kept.pgm
expect_exit 2 profile plain.pgm#1 -o plain.pgm --overwrite
expect_stderr "input as well"
expect_same plain.pgm kept.pgm

# Place, time and exposure are taken where the scene says nothing, and a scene's other time is told.
grep -v '^time_utc' "$SCENES/small.toml" >untimed.toml
expect_exit 0 profile $four#1 -o e.csv --scene untimed.toml
expect_stdout 'site.time_utc = "2014-03-10T06:03:03.012345Z" | PGM comment'
expect_exit 0 profile $four#1 -o f.csv --scene "$SCENES/small.toml"
expect_stdout "note: | 2019-09-05T22:11:12Z | 2014-03-10T06:03:03.012345Z"
cp $four 20140310_0803_gill_themis19_full.pgm.gz
expect_exit 0 describe 20140310_0803_gill_themis19_full.pgm.gz#1
expect_stdout "note: | 2014-03-10T08:03:00Z | 2014-03-10T06:03:03.012345Z"

# All frames in a keogram and in a sequence.
expect_exit 0 keogram $four -o k.csv
expect_stdout "4 pictures | 160 x 120"
expect_stdout 'the files'"'"' own (PGM comment "Image request start"); 2014-03-10T06:03:00.012Z to 2014-03-10T06:03:09.012Z'
expect_exit 0 keogram plain.pgm#3 plain.pgm#0 plain.pgm#2 plain.pgm#1 -o l.csv
cmp -s <(grep -v '^#' k.csv) <(grep -v '^#' l.csv) || fail "a file and its frames have other keograms"
printf '%s 5\n' $four >list.txt
expect_exit 2 keogram list.txt -o no.csv
expect_stderr "4 frames"
expect_exit 2 profile $four --at 2014-03-10T06:03:00Z --keogram no.csv
expect_stderr "all frames"
