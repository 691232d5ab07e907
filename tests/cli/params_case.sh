# vegard params: the listing, the page, and how it refuses.
set -eu
vegard=$1
source=$2

fail() {
  echo "FAILED: $*" >&2
  exit 1
}

# expect_exit CODE PART COMMAND...: the exit code, and one line "vegard: …PART…" on the error stream.
expect_exit() {
  local code=$1 part=$2 got=0
  shift 2
  "$@" > out.txt 2> err.txt || got=$?
  [ "$got" = "$code" ] || fail "$* gave $got, not $code: $(cat err.txt)"
  [ "$code" = 0 ] && return
  [ "$(wc -l < err.txt)" = 1 ] || fail "$*: more than one line: $(cat err.txt)"
  grep -q "^vegard: " err.txt || fail "$*: $(cat err.txt)"
  grep -qF -- "$part" err.txt || fail "$*: no '$part' in: $(cat err.txt)"
}

expect_exit 0 "" "$vegard" params
grep -q '^sheet\.<name>\.energy_kev  *3\.0  *keV  *0\.1 to 20  *can be  *characteristic energy' out.txt ||
  fail "the listing lacks the energy"
grep -q '^sheet\.<name>\.start_km ' out.txt || fail "the listing lacks the alternative forms"

"$vegard" params --markdown > parameters.md
diff -u "$source/docs/parameters.md" parameters.md ||
  fail "docs/parameters.md is out of date: vegard params --markdown > docs/parameters.md"

expect_exit 0 "" "$vegard" params --forms
diff -u "$source/docs/forms.md" out.txt || fail "docs/forms.md is out of date: vegard params --forms > docs/forms.md"

cat > scene.toml <<'SCENE'
[[sheet]]
name = "arc"
energy_kev = 4.25
[fit]
free = ["sheet.arc.energy_kev"]
SCENE
expect_exit 0 "" "$vegard" params scene.toml
grep -q '^sheet\.arc\.energy_kev  *4\.25  *keV  *0\.1 to 20  *yes ' out.txt || fail "no value of the scene"
grep -q '^blur\.width_deg\.5577  *0\.18 ' out.txt || fail "no component by its line"

cat > tied.toml <<'SCENE'
[[sheet]]
[fit]
free = ["sheet.main.width_km", { name = "t", start = 2, min = 1, max = 9 }]
tied = [{ path = "sheet.main.thickness_km", equals = "t + sheet.width_km" }]
SCENE
expect_exit 0 "" "$vegard" params tied.toml
grep -q '^sheet\.main\.width_km .* yes ' out.txt || fail "a free parameter is not listed as free"
grep -q '^sheet\.main\.thickness_km .* tied ' out.txt || fail "a tied parameter is not listed as tied"
sed -i 's/t + sheet/t + shet/' tied.toml
expect_exit 2 "tied.toml:4: sheet.main.thickness_km: the expression has an unknown name, 'shet.width_km'" "$vegard" \
  params tied.toml

echo 'sede = 1' > bad.toml
expect_exit 2 "bad.toml:1: sede: unknown key 'sede'; did you mean 'seed'?" "$vegard" params bad.toml
expect_exit 3 "there is no such file" "$vegard" params missing.toml
expect_exit 3 "is a directory" "$vegard" params .
expect_exit 2 "SCENE excludes --markdown" "$vegard" params scene.toml --markdown
expect_exit 2 "excludes" "$vegard" params scene.toml --forms
expect_exit 2 "--loud" "$vegard" params --loud
expect_exit 2 "parms" "$vegard" parms
expect_exit 2 "which subcommand" "$vegard"
if [ -w /dev/full ]; then
  got=0
  "$vegard" params > /dev/full 2> err.txt || got=$?
  [ "$got" = 6 ] || fail "a full disk gave $got"
fi

expect_exit 0 "" "$vegard" --version
for name in vegard Ceres OpenCV Eigen; do
  grep -q "^$name [0-9][0-9.]*" out.txt || fail "--version lacks $name"
done
