"""Writes small files that declare things about their light, their frame and their units: PNG, TIFF, FITS, ICC profiles.

Only the standard library, so that no decoder of ours or of others has a part in it.
"""

import struct
import zlib

SRGB = ((0.64, 0.33), (0.30, 0.60), (0.15, 0.06), (0.3127, 0.3290))
P3 = ((0.680, 0.320), (0.265, 0.690), (0.150, 0.060), (0.3127, 0.3290))
ADOBE = ((0.64, 0.33), (0.21, 0.71), (0.15, 0.06), (0.3127, 0.3290))
REC2020 = ((0.708, 0.292), (0.170, 0.797), (0.131, 0.046), (0.3127, 0.3290))


def srgb_encode(x):
    return 12.92 * x if x <= 0.0031308 else 1.055 * x ** (1 / 2.4) - 0.055


def srgb_decode(v):
    return v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(len(b))) for j in range(len(b[0]))] for i in range(len(a))]


def inverse(m):
    (a, b, c), (d, e, f), (g, h, i) = m
    det = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
    return [
        [(e * i - f * h) / det, (c * h - b * i) / det, (b * f - c * e) / det],
        [(f * g - d * i) / det, (a * i - c * g) / det, (c * d - a * f) / det],
        [(d * h - e * g) / det, (b * g - a * h) / det, (a * e - b * d) / det],
    ]


def xyz_of_rgb(primaries):
    """Rows X, Y, Z of red, green, blue whose sum is white (SMPTE RP 177)."""
    columns = [[x / y, 1.0, (1 - x - y) / y] for x, y in primaries[:3]]
    x, y = primaries[3]
    white = [[x / y], [1.0], [(1 - x - y) / y]]
    m = [[columns[c][r] for c in range(3)] for r in range(3)]
    scale = product(inverse(m), white)
    return [[m[r][c] * scale[c][0] for c in range(3)] for r in range(3)]


def to_srgb(primaries):
    """Matrix of primaries whose white is D65 to sRGB's."""
    return product(inverse(xyz_of_rgb(SRGB)), xyz_of_rgb(primaries))


def apply(matrix, rgb):
    return [sum(matrix[r][c] * rgb[c] for c in range(3)) for r in range(3)]


BRADFORD = [[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]]
D50 = [[0.9642], [1.0], [0.8249]]


def adapted_to_d50(xyz, white):
    x, y = white
    cone = product(BRADFORD, [[x / y], [1.0], [(1 - x - y) / y]])
    cone50 = product(BRADFORD, D50)
    scale = [[cone50[r][0] / cone[r][0] if r == c else 0.0 for c in range(3)] for r in range(3)]
    return product(product(inverse(BRADFORD), product(scale, BRADFORD)), xyz)


def icc(curve, primaries, name, space=b"RGB "):
    """A version 2 display profile (ICC.1:2001-04): `curve` is "srgb", or a gamma, 1 for linear."""

    def s15(v):
        return struct.pack(">i", round(v * 65536))

    def xyz(t):
        return b"XYZ \0\0\0\0" + b"".join(s15(v) for v in t)

    if curve == "srgb":
        n = 1024
        trc = b"curv\0\0\0\0" + struct.pack(">I", n)
        trc += b"".join(struct.pack(">H", round(srgb_decode(i / (n - 1)) * 65535)) for i in range(n))
    elif curve == 1:
        trc = b"curv\0\0\0\0" + struct.pack(">I", 0)
    else:
        trc = b"curv\0\0\0\0" + struct.pack(">IH", 1, round(curve * 256))
    words = name.encode() + b"\0"
    tags = [
        (b"desc", b"desc\0\0\0\0" + struct.pack(">I", len(words)) + words + bytes(4 + 4 + 2 + 1 + 67)),
        (b"cprt", b"text\0\0\0\0none\0"),
        (b"wtpt", xyz((0.9642, 1.0, 0.8249))),
    ]
    if space == b"GRAY":
        tags.append((b"kTRC", trc))
    else:
        m = adapted_to_d50(xyz_of_rgb(primaries), primaries[3])
        tags += [(c + b"XYZ", xyz([m[r][i] for r in range(3)])) for i, c in enumerate((b"r", b"g", b"b"))]
        tags += [(c + b"TRC", trc) for c in (b"r", b"g", b"b")]
    offset, table, data = 128 + 4 + 12 * len(tags), struct.pack(">I", len(tags)), b""
    for tag, content in tags:
        content += bytes(-len(content) % 4)
        table += tag + struct.pack(">II", offset + len(data), len(content))
        data += content
    head = struct.pack(">I4sI", 128 + len(table) + len(data), b"lcms", 0x02400000) + b"mntr" + space + b"XYZ "
    head += struct.pack(">6H", 2024, 1, 1, 0, 0, 0) + b"acspAPPL" + bytes(20) + struct.pack(">I", 0)
    head += s15(0.9642) + s15(1.0) + s15(0.8249)
    return head.ljust(128, b"\0") + table + data


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def png(path, rows, bits=16, chunks=()):
    """rows: of pixels, each a list of codes of one or three channels."""
    colours = len(rows[0][0])
    form = ">H" if bits == 16 else ">B"
    raw = b"".join(b"\0" + b"".join(struct.pack(form, v) for pixel in row for v in pixel) for row in rows)
    head = struct.pack(">IIBBBBB", len(rows[0]), len(rows), bits, 2 if colours == 3 else 0, 0, 0, 0)
    body = b"".join(chunk(kind, data) for kind, data in chunks)
    content = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + body
    open(path, "wb").write(content + chunk(b"IDAT", zlib.compress(raw)) + chunk(b"IEND", b""))


