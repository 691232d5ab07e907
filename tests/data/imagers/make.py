#!/usr/bin/python3
"""Writes the files beside it, which tests read: small ones of the formats in which imagers' frames and skymaps are
published, by writers that have nothing to do with vegard: h5py (rgb.h5, madrigal*.h5, huge*.h5, stack_v73.mat), SciPy (stack.mat), tarfile,
zlib and gzip (minute.png.tar, minute.pgm.gz, frame.fits.gz), and for CDF, which has no library in Debian, the format's
description by hand (asi.cdf, asi_packed.cdf; Debian's libjcdf-java reads the same numbers of them). The two .sav are GDL's: gdl -q make_skymap.pro.

    apt-get install python3-h5py python3-scipy gnudatalanguage; ./make.py; gdl -q make_skymap.pro

Pixel (x, y) of frame f has 100 f + 10 y + x, of colour c 40 more each; there are 3 frames of 5 x 4 pixels, taken at
06:05:00.25, 03.25 and 06.25 UTC on 2021-10-30."""
import gzip
import io
import struct
import tarfile
import zlib

import h5py
import numpy as np
import scipy.io

FRAMES, WIDTH, HEIGHT = 3, 5, 4
TIMES = ["2021-10-30 06:05:%09.6f UTC" % (0.25 + 3 * f) for f in range(FRAMES)]
UNIX_S = [1635573900.25 + 3 * f for f in range(FRAMES)]


def frame(f, colours=0):
    grey = np.array([[100 * f + 10 * y + x for x in range(WIDTH)] for y in range(HEIGHT)])
    return np.stack([grey + 40 * c for c in range(colours)], axis=-1) if colours else grey


def write_rgb():
    """As TREx's colour cameras: height, width, colours, frames."""
    with h5py.File("rgb.h5", "w", libver="latest") as file:
        images = np.stack([frame(f, 3) % 256 for f in range(FRAMES)], axis=-1).astype("u1")
        file.create_dataset("data/images", data=images, chunks=(HEIGHT, WIDTH, 3, 1), compression="gzip")
        file["data/timestamp"] = np.array([t.encode() for t in TIMES])
        words = file.create_group("metadata/file").attrs
        words["site_unique_id"] = np.bytes_("gill")
        words["imager_unique_id"] = "rgb-04"
        words["subframe_requested_exposure"] = np.bytes_("2800.0 ms")
        for f in range(FRAMES):
            own = file.create_group("metadata/frame/frame%d" % f).attrs
            own["image_request_start_timestamp"] = np.bytes_(TIMES[f])


def write_huge():
    """What is declared and is not there: terabytes of images, and a chunk of a terabyte."""
    with h5py.File("huge.h5", "w", libver="latest") as file:
        file.create_dataset("images", shape=(400000, 400000, 10), dtype="u2", chunks=(64, 64, 1), compression="gzip")
    with h5py.File("huge_chunk.h5", "w", libver="latest") as file:
        file.create_dataset("images", shape=(32768, 32768, 10), dtype="u2", chunks=(32768, 16384, 2), compression="gzip")


def write_madrigal():
    """A radar's densities as Madrigal has them: two minutes, two beams; dnel as the error's log10 and as the log10's error."""
    names = [("year", "i4"), ("beamid", "i4"), ("ut1_unix", "f8"), ("ut2_unix", "f8"), ("gdalt", "f8"), ("nel", "f8"),
             ("dnel", "f8"), ("kindat", "i4")]
    rows = []
    for minute in range(2):
        begin = 1206515000.0 + 60 * minute
        for beam in (1, 2):
            for gate, altitude in enumerate(range(85, 155, 5)):
                density = 11.0 + 0.5 * np.exp(-(((altitude - 110) / 20.0) ** 2))
                rows.append((2008, beam, begin, begin + 60.0, altitude, np.nan if gate == 3 and minute == 0 else density,
                             density - 1.3 if beam == 1 else 0.02, 5950))
    with h5py.File("madrigal.h5", "w") as file:
        file.create_dataset("Data/Table Layout", data=np.array(rows, dtype=names), compression="gzip", chunks=(28,))
        file["Metadata/Experiment Notes"] = np.array([("a note",)], dtype=[("File Notes", "S10")])


def write_madrigal_gaps():
    """Three minutes of one beam. The second minute has no time, and one gate of the third, of another density, no beam."""
    names = [("beamid", "f8"), ("ut1_unix", "f8"), ("ut2_unix", "f8"), ("gdalt", "f8"), ("nel", "f8"), ("dnel", "f8")]
    rows = []
    for minute in range(3):
        begin = np.nan if minute == 1 else 1206515000.0 + 60 * minute
        for gate, altitude in enumerate(range(85, 155, 5)):
            is_lost = gate == 3 and minute == 2
            rows.append((np.nan if is_lost else 1, begin, begin + 60.0, altitude, 13.0 if is_lost else 11.0 + minute / 10, 0.02))
    with h5py.File("madrigal_gaps.h5", "w") as file:
        file.create_dataset("Data/Table Layout", data=np.array(rows, dtype=names), compression="gzip", chunks=(42,))


