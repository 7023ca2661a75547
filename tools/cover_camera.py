#!/usr/bin/env python3
"""Copies a TUM RGB-D sequence with the camera covered for a while: black colour, no depth.

Usage: tools/cover_camera.py SEQUENCE OUTPUT [--first N] [--count N]

What is not covered is linked, not copied. Without --first the covered frames are in the middle.
"""

import argparse
import pathlib
import shutil
import struct
import zlib


def png_size(path):
    header = path.read_bytes()[:24]
    if header[:8] != b'\x89PNG\r\n\x1a\n':
        raise SystemExit(f'{path}: is no PNG')
    return struct.unpack('>II', header[16:24])


def black_png(size, bits, color_type):
    """Bytes of a PNG of zeros; color_type as in the PNG standard: 0 = grey, 2 = RGB."""
    def chunk(name, data):
        return (struct.pack('>I', len(data)) + name + data + struct.pack('>I', zlib.crc32(name + data)))
    width, height = size
    row = bytes(1 + width * bits // 8 * (3 if color_type == 2 else 1))
    header = struct.pack('>IIBBBBB', width, height, bits, color_type, 0, 0, 0)
    return (b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', header) + chunk(b'IDAT', zlib.compress(row * height)) +
            chunk(b'IEND', b''))


def cover(sequence, output, first, count):
    """Makes the copy; gives the stamps of the colour images that are covered."""
    for name in ('rgb', 'depth'):
        if not (sequence / f'{name}.txt').exists():
            raise SystemExit(f'{sequence}: has no {name}.txt')
        (output / name).mkdir(parents=True, exist_ok=True)
    lists = {name: [line.split() for line in (sequence / f'{name}.txt').read_text().splitlines()
                    if line.strip() and not line.startswith('#')] for name in ('rgb', 'depth')}
    colors = lists['rgb']
    if first is None:
        first = (len(colors) - count) // 2
    # Readers go by the bytes, whatever a file is called; colour and depth are of one size.
    size = png_size(sequence / lists['depth'][0][1])
    covered = [float(stamp) for stamp, _ in colors[first:first + count]]
    for name, (bits, color_type) in {'rgb': (8, 2), 'depth': (16, 0)}.items():
        for stamp, file in lists[name]:
            target = output / file
            target.unlink(missing_ok=True)
            if covered and covered[0] - 0.02 <= float(stamp) <= covered[-1] + 0.02:
                target.write_bytes(black_png(size, bits, color_type))
            else:
                target.symlink_to((sequence / file).resolve())
    for file in sequence.iterdir():
        if file.is_file():
            shutil.copy(file, output / file.name)
    return covered


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('sequence', type=pathlib.Path)
    parser.add_argument('output', type=pathlib.Path)
    parser.add_argument('--first', type=int, help='index of the first covered frame')
    parser.add_argument('--count', type=int, default=20, help='number of covered frames')
    arguments = parser.parse_args()
    covered = cover(arguments.sequence, arguments.output, arguments.first, arguments.count)
    print(f'covered {len(covered)} frames, from {covered[0]:.6f} to {covered[-1]:.6f} s')


if __name__ == '__main__':
    main()
