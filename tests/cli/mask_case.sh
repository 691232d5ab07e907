# Masks: drawn, by polygon, circle and line, found; what they are good for, and what is refused.
source "$(dirname "$0")/case.sh"
photo=$SOURCE/data/examples/h000/photo.jpg # 720 x 480, no stars, no ground
# A half drawn by a polygon, and what the words say of it.
expect_exit 0 mask "$photo" -o half.png --polygon 0,0 360,0 360,480 0,480 --show shown.png
expect_stdout "photo.jpg: 720 x 480 pixels, decoding: sRGB"
expect_stdout "polygon          172800 px  50.000 %"
expect_stdout ", orange"
expect_stdout "used             172800 px  50.000 %"
expect_starts half.png 89504e470d0a1a0a
expect_starts shown.png 89504e470d0a1a0a
# Two polygons are two, not one of six corners.
expect_exit 0 mask "$photo" -o two.png --polygon 0,0 10,0 10,10 0,10 --polygon 100,0 110,0 110,10 100,10
expect_stdout "polygon             200 px"
# Every command that takes a mask takes it; a band of what is left out has nothing in its rows.
expect_exit 0 profile "$photo" -o half.csv --mask half.png --bands 2
expect_exit 0 profile "$photo" -o all.csv --bands 2
grep -q '^# mask: half.png' half.csv || fail "the profile does not name its mask"
expect_different half.csv all.csv
# Drawn masks and polygons add up, twice the same bytes.
for name in a b; do
  expect_exit 0 mask "$photo" -o $name.png --draw half.png --polygon 360,0 720,0 720,240 360,240 \
    --polygon 700,400 720,400 720,480 --circle 360,240,300 --horizon 0,400 719,420 \
    --horizon-csv $name.csv --stars --hot --text --saturated
done
expect_same a.png b.png
expect_stdout "drawn            172800 px  50.000 %; 172800 px by it first"
expect_stdout "text: none"
expect_stdout "stars: 0 | 9 px"
[[ $(awk '!/^#/ && head++' a.csv | wc -l) -eq 720 ]] || fail "not a row per column of the horizon"
# By hand: the line of two points is straight.
awk -F, '!/^#/ && head++ { d = $2 - (400 + $1 * 20 / 719); if (d > 1e-9 || d < -1e-9) exit 1 }' a.csv ||
  fail "the horizon is not the line"
# No circle, no ground: said, with what to do.
expect_exit 2 mask "$photo" -o no.png --circle auto
expect_stderr "no circle"
expect_stderr "--circle X,Y,RADIUS"
expect_one_message
expect_exit 2 mask "$photo" -o no.png --horizon auto
expect_stderr "no skyline"
expect_one_message
# A mask that leaves nothing.
expect_exit 2 mask "$photo" -o no.png --circle=-900,-900,100
expect_stderr "leaves no pixel"
expect_one_message
expect_exit 2 mask "$photo" -o no.png --draw half.png --polygon 360,0 720,0 720,480 360,480
expect_stderr "leaves no pixel"
expect_one_message
# Wrong words.
expect_exit 2 mask "$photo" -o no.png
expect_stderr "nothing"
expect_exit 2 mask "$photo" -o no.png --circle 360,240
expect_stderr "--circle"
expect_exit 2 mask "$photo" -o no.png --circle 1,2,3,
expect_stderr "--circle"
expect_exit 2 mask "$photo" -o no.png --circle nan,2,3
expect_stderr "--circle"
expect_exit 2 mask "$photo" -o no.png --polygon 1,2 3,4
expect_stderr "--polygon"
expect_exit 2 mask "$photo" -o no.png --horizon 1,2
expect_stderr "--horizon"
expect_exit 2 mask "$photo" -o no.png --stars --star-sigma 0
expect_stderr "--star-sigma"
expect_exit 2 mask "$photo" -o no.png --stars --horizon-csv no.csv
expect_stderr "--horizon-csv"
expect_exit 2 mask "$photo" -o no.jpg --stars
expect_stderr "--output"
expect_one_message
expect_exit 2 mask "$photo" -o half.png --stars
expect_stderr "--overwrite"
expect_exit 2 mask "$photo" -o half.png --stars --draw half.png --overwrite
expect_stderr "an input"
expect_exit 2 mask "$photo" -o no.png --show no.png --stars
expect_stderr "another output"
# A drawn mask of another size, a photograph that is none.
expect_exit 0 render "$SCENES/small.toml" -o small.png
expect_exit 3 mask "$photo" -o no.png --draw small.png
expect_stderr small.png
expect_one_message
expect_exit 3 mask half.csv -o no.png --stars
expect_stderr half.csv
expect_one_message
expect_only a.csv a.png all.csv b.csv b.png half.csv half.png shown.png small.png two.png
# Real photographs, where they are beside the repository.
photos=${VEGARD_PHOTOS:-$SOURCE/../shared/photos}
if [[ ! -d $photos ]]; then
  echo "SKIPPED: the photographs: no $photos"
  exit 0
fi
expect_exit 0 mask "$photos/kho_nipr_20140221193040.jpg" -o kho.png --circle auto --text --stars
circle=$(sed -n 's/^circle: centre \([0-9.]*\), \([0-9.]*\), radius.*/\1 \2/p' "$stdout")
awk -v c="$circle" 'BEGIN { split(c, p, " "); exit !(p[1] > 358 && p[1] < 362 && p[2] > 234 && p[2] < 240) }' ||
  fail "the circle's centre is not near 360, 237"
[[ $(grep -c '^text: .* letters' "$stdout") -eq 4 ]] || fail "not four lines of text"
for name in trex_rgb_gill_20211030_060500.png usaf_strang_uncorrected.jpg iss029e028787_nasa.jpg \
  eclipse1999_corona.jpg independent/h001.jpg independent/h002.jpg independent/h003.jpg; do
  expect_exit 0 mask "$photos/$name" -o text.png --text --overwrite
  expect_stdout "text: none"
done
expect_exit 0 mask "$photos/usaf_strang_uncorrected.jpg" -o usaf.png --horizon auto
expect_stdout "horizon: contrast"
for name in trex_rgb_gill_20211030_060500.png kho_nipr_20140221193040.jpg iss029e028787_nasa.jpg \
  eclipse1999_corona.jpg nebula_crab_hubble.jpg; do
  expect_exit 2 mask "$photos/$name" -o no.png --horizon auto
done