def write_matlab():
    stack = np.stack([frame(f) for f in range(FRAMES)], axis=-1).astype("u2")
    days = 719529 + np.array(UNIX_S) / 86400
    scipy.io.savemat("stack.mat", {"images": stack, "time": days, "sky": {"azimuth": 1.0 * stack[:, :, 0]}},
                     do_compression=True)
    # MATLAB's arrays run down their columns, so that HDF5 has their dimensions the other way round.
    with h5py.File("stack_v73.mat", "w", userblock_size=512) as file:
        images = file.create_dataset("images", data=stack.T)
        images.attrs["MATLAB_class"] = np.bytes_("uint16")
        time = file.create_dataset("posixtime", data=np.array([UNIX_S]).T)
        time.attrs["MATLAB_class"] = np.bytes_("double")
        name = file.create_dataset("name", data=np.array([[ord(c) for c in "gill"]], dtype="u2").T)
        name.attrs["MATLAB_class"] = np.bytes_("char")
    with open("stack_v73.mat", "r+b") as file:
        file.write(b"MATLAB 7.3 MAT-file, Platform: made, Created by: h5py".ljust(116) + bytes(8) + b"\x00\x02IM")


def write_minute():
    """As THEMIS: PGM with its words in comments, frame after frame, packed."""
    data = b""
    for f in range(FRAMES):
        first = b'#"Imager unique ID" themis19\n#"Site unique ID" gill\n' if f == 0 else b""
        data += (b"P5\n" + first + b'#"Exposure options" WIDTH=5 HEIGHT=4 XBIN=1 YBIN=1 MSEC=999\n'
                 b'#"Image request start" ' + TIMES[f].encode() + b"\n5 4\n65535\n" + frame(f).astype(">u2").tobytes())
    with open("minute.pgm.gz", "wb") as file:
        file.write(gzip.compress(data, mtime=0))


def write_fits():
    """The second frame by the FITS standard, 16 bits from 32768, its upper row first, packed."""
    cards = ["SIMPLE  =                    T", "BITPIX  =                   16", "NAXIS   =                    2",
             "NAXIS1  =                    5", "NAXIS2  =                    4", "BZERO   =                32768",
             "BSCALE  =                    1", "ROWORDER= 'TOP-DOWN'", "DATE-OBS= '2021-10-30T06:05:03.250'", "END"]
    head = "".join(card.ljust(80) for card in cards).ljust(2880).encode()
    pixels = (frame(1) - 32768).astype(">i2").tobytes()
    with open("frame.fits.gz", "wb") as file:
        file.write(gzip.compress(head + pixels.ljust(2880, b"\0"), mtime=0))


def png(pixels):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = b"".join(b"\0" + row.astype("u1").tobytes() for row in pixels)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", WIDTH, HEIGHT, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def write_tar():
    """In no order, as tars come."""
    with tarfile.open("minute.png.tar", "w") as tar:
        for f in (1, 0, 2):
            data = png(frame(f, 3) % 256)
            entry = tarfile.TarInfo("minute/20211030_0605%02d_250000_gill_rgb-04_320ms_burst.png" % (3 * f))
            entry.size = len(data)
            tar.addfile(entry, io.BytesIO(data))


def write_cdf(name, packed, big):
    """One variable of images and one of epochs, as THEMIS has them; `packed` by gzip, frame by frame."""
    order = ">" if big else "<"
    out = bytearray(b"\xcd\xf3\x00\x01\x00\x00\xff\xff")

    def record(kind, body):
        place = len(out)
        out.extend(struct.pack(">qi", 12 + len(body), kind) + body)
        return place

    def name_of(text):
        return text.encode().ljust(256, b"\0")
    fixed = record(1, struct.pack(">qiiiiiiiii", 0, 3, 8, 1 if big else 6, 3, 0, 0, 1, 3, -1) + bytes(256))
    glob = record(2, bytes(72))
    packing = record(11, struct.pack(">iiii", 5, 0, 1, 6)) if packed else -1
    variables = [("thg_asf_gill", 12, [HEIGHT, WIDTH], [frame(f).astype(order + "u2").tobytes() for f in range(FRAMES)]),
                 ("thg_asf_gill_epoch", 31, [], [struct.pack(order + "d", (s + 719528 * 86400.0) * 1000) for s in UNIX_S])]
    heads = []
    for variable, kind, dims, records in variables:
        blocks = []
        if packed:
            for one in records:
                data = gzip.compress(one, mtime=0)
                blocks.append(record(13, struct.pack(">iq", 0, len(data)) + data))
            first, last = range(FRAMES), range(FRAMES)
        else:
            blocks.append(record(7, b"".join(records)))
            first, last = [0], [FRAMES - 1]
        n = len(blocks)
        index = record(6, struct.pack(">qii", 0, n, n) + struct.pack(">%di" % n, *first) +
                       struct.pack(">%di" % n, *last) + struct.pack(">%dq" % n, *blocks))
        heads.append(record(8, struct.pack(">qiiqqiiiiiiiqi", 0, kind, FRAMES - 1, index, index, 5 if packed else 1, 0, 0,
                                           -1, -1, 1, len(heads), packing, 0) + name_of(variable) +
                            struct.pack(">i", len(dims)) + struct.pack(">%di" % len(dims), *dims) +
                            struct.pack(">%di" % len(dims), *[-1] * len(dims))))
    out[heads[0] + 12:heads[0] + 20] = struct.pack(">q", heads[1])
    out[fixed + 12:fixed + 20] = struct.pack(">q", glob)
    out[glob + 12:glob + 84] = struct.pack(">qqqqiiiiiqiii", 0, heads[0], 0, len(out), 0, 0, -1, 0, 2, 0, 0, -1, -1)
    with open(name, "wb") as file:
        file.write(out)


write_rgb()
write_minute()
write_fits()
write_huge()
write_madrigal()
write_madrigal_gaps()
write_matlab()
write_tar()
write_cdf("asi.cdf", False, True)
write_cdf("asi_packed.cdf", True, False)
