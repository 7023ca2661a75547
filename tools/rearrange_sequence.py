#!/usr/bin/env python3
"""Plays parts of a TUM sequence in another order: makes a folder of links whose stamps increase again.

Usage: tools/rearrange_sequence.py SEQUENCE OUTPUT RANGE...
A RANGE is FIRST:END in frames; where END is smaller it is played backwards. The camera should be at about
the same place where one range ends and the next begins. Ground truth is rearranged alike.
  forward and backward:    0:573 573:0
  late start, wrapped:     250:573 573:0 0:300
"""
import argparse
import pathlib

GAP_S = 0.033  # between the last frame of a range and the first of the next


def read_table(path):
    """Rows of a file of stamped lines, without comments."""
    lines = (line.split() for line in path.read_text().splitlines())
    return [row for row in lines if row and not row[0].startswith('#')]


def read_pairs(sequence):
    """(color stamp, color file, depth stamp, depth file) by frame."""
    return [(float(t), file, float(depth_t), depth_file)
            for t, file, depth_t, depth_file in read_table(sequence / 'associations.txt')]


class Part:
    """A range of frames and the way its times go over to the new sequence."""

    def __init__(self, pairs, text, start_s):
        first, end = (int(number) for number in text.split(':'))
        self.frames = pairs[first:end] if first < end else pairs[end:first][::-1]
        self.direction = 1 if first < end else -1
        self.old_start_s, self.new_start_s = self.frames[0][0], start_s

    def new_time(self, old_s):
        return self.new_start_s + self.direction * (old_s - self.old_start_s)

    @property
    def end_s(self):
        return self.new_time(self.frames[-1][0])

    def covers(self, old_s):
        low, high = sorted((self.frames[0][0], self.frames[-1][0]))
        return low <= old_s <= high


def rearrange(pairs, ranges):
    """The parts of the new sequence."""
    parts, start_s = [], pairs[0][0]
    for text in ranges:
        parts.append(Part(pairs, text, start_s))
        start_s = parts[-1].end_s + GAP_S
    return parts


def write(output, sequence, parts):
    output.mkdir(parents=True, exist_ok=True)
    for name in ('rgb', 'depth', 'mask'):
        link = output / name
        if (sequence / name).exists() and not link.exists():
            link.symlink_to((sequence / name).resolve())
    frames = [(part.new_time(t), file, part.new_time(depth_t), depth_file)
              for part in parts for t, file, depth_t, depth_file in part.frames]
    lines = {'associations.txt': [f'{t:.6f} {file} {d:.6f} {depth}' for t, file, d, depth in frames],
             'rgb.txt': [f'{t:.6f} {file}' for t, file, _, _ in frames],
             'depth.txt': [f'{d:.6f} {depth}' for _, _, d, depth in frames]}
    if (sequence / 'groundtruth.txt').exists():
        rows = read_table(sequence / 'groundtruth.txt')
        lines['groundtruth.txt'] = [
            f'{part.new_time(float(row[0])):.4f} ' + ' '.join(row[1:])
            for part in parts for row in rows[::part.direction] if part.covers(float(row[0]))]
    for name, text in lines.items():
        (output / name).write_text('\n'.join(text) + '\n')
    for name in ('camera.json', 'camera.yaml'):
        if (sequence / name).exists():
            (output / name).write_text((sequence / name).read_text())
    return len(frames)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('sequence', type=pathlib.Path)
    parser.add_argument('output', type=pathlib.Path)
    parser.add_argument('ranges', nargs='+', metavar='FIRST:END')
    arguments = parser.parse_args()
    parts = rearrange(read_pairs(arguments.sequence), arguments.ranges)
    print(f'{write(arguments.output, arguments.sequence, parts)} frames in {arguments.output}')


if __name__ == '__main__':
    main()
