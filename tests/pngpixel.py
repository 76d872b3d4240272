"""pngpixel.py FILE X,Y ...: red, green and blue of pixels of a PNG, a line each."""
import struct
import sys
import zlib


def rows_of(data):
    at, packed, width, height, colour = 8, b"", 0, 0, 0
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at : at + 8])
        body = data[at + 8 : at + 8 + size]
        if kind == b"IHDR":
            width, height, _, colour = struct.unpack(">IIBB", body[:10])
        if kind == b"IDAT":
            packed += body
        at += 12 + size
    step = {2: 3, 6: 4}[colour]
    raw, length = zlib.decompress(packed), width * step
    rows, above = [], bytes(length)
    for y in range(height):
        start = y * (length + 1)
        method, row = raw[start], bytearray(raw[start + 1 : start + 1 + length])
        for i in range(length):
            a, b, c = (row[i - step], above[i], above[i - step]) if i >= step else (0, above[i], 0)
            p = a + b - c
            paeth = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
            row[i] = (row[i] + (0, a, b, (a + b) // 2, paeth)[method]) & 255
        rows.append(row)
        above = row
    return rows, step


rows, step = rows_of(open(sys.argv[1], "rb").read())
for place in sys.argv[2:]:
    x, y = map(int, place.split(","))
    print(*rows[y][x * step : x * step + 3])