def tiff_page(rows, tags, at):
    """The bytes of a page that begins at `at`, without the place of the next one, which comes behind its entries."""
    colours = len(rows[0][0])
    pixels = b"".join(struct.pack("<H", v) for row in rows for pixel in row for v in pixel)
    entries = [
        (254, 4, [0]),
        (256, 4, [len(rows[0])]),
        (257, 4, [len(rows)]),
        (258, 3, [16] * colours),
        (259, 3, [1]),
        (262, 3, [2 if colours == 3 else 1]),
        (273, 4, [at]),
        (277, 3, [colours]),
        (278, 4, [len(rows)]),
        (279, 4, [len(pixels)]),
    ]
    entries = [e for e in entries if e[0] not in {t[0] for t in tags}] + list(tags)
    entries.sort()
    out = pixels + bytes(len(pixels) % 2)
    directory = at + len(out)
    beside = directory + 2 + 12 * len(entries) + 4
    body, data = struct.pack("<H", len(entries)), b""
    for tag, kind, values in entries:
        if isinstance(values, bytes):
            content = values
        elif kind == 5:
            content = b"".join(struct.pack("<II", round(v * 1e6), 1000000) for v in values)
        else:
            content = b"".join(struct.pack("<H" if kind == 3 else "<I", v) for v in values)
        count = len(values)
        if len(content) <= 4:
            field = content.ljust(4, b"\0")
        else:
            field = struct.pack("<I", beside + len(data))
            data += content + bytes(len(content) % 2)
        body += struct.pack("<HHI", tag, kind, count) + field
    return out, directory, body, data


def tiff(path, pages, tags=(), subfile=None):
    """pages: of rows of pixels of 16 bits; `tags` of all: (tag, type, values), types 3, 4, 5 or 7 of bytes."""
    content, link = bytearray(b"II*\0\0\0\0\0"), 4
    for i, rows in enumerate(pages):
        own = list(tags) + ([(254, 4, [subfile[i]])] if subfile else [])
        pixels, directory, body, data = tiff_page(rows, own, len(content))
        struct.pack_into("<I", content, link, directory)
        content += pixels + body
        link = len(content)
        content += b"\0\0\0\0" + data
    open(path, "wb").write(bytes(content))


def header(cards):
    text = ""
    for key, value in cards:
        shown = f"'{value:<8}'" if isinstance(value, str) else ("T" if value is True else f"{value!r}").rjust(20)
        text += f"{key:<8}= {shown}".ljust(80)
    text += "END".ljust(80)
    return text.ljust(-(-len(text) // 2880) * 2880).encode()


def padded(data):
    return data + bytes(-len(data) % 2880)


def fits_image(rows, cards=(), bits=16, extension=False):
    """One plane, or with a list of planes of rows several; the first row of a plane comes first. 16 bits unsigned, or floats."""
    planes = rows if isinstance(rows[0][0], list) else [rows]
    axes = [("NAXIS", 2 if len(planes) == 1 else 3), ("NAXIS1", len(planes[0][0])), ("NAXIS2", len(planes[0]))]
    axes += [("NAXIS3", len(planes))] if len(planes) > 1 else []
    first = [("XTENSION", "IMAGE")] if extension else [("SIMPLE", True)]
    beside = [("PCOUNT", 0), ("GCOUNT", 1)] if extension else []
    scale = [("BZERO", 32768)] if bits == 16 else []
    numbers = [v for plane in planes for row in plane for v in row]
    data = b"".join(struct.pack(">h", v - 32768) if bits == 16 else struct.pack(">f", v) for v in numbers)
    return header(first + [("BITPIX", bits)] + axes + beside + scale + list(cards)) + padded(data)


def fits_of(path):
    """Keywords and planes (lists of rows of floats, the first row first) of a file that vegard wrote."""
    content, words, at = open(path, "rb").read(), {}, 0
    while True:
        card = content[at:at + 80].decode()
        at += 80
        if card.startswith("END "):
            break
        if card[8:10] == "= ":
            words[card[:8].strip()] = card[10:].split("/")[0].strip().strip("'").strip()
    at = -(-at // 2880) * 2880
    width, height, planes = int(words["NAXIS1"]), int(words["NAXIS2"]), int(words.get("NAXIS3", 1))
    numbers = struct.unpack(f">{width * height * planes}f", content[at:at + 4 * width * height * planes])
    plane = width * height
    return words, [[list(numbers[p * plane + y * width:p * plane + (y + 1) * width]) for y in range(height)] for p in range(planes)]
