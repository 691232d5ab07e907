# The shipped photograph, measured: the table, its plots, and what is refused.
source "$(dirname "$0")/case.sh"
photo=$SOURCE/data/examples/h000/photo.jpg
scene=$SOURCE/data/examples/h000/scene.toml
expect_exit 0 profile "$photo" -o all.csv
expect_stdout "photo.jpg: 720 x 480 pixels, decoding: sRGB"
expect_stdout "all.csv: 24 bands of 480 rows"
grep -q '^# .*sRGB' all.csv || fail "the decoding is not in the table"
header() { awk '!/^#/ { print; exit }' "$1"; }
rows() { awk '!/^#/ && head++' "$1"; }
[[ $(header all.csv) == band,row_px,* ]] || fail "the table's head is: $(header all.csv)"
[[ $(rows all.csv | wc -l) -eq $((24 * 480)) ]] || fail "not a row for every row and band"
expect_exit 0 profile "$photo" -o again.csv
expect_same all.csv again.csv
# Region and bands.
expect_exit 0 profile "$photo" -o part.csv --roi 100,50,300,200 --bands 6
expect_stdout "part.csv: 6 bands of 200 rows"
[[ $(rows part.csv | wc -l) -eq $((6 * 200)) ]] || fail "not a row for every row and band of the region"
# With the camera every row has its elevation, which falls from the top to the bottom.
expect_exit 0 profile "$photo" -o high.csv --scene "$scene" --bands 1
column=$(header high.csv | awk -F, '{ for (i = 1; i <= NF; ++i) if ($i == "elevation_deg") print i }')
[[ -n $column ]] || fail "no column of elevations"
[[ -z $(rows all.csv | cut -d, -f"$column" | sort -u) ]] || fail "an elevation without a camera"
rows high.csv | awk -F, -v c="$column" '
  $c !~ /^-?[0-9]+(\.[0-9]+)?$/ { print "row " NR ": elevation \"" $c "\""; exit 1 }
  NR > 1 && $c >= last { print "row " NR ": not below the one before"; exit 1 }
  { last = $c }' >&2 || fail "the elevations are not filled"
# Plots, by their first bytes.
expect_exit 0 profile "$photo" -o one.csv --plot profile.svg
expect_stdout profile.svg
grep -q '^<svg' profile.svg || fail "no SVG"
expect_exit 0 profile "$photo" -o two.csv --plot profile.png
expect_starts profile.png 89504e470d0a1a0a
# A mask of another size.
expect_exit 0 render "$SCENES/small.toml" -o small.png
expect_exit 3 profile "$photo" -o no.csv --mask small.png
expect_stderr small.png
expect_one_message
# What is asked of the command line.
expect_exit 2 profile "$photo" -o no.csv --roi 700,0,100,100
expect_stderr "--roi"
expect_one_message
expect_exit 2 profile "$photo" -o no.csv --bands 1000
expect_stderr "--bands"
expect_exit 2 profile "$photo" -o no.csv --plot no.gif
expect_stderr "--plot"
expect_exit 2 profile "$photo" -o no.csv --scene "$SCENES/small.toml"
expect_stderr camera.width
# An output that exists is left alone, unless told otherwise; nor is the photograph ever overwritten.
echo precious >precious.csv
expect_exit 2 profile "$photo" -o precious.csv
expect_stderr precious.csv
expect_stderr "--overwrite"
expect_exit 2 profile "$photo" -o no.csv --plot precious.csv
[[ $(cat precious.csv) == precious ]] || fail "a file was overwritten"
expect_exit 0 profile "$photo" -o precious.csv --overwrite
expect_same precious.csv all.csv
cp "$photo" own.jpg
expect_exit 2 profile own.jpg -o own.jpg --overwrite
expect_same own.jpg "$photo"
# An image that is cut short, and a folder that is missing.
head -c 20000 "$photo" >truncated.jpg
expect_exit 3 profile truncated.jpg -o no.csv
expect_stderr truncated.jpg
expect_one_message
expect_exit 6 profile "$photo" -o nowhere/no.csv
expect_stderr nowhere
expect_one_message
expect_only again.csv all.csv high.csv one.csv own.jpg part.csv precious.csv profile.png profile.svg small.png \
  truncated.jpg two.csv
