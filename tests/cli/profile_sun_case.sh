# Profiles that are no columns: across a loop of the Sun, and away from its limb.
source "$(dirname "$0")/case.sh"
expect_exit 0 render "$SCENES/loop.toml" -o loop.png
header() { awk '!/^#/ { print; exit }' "$1"; }
rows() { awk '!/^#/ && head++' "$1"; }
expect_exit 0 profile loop.png --scene "$SCENES/loop.toml" -o loop.csv --plot loop.svg
expect_stdout "loop.csv: 4 bands of 12 positions"
[[ $(header loop.csv) == band,band_at,at,r,g,b,* ]] || fail "the table's head is: $(header loop.csv)"
[[ $(rows loop.csv | wc -l) -eq $((4 * 12)) ]] || fail "not a row for every bin"
# Positions run across, from left to right, of grey light one channel is measured, and the loop is brightest
# in the middle half of its bins.
rows loop.csv | awk -F, '
  $3 != -5.5 + (NR - 1) % 12 { print "row " NR ": at " $3; exit 1 }
  $4 != "" || $6 != "" || $10 != 0 || $12 != 0 { print "row " NR ": grey light as three colours"; exit 1 }
  $5 > most[$1] { most[$1] = $5; place[$1] = $3 }
  END { for (b in place) if (place[b] < -3 || place[b] > 3) { print "band " b ": brightest at " place[b]; exit 1 } }
' >&2 || fail "the table is not of the loop"
grep -q 'distance across the loop (px)' loop.svg || fail "the plot does not say what it is over"
! grep -q '>red<' loop.svg || fail "grey light is plotted as a colour"
# Lines are told along columns only.
expect_exit 2 profile loop.png --scene "$SCENES/loop.toml" -o no.csv --lines
expect_stderr "--lines"
expect_one_message
# Sectors about the limb.
sed -e 's/"loop"$/"limb"/' -e '/^guide_/d' -e 's/^\[fit\]/&\nlimb_lowest = 0.4\nlimb_highest = 0.9\nlimb_step = 0.1/' \
  "$SCENES/loop.toml" >limb.toml
expect_exit 0 profile loop.png --scene limb.toml -o limb.csv
expect_stdout "limb.csv: 4 bands of 5 positions"
rows limb.csv | awk -F, '$2 != 45 + 90 * $1 { print "band " $1 " at " $2; exit 1 }' >&2 || fail "not four sectors"
