# vegard tables --ensemble: three draws give three modes, which carry all of their variance, and bear what the tables alone do not.
source "$2/tests/cli/case.sh"

expect_exit 0 tables -o drawn --atmosphere "$SOURCE/data/emission/atmosphere.csv" --oxygen-factors 1 --ensemble 3 --seed 2 --json
cp "$stdout" answer.json
expect_only answer.json drawn
python3 - <<'PYTHON' || fail "the modes"
import csv
import json
import math

with open("answer.json", encoding="utf-8") as file:
    modes = json.load(file)["modes"]
with open("drawn/about.json", encoding="utf-8") as file:
    about = json.load(file)
with open("drawn/modes.csv", encoding="utf-8") as file:
    rows = list(csv.DictReader(file))
assert (about["mode_draws"], about["mode_seed"]) == (3, 2)
# Draws are independent, so that three span three directions; their principal components miss nothing but rounding.
assert modes["count"] == 3 and math.isclose(modes["carried_share"], 1.0, abs_tol=1e-9), modes
assert {row["mode"] for row in rows} == {"1", "2", "3"}
for name in rows[0]:
    if name.startswith("ver_"):
        assert all(any(float(row[name]) for row in rows if row["mode"] == mode) for mode in "123"), name
PYTHON

# The green line is a third brighter than these tables have it, which is no surprise: it is known to some 40 %.
three=(--tables drawn --line 427.8=2300±1% --line 557.7=12800±1% --line 630.0=330±1%)
expect_exit 5 invert "${three[@]}" --uncertainty none
expect_exit 0 invert "${three[@]}" --json
grep -qF '"sigma_ln_of_tables"' "$stdout" || fail "no corrections of the tables"
