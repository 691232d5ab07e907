#!/usr/bin/env python3
"""Opens netCDF files with xarray and compares the units of each variable with those of the documentation.

netcdf_units.py DOCS HEADING FILE.nc [COORDINATE ...] [-- VALUE=ERROR ...]

DOCS is docs/file_formats.md; HEADING is the line ("A map, by `north` and `east`:") whose table is meant. A variable
whose name the table has must have the table's units; one that only a pattern (PARAMETER, NAME, LINE) matches must
have units or be text or a flag. Coordinates must be coordinates of the dataset, and every ancillary variable named must
exist with the same dimensions.
"""
import re
import sys

import xarray


def table_of(docs, heading):
    """Names (or patterns) to units, of the first list "- units: names" behind the heading."""
    lines = open(docs, encoding="utf-8").read().split("\n")
    start = next(i for i, line in enumerate(lines) if line.startswith(heading))
    table = {}
    for line in lines[start + 1:]:
        if line.startswith("- "):
            units, _, names = line[2:].partition(": ")
            for name in re.findall(r"`([^`]+)`", names):
                table[name] = units
        elif table:
            return table
    return table


def main():
    docs, heading, file, *rest = sys.argv[1:]
    table = table_of(docs, heading)
    assert table, f"no table behind {heading!r}"
    data = xarray.open_dataset(file, decode_times=False)
    problems = []
    for name, variable in data.variables.items():
        units = variable.attrs.get("units")
        is_words = variable.dtype == object or "flag_values" in variable.attrs
        wanted = table.get(re.sub(r"_(photo_\w+)$", "", name))
        if wanted is None:
            patterns = [key for key in table if re.search("PARAMETER|NAME|LINE", key)]
            matches = [key for key in patterns
                       if re.fullmatch(re.sub("PARAMETER|NAME|LINE", r"\\w+", key), name)]
            if not matches:
                problems.append(f"{name} is not in the documentation")
                continue
            wanted = table[matches[-1]] if table[matches[-1]] not in ("its own", "the parameter's") else None
            if wanted is None:
                if units is None and not is_words:
                    problems.append(f"{name} has no units")
                continue
        if (units or "no units") != wanted:
            problems.append(f"{name} has units {units!r}, documented {wanted!r}")
        for other in variable.attrs.get("ancillary_variables", "").split():
            if other not in data.variables:
                problems.append(f"{name} names {other}, which is not there")
            elif data.variables[other].dims != variable.dims:
                problems.append(f"{name} and {other} have other dimensions")
    for coordinate in rest:
        if coordinate not in data.coords:
            problems.append(f"{coordinate} is no coordinate: {list(data.coords)}")
    if data.attrs.get("Conventions") != "CF-1.8":
        problems.append("no conventions")
    xarray.open_dataset(file)  # times decoded
    for problem in problems:
        print(f"{file}: {problem}")
    return 1 if problems else 0


sys.exit(main())
