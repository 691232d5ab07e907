#!/usr/bin/env python3
"""Makes data/stars/bright_stars.csv and faint_stars.csv: the stars to magnitude 6, and those from there to magnitude 8, with the
numbers of the Hipparcos catalogue.

  apt-get download kstars-data && dpkg-deb -x kstars-data_*.deb kstars
  npm pack d3-celestial && tar xzf d3-celestial-*.tgz
  scripts/make_star_table.py kstars/usr/share/kstars package/data data/stars

Which stars there are, their places (equinox and epoch J2000, to 1e-4 degrees), magnitudes, colours, names and numbers come from
d3-celestial (stars.8.json, starnames.json); their proper motions from the binary star files of KStars, whose own places
are in part those of 1991.25, Hipparcos's epoch. A star of the one is that star of the other which stands within 5
seconds of arc of it at J2000 or at 1991.25. A star that has no partner (doubles) is told and has no motion.
"""
import collections
import json
import math
import struct
import sys

FAINTEST, FAINTEST_OF_ALL = 6.0, 8.0
ZONE_DEG = 0.02  # of declination, in which a star's partner is looked for
YEARS_TO_2000 = 8.75
RECORDS_BEGIN = 6458  # after the header of 305 bytes and the index of the 512 fields of the sky
RECORD = struct.Struct("<iiiiiihh2sBB")

GREEK = dict(zip("αβγδεζηθικλμνξοπρστυφχψω",
                 "alf bet gam del eps zet eta the iot kap lam mu nu ksi omi pi rho sig tau ups phi chi psi ome".split()))
SUPERSCRIPTS = str.maketrans("¹²³⁴⁵⁶⁷⁸⁹", "123456789")


def motions(path):
    """(ra, dec) at J2000 in degrees, proper motions in mas a year (that in right ascension times cos dec)."""
    data = open(path, "rb").read()
    assert data[124:126] == b"SK" and (len(data) - RECORDS_BEGIN) % RECORD.size == 0, path
    for ra, dec, pm_ra, pm_dec, *_ in RECORD.iter_unpack(data[RECORDS_BEGIN:]):
        yield ra * 15e-6, dec * 1e-5, pm_ra / 10, pm_dec / 10


def designation(names):
    """"alf Lyr", "5 Lyr" or "": in plain letters."""
    greek = "".join(GREEK.get(letter, letter) for letter in names["bayer"]).translate(SUPERSCRIPTS).strip()
    first = greek or names["flam"]
    return f"{first} {names['c']}" if first and names.get("c") else ""


def main(kstars, celestial, folder):
    names = json.load(open(f"{celestial}/starnames.json"))
    zones = collections.defaultdict(list)
    for file in ("namedstars", "unnamedstars"):
        for star in motions(f"{kstars}/{file}.dat"):
            zones[math.floor(star[1] / ZONE_DEG)].append(star)
    rows, faint_rows, still = [], [], []
    for star in json.load(open(f"{celestial}/stars.8.json"))["features"]:
        magnitude, hip = star["properties"]["mag"], star["id"]
        if magnitude > FAINTEST_OF_ALL:
            continue
        east, north = star["geometry"]["coordinates"]
        shrink = math.cos(math.radians(north))

        def seconds_apart(other):
            ra, dec, pm_ra, pm_dec = other
            x, y = 3600 * ((ra - east + 180) % 360 - 180) * shrink, 3600 * (dec - north)
            years = YEARS_TO_2000 * 1e-3
            return min(math.hypot(x, y), math.hypot(x + pm_ra * years, y + pm_dec * years))

        zone = math.floor(north / ZONE_DEG)
        near = min(zones[zone - 1] + zones[zone] + zones[zone + 1], key=seconds_apart, default=None)
        if near is None or seconds_apart(near) > 5:
            if magnitude <= FAINTEST:
                still.append(hip)
            near = (0.0, 0.0, 0.0, 0.0)
        if magnitude > FAINTEST:
            faint_rows.append((magnitude, hip, east % 360, north, *near[2:]))
            continue
        name = names.get(str(hip), {"bayer": "", "flam": "", "name": "", "hd": ""})
        hd = name["hd"].split()[-1] if name.get("hd") else ""
        rows.append((magnitude, hip, hd, designation(name), name["name"], east % 360, north, *near[2:],
                     star["properties"].get("bv") or ""))
    rows.sort()
    with open(f"{folder}/bright_stars.csv", "w") as out:
        out.write("hip,hd,designation,name,ra_deg,dec_deg,pm_ra_mas_per_year,pm_dec_mas_per_year,magnitude,"
                  "colour_index\n")
        for magnitude, hip, hd, letter, name, ra, dec, pm_ra, pm_dec, colour in rows:
            colour = f"{float(colour):.2f}" if colour != "" else ""
            out.write(f"{hip},{hd},{letter},{name},{ra:.4f},{dec:.4f},{pm_ra:.1f},{pm_dec:.1f},{magnitude:.2f},"
                      f"{colour}\n")
    faint_rows.sort()
    with open(f"{folder}/faint_stars.csv", "w") as out:
        out.write("hip,ra_deg,dec_deg,pm_ra_mas_per_year,pm_dec_mas_per_year,magnitude\n")
        for magnitude, hip, ra, dec, pm_ra, pm_dec in faint_rows:
            out.write(f"{hip},{ra:.4f},{dec:.4f},{round(pm_ra)},{round(pm_dec)},{magnitude:.2f}\n")
    print(f"{len(rows)} stars, {len(still)} of them without a motion: HIP {', '.join(map(str, sorted(still)))}; "
          f"{len(faint_rows)} fainter ones, {sum(row[4:] == (0.0, 0.0) for row in faint_rows)} of them without a motion")


if __name__ == "__main__":
    main(*sys.argv[1:])
