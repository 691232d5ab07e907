# What is no picture, mask, map, camera or list: one message with the file, the documented exit, and no output.
source "$(dirname "$0")/case.sh"
export LC_ALL=C
expect_exit 0 render "$SCENES/small.toml" -o photo.png
cp photo.png second.png

# refused CODE WORDS ARGUMENTS...
refused() {
  local code=$1 words=$2
  shift 2
  expect_exit "$code" "$@"
  expect_stderr "$words"
  expect_one_message
}

# Headers that lie: also of those nothing is heard but the one message, though the decoders would have it otherwise.
number() { printf "\\x$(printf %02x $(($1 >> 8)))\\x$(printf %02x $(($1 & 255)))"; }
ppm() { printf 'P6 %s 255\n%s' "$1" "$2"; }
ppm "40000 40000" abc >huge.ppm
ppm "0 1" abc >none.ppm
ppm "1 1" ab >short.ppm
{ head -c 20 photo.png; printf '\377'; tail -c +22 photo.png; } >crc.png
{ printf 'SIMPLE  = %20s%50s' T ''; printf 'BITPIX  = %20s%50s' 16 ''; printf 'NAXIS   = %20s%50s' 2 ''
  printf 'NAXIS1  = %20s%50s' 40000 ''; printf 'NAXIS2  = %20s%50s' 40000 ''; printf 'END%2477s' ''; } >huge.fits
{ printf 'II\x2a\0\x08\0\0\0\x03\0'; printf '\0\x01\x04\0\x01\0\0\0\x40\x9c\0\0\x01\x01\x04\0\x01\0\0\0\x40\x9c\0\0'
  printf '\x02\x01\x03\0\x01\0\0\0\x08\0\0\0\0\0\0\0'; } >huge.tif
{ printf '\377\330\377\300\0\x0b\x08'; number 40000; number 40000; printf '\x01\x01\x11\0\377\332\0\x08\x01\x01\0\0\x3f\0\0\377\331'; } >huge.jpg
refused 3 "huge.ppm: | 40000 x 40000 | 2^28" profile huge.ppm -o no.csv
refused 3 "huge.fits: | 40000 x 40000 | 2^28" profile huge.fits -o no.csv
refused 3 "huge.jpg: | 40000 x 40000 | 2^28" profile huge.jpg -o no.csv
refused 3 "huge.tif: " profile huge.tif -o no.csv
refused 3 "none.ppm: | 0 x 1" profile none.ppm -o no.csv
refused 3 "short.ppm: | truncated" profile short.ppm -o no.csv
refused 3 "crc.png: | checksum" profile crc.png -o no.csv
# A PNG whose rows are not all there, and whose checksums are right: libpng itself would have a word to say.
{ head -c 8 photo.png; printf '\0\0\0\x0dIHDR\0\0\0\x02\0\0\0\x02\x08\x02\0\0\0\xfd\xd4\x9a\x73'
  printf '\0\0\0\0IDAT\x35\xaf\x06\x1e\0\0\0\0IEND\xae\x42\x60\x82'; } >hollow.png
for command in "profile hollow.png -o no.csv" "mask hollow.png -o no.png --saturated" \
  "keogram hollow.png photo.png -o no.csv" "fit $SCENES/fit.toml --photo hollow.png --out no"; do
  # shellcheck disable=SC2086
  refused 3 "hollow.png: | decoded" $command
done

# A mask that is all black: of a photograph that is as dark, and of polygons.
expect_exit 0 render "$SCENES/small.toml" -o black.png --set 'sky.level=[0.0, 0.0, 0.0]' --set camera.azimuth_deg=180
expect_exit 0 render "$SCENES/small.toml" -o small.png --set camera.width=80
for mask in black.png small.png; do
  refused 3 "$mask: the mask " profile photo.png --mask "$mask" -o no.csv
  refused 3 "$mask: the mask " mask photo.png --draw "$mask" -o no.png
  refused 3 "$mask: the mask " fit "$SCENES/fit.toml" --photo photo.png --mask "$mask" --out no
  refused 3 "$mask: the mask " keogram photo.png second.png --mask "$mask" -o no.csv
done
refused 2 "no pixel | photo.png" mask photo.png --polygon 0,0 160,0 160,120 0,120 -o no.png

# Maps of another size.
expect_exit 0 directions "$SCENES/small.toml" -o maps.exr --set camera.width=80
refused 3 "maps.exr: | 80 x 120 | 160 x 120" keogram photo.png second.png \
  --azimuth-map maps.exr -o no.csv
refused 3 "maps.exr: | 80 x 120 | 160 x 120" profile photo.png --azimuths 0 10 \
  --azimuth-map maps.exr -o no.csv
refused 3 "photo.png: " keogram photo.png second.png --azimuth-map photo.png -o no.csv

# Files that are no cameras.
: >empty.toml
echo 'a letter' >letter.toml
printf '[[sheet]]\nenergy_kev = 3.0\n' >sheet.toml
refused 2 "empty.toml: | [camera] | [site]" render "$SCENES/small.toml" \
  --camera empty.toml -o no.png
refused 2 "letter.toml:1: " render "$SCENES/small.toml" --camera letter.toml -o no.png
refused 2 "sheet.toml:2: " render "$SCENES/small.toml" --camera sheet.toml -o no.png
refused 2 "photo.png: | picture" render "$SCENES/small.toml" --camera photo.png -o no.png
refused 3 "nowhere.toml: | no such file" render "$SCENES/small.toml" --camera nowhere.toml -o no.png
# A lens whose terms fold the picture back has an edge there, as a fisheye has, and nothing beyond it.
expect_exit 0 directions "$SCENES/small.toml" -o plain.exr
expect_exit 0 directions "$SCENES/small.toml" -o folded.exr --set camera.k1=-5
expect_different plain.exr folded.exr
refused 2 "camera.k1" render "$SCENES/small.toml" -o no.png --set camera.k1=nan

# Lists without a picture.
: >empty.txt
echo '# none yet' >remark.txt
for list in empty.txt remark.txt; do
  refused 3 "$list: | no photograph" keogram "$list" -o no.csv
  refused 3 "$list: | no photograph" profile "$list" --keogram no.png
done

# Fewer stars than parameters; stars that are none.
printf 'name,azimuth_deg,zenith_deg,x_px,y_px\na,0,10,1,2\nb,90,20,10,20\n' >two.csv
refused 3 "two.csv: | 2 stars | 6 numbers" calibrate two.csv -o no.toml --size 64,48
head -1 two.csv >none.csv
refused 3 "none.csv: " calibrate none.csv -o no.toml --size 64,48
refused 3 "photo.png" calibrate photo.png -o no.toml --size 64,48
expect_only black.png crc.png empty.toml empty.txt folded.exr hollow.png huge.fits huge.jpg huge.ppm huge.tif \
  letter.toml maps.exr none.csv none.ppm photo.png plain.exr remark.txt second.png sheet.toml short.ppm small.png two.csv
