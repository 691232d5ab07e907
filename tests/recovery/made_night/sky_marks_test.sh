#!/bin/bash
# Kinds of sky of real pictures against marks by eye: sky_marks_test.sh SKY_TABLE MARKS. Skips (77) without VEGARD_PHOTOS.
# The weights have seen these pictures (scripts/learn_kinds.py --validate judges unseen cameras): this test notices that
# features or weights have changed for the worse.
set -u
table=$1 marks=$2
if [ -z "${VEGARD_PHOTOS:-}" ] || [ ! -d "$VEGARD_PHOTOS/skies" ]; then
  echo "skipped: no folder of photographs (VEGARD_PHOTOS)"
  exit 77
fi
out=$(mktemp) || exit 1
trap 'rm -f "$out"' EXIT
"$table" --marks "$marks" --photos "$VEGARD_PHOTOS" -o "$out" || exit 1
# Aurora or none in 90 %, and the kind in three quarters of the pictures.
awk -F, 'NR > 1 {
  found = $(NF - 2); split($3, words, "|"); n++
  aurora = "|overhead|rayed|several_arcs|one_arc|diffuse|"
  both += (index(aurora, "|" found "|") > 0) == (index(aurora, "|" words[1] "|") > 0)
  if (index("|" $3 "|", "|" found "|")) right++
  else print "not so: " $1 " is " $3 ", found " found " (" $(NF - 1) ")"
} END {
  printf "kind right in %d, aurora or none in %d of %d pictures\n", right, both, n
  exit !(n > 0 && both >= 0.9 * n && right >= 0.75 * n)
}' "$out"
