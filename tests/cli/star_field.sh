# shellcheck shell=bash
# Pictures of stars; to be sourced after case.sh.
# A star's light, and that of a pixel with the sky's, of 480 x 360.
STARLIGHT='
  function shine(x, y, height, i, j) {
    for (j = int(y) - 4; j <= int(y) + 4; ++j)
      for (i = int(x) - 4; i <= int(x) + 4; ++i)
        light[j * 480 + i] += height * exp(-((i + .5 - x) ^ 2 + (j + .5 - y) ^ 2) / 2.9)
  }
  function sky(p) { return 1000 + 60 * (rand() + rand() - 1) + light[p] }'
# The table's stars to magnitude 4 as an equidistant lens of 250 px to a radian sees them, in 480 x 360 pixels about right
# ascension 90 degrees and the equator with north up; over a ground with a little noise of a fixed sequence.
# sky_to MIRRORED [ELEVATION]: the picture; below the horizon of an axis so many degrees high it is black.
sky_to() {
  awk -F, -v mirrored="$1" -v ground="${2:-0}" "$STARLIGHT"'
    BEGIN { srand(7); pi = atan2(0, -1) }
    NR > 1 && $9 <= 4 {
      a = $5 * pi / 180; d = $6 * pi / 180
      right = cos(d) * cos(a); down = -sin(d); forward = cos(d) * sin(a)
      across = sqrt(right * right + down * down); angle = atan2(across, forward)
      x = 240 + (mirrored ? -1 : 1) * 250 * angle * right / across; y = 180 + 250 * angle * down / across
      if (angle > 1.4 || x < 4 || y < 4 || x > 476 || y > 356) next
      shine(x, y, 9000 * exp(-0.921 * ($9 - 2)))
    }
    END {
      print "P2 480 360 65535"
      for (p = 0; p < 480 * 360; ++p) {
        v = sky(p)
        if (ground > 0) {
          x = p % 480 + .5 - 240; y = int(p / 480) + .5 - 180; across = sqrt(x * x + y * y); angle = across / 250
          if (sin(angle) * y / across * cos(ground * pi / 180) > cos(angle) * sin(ground * pi / 180)) v = 20 * rand()
        }
        print int(v > 65535 ? 65535 : v)
      }
    }' "$SOURCE/data/stars/bright_stars.csv"
}
# The stars to magnitude 8 as a pinhole of 3400 px sees them, 8 degrees across, about right ascension 98 degrees and
# declination 24 degrees with north up.
narrow_sky() {
  awk -F, "$STARLIGHT"'
    BEGIN { srand(9); degree = atan2(0, -1) / 180; dec = 24 * degree }
    FNR > 1 {
      magnitude = NF > 6 ? $9 : $6; a = ((NF > 6 ? $5 : $2) - 98) * degree; d = (NF > 6 ? $6 : $3) * degree
      forward = sin(dec) * sin(d) + cos(dec) * cos(d) * cos(a)
      if (forward < .9) next
      x = 240 - 3400 * cos(d) * sin(a) / forward; y = 180 - 3400 * (cos(dec) * sin(d) - sin(dec) * cos(d) * cos(a)) / forward
      if (x < 4 || y < 4 || x > 476 || y > 356) next
      shine(x, y, 9000 * exp(-0.921 * (magnitude - 6)))
    }
    END {
      print "P2 480 360 65535"
      for (p = 0; p < 480 * 360; ++p) {
        v = sky(p)
        print int(v > 65535 ? 65535 : v)
      }
    }' "$SOURCE/data/stars/bright_stars.csv" "$SOURCE/data/stars/faint_stars.csv"
}
