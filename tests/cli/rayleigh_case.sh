# A camera that counts: its pictures in rayleighs (linearise --rayleigh), and its factor by stars (photometry), on a
# picture of the sky's own stars that is made here.
source "$(dirname "$0")/case.sh"

cat >counts.toml <<'EOF'
name = "made"
dark_counts = 100.0
gain_e_per_count = 1.0
[[filter]]
name = "green"
line_nm = 557.7     # of atomic oxygen
width_nm = 2.0
width_error = 0.03
[[filter]]
name = "blue"
line_nm = 427.8
rayleigh_per_count_s = 69.8
rayleigh_per_count_s_error = 3.49
EOF

# 8 x 2 pixels of 100 + 10 i counts, two seconds: (10 i / 2) counts per second.
python3 - <<'EOF'
open("p.pgm", "wb").write(b"P5 8 2 65535\n" + b"".join((100 + 10 * i).to_bytes(2, "big") for i in range(16)))
EOF
expect_exit 0 linearise p.pgm --rayleigh counts.toml --filter blue --exposure 2 -o p.fits
expect_stdout "8 x 2 | 427.8 nm | 2 s"
expect_stdout "known to 5.0 %"
expect_exit 0 linearise p.pgm --rayleigh counts.toml --filter blue --exposure 2 -o p.exr
python3 - <<'EOF'
import struct
data = open("p.fits", "rb").read()
cards = {data[i:i + 8].strip(): data[i + 10:i + 80] for i in range(0, 5760, 80)}
end = next(i for i in range(0, len(data), 80) if data[i:i + 80].strip() == b"END")
begin = (end // 2880 + 1) * 2880
assert b"'R" in cards[b"BUNIT"] and abs(float(cards[b"SCALEERR"].split(b"/")[0]) - 0.05) < 1e-9, cards
values = struct.unpack(">32f", data[begin:begin + 128])
# The upper row is the last that is stored.
for i in range(16):
    at = (8 if i < 8 else 0) + i % 8
    assert abs(values[at] - 69.8 * 5 * i) < 1e-2, (i, values)
    assert abs(values[16 + at] - 69.8 / 2 * (10 * i + 1 / 12) ** 0.5) < 1e-2, (i, values)
EOF
# What is in rayleighs goes on to where brightnesses go.
expect_exit 0 invert --map 427.8=p.fits --map 557.7=p.fits --error 427.8=5% --error 557.7=5% --relative-error 5 -o map.fits

# What is wrong is told once, with file and line, and nothing is written.
expect_exit 2 linearise p.pgm --rayleigh counts.toml --exposure 2 -o no.fits
expect_stderr "green, blue"
expect_one_message
expect_exit 2 linearise p.pgm --rayleigh counts.toml --filter green --exposure 2 -o no.fits
expect_stderr "counts.toml:4: filter.rayleigh_per_count_s"
expect_stderr "vegard photometry"
expect_one_message
expect_exit 3 linearise p.pgm --rayleigh counts.toml --filter blue -o no.fits
expect_stderr "exposed"
expect_exit 2 linearise p.pgm --rayleigh counts.toml --filter blue --exposure 2 -o no.png
expect_exit 2 linearise p.pgm "$SCENES/small.toml" --rayleigh counts.toml --filter blue --exposure 2 -o no.fits
expect_exit 2 linearise p.pgm -o no.exr
expect_stderr "no scene"
expect_exit 2 linearise p.pgm --rayleigh counts.toml --filter blue --exposure 2 -o p.fits
expect_stderr "p.fits"
sed 's/width_nm/wdth_nm/' counts.toml >typo.toml
expect_exit 2 linearise p.pgm --rayleigh typo.toml --filter blue --exposure 2 -o no.fits
expect_stderr "typo.toml:7: filter.wdth_nm: unknown key"
expect_one_message
[[ ! -e no.fits && ! -e no.exr && ! -e no.png ]] || fail "something was written"

# The sky's own stars (made_stars.py): a count per second is 25 R, 0.3 magnitudes are lost in an airmass.
python3 "$SOURCE/tests/cli/made_stars.py" "$SOURCE/data/stars/bright_stars.csv"
when="--filter green --camera camera.toml --exposure 200 --time 2000-01-01T12:00:00Z"
# shellcheck disable=SC2086
expect_exit 0 photometry counts.toml stars.pgm $when -o found.toml --stars-out stars.csv
expect_stdout "by the stars"
expect_stdout "their spectra 2.0 %"
python3 - <<'EOF'
import csv, re
text = open("found.toml").read()
assert "# of atomic oxygen" in text
factor = float(re.search(r"rayleigh_per_count_s = ([\d.]+)", text).group(1))
error = float(re.search(r"rayleigh_per_count_s_error = ([\d.]+)", text).group(1))
# The stars' own error is 3 %, with those of spectra and width (2 and 3 %) beside it; the picture has neither of these.
assert abs(factor / 25.0 - 1) < 0.09, factor
assert 0.037 < error / factor < 0.08, error
rows = list(csv.DictReader(open("stars.csv")))
# Of the 5044 stars of the catalogue many stand in the circle of one that could be measured, which then is not.
assert 20 < sum(row["used"] == "1" for row in rows) < 60, rows
EOF
# shellcheck disable=SC2086
expect_exit 0 photometry counts.toml stars.pgm $when --extinction 0.3
expect_stdout "0.3 magnitudes"
expect_exit 0 linearise stars.pgm --rayleigh found.toml --filter green --exposure 200 -o light.fits

# Bright noise has no stars that agree: told, and nothing is written.
python3 - <<'EOF'
import random
random.seed(5)
open("noise.pgm", "wb").write(b"P5 384 384 65535\n" + b"".join(random.randrange(20000, 30000).to_bytes(2, "big") for i in range(384 * 384)))
EOF
# shellcheck disable=SC2086
expect_exit 5 photometry counts.toml noise.pgm $when -o no.toml
expect_stderr "not determine"

# shellcheck disable=SC2086
expect_exit 3 photometry counts.toml empty.pgm $when -o no.toml
expect_stderr "agree on nothing"
expect_one_message
# shellcheck disable=SC2086
expect_exit 2 photometry counts.toml stars.pgm $when -o found.toml
expect_stderr "found.toml"
expect_exit 2 photometry counts.toml stars.pgm --filter blue --camera camera.toml --exposure 200 --time 2000-01-01T12:00:00Z -o no.toml
expect_stderr "'blue'"
expect_exit 2 photometry counts.toml stars.pgm --filter green --camera camera.toml --exposure 200 -o no.toml
expect_stderr "no time"
# shellcheck disable=SC2086
expect_exit 2 photometry counts.toml p.pgm $when -o no.toml
expect_stderr "384 x 384"
# shellcheck disable=SC2086
expect_exit 2 photometry counts.toml stars.pgm $when --extinction much -o no.toml
mkdir other
# shellcheck disable=SC2086
expect_exit 2 photometry counts.toml stars.pgm $when -o other/no.toml
expect_stderr "folder"
[[ ! -e no.toml ]] || fail "something was written"
