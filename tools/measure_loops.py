#!/usr/bin/env python3
"""Runs the program over sequences with loop closing off and on, and holds every loop against ground truth.

Usage: tools/measure_loops.py [--seeds N] [--loops on] [--program P] SEQUENCE... [-- ARGUMENTS OF ofm-slam run]
Prints for each run: error of the trajectory [cm], coverage, map, loops closed and candidates rejected; and
for each loop by how much the relative pose that it claims is wrong. A false loop is wrong by decimetres.
"""
import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent


def multiply(p, q):
    """Of quaternions (x, y, z, w)."""
    px, py, pz, pw = p
    qx, qy, qz, qw = q
    return (pw * qx + px * qw + py * qz - pz * qy, pw * qy - px * qz + py * qw + pz * qx,
            pw * qz + px * qy - py * qx + pz * qw, pw * qw - px * qx - py * qy - pz * qz)


def rotate(q, v):
    x, y, z, _ = multiply(multiply(q, (*v, 0)), (-q[0], -q[1], -q[2], q[3]))
    return x, y, z


def compose(a, b):
    """The rigid transform a * b; each is (translation, quaternion)."""
    return tuple(s + t for s, t in zip(rotate(a[1], b[0]), a[0])), multiply(a[1], b[1])


def invert(a):
    back = (-a[1][0], -a[1][1], -a[1][2], a[1][3])
    return tuple(-x for x in rotate(back, a[0])), back


def read_truth(path):
    """[(stamp, world_from_camera)]"""
    rows = [[float(x) for x in line.split()] for line in path.read_text().splitlines()
            if line.strip() and not line.startswith('#')]
    return [(row[0], (tuple(row[1:4]), tuple(row[4:8]))) for row in rows]


def pose_at(truth, stamp):
    return min(truth, key=lambda row: abs(row[0] - stamp))[1]


def loop_line(loop, truth):
    """What a loop claims, and by how much that is wrong [m, deg]."""
    stamp, place = float(loop['stamp']), float(loop['place_stamp'])
    claimed = tuple(loop['place_from_keyframe'][:3]), tuple(loop['place_from_keyframe'][3:])
    true = compose(invert(pose_at(truth, place)), pose_at(truth, stamp))
    error = compose(true, invert(claimed))
    angle = 2 * math.degrees(math.acos(min(1, abs(error[1][3]))))
    start = truth[0][0]
    effect = (f'joins sub-map {loop["joined_submap"]} to {loop["into_submap"]}' if 'joined_submap' in loop else
              f'drift {loop["drift_m"]:.3f} m {loop["drift_deg"]:.2f} deg')
    return (f'    {stamp - start:.2f} s shows {place - start:.2f} s: {loop["matches"]} matches, '
            f'{loop["landmarks_fused"]} fused, {effect}; '
            f'wrong by {math.dist(error[0], (0, 0, 0)):.3f} m, {angle:.2f} deg')


def run(program, sequence, arguments, output):
    command = [program, 'run', str(sequence), '--quiet', '--set', 'build_semantic_map=false', '--output',
               str(output), *arguments]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return json.loads((output / 'summary.json').read_text())


def run_line(name, summary):
    counts, loops = summary['counts'], summary['loops']
    ate = [100 * summary[kind]['ate']['translation_m']['rmse'] for kind in ('trajectory', 'trajectory_live')]
    rejected = '/'.join(str(loops['rejected_' + why])
                        for why in ('inconsistent', 'few_matches', 'no_alignment', 'few_inliers'))
    return (f'{name}: ATE {ate[0]:.2f} cm, live {ate[1]:.2f}; {100 * counts["tracked_share"]:.1f} % tracked, '
            f'{counts["keyframes"]} keyframes, {counts["landmarks"]} landmarks; {loops["closed"]} loops, '
            f'{loops["similar"]} similar, rejected {rejected}')


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--program', default=str(ROOT / 'build/release/bin/ofm-slam'))
    parser.add_argument('--seeds', type=int, default=1)
    parser.add_argument('--loops', choices=('both', 'on', 'off'), default='both')
    parser.add_argument('sequences', nargs='+', type=pathlib.Path)
    own, more = sys.argv[1:], []
    if '--' in own:
        own, more = own[:own.index('--')], own[own.index('--') + 1:]
    arguments = parser.parse_args(own)
    for sequence in arguments.sequences:
        truth = read_truth(sequence / 'groundtruth.txt')
        for seed in range(1, arguments.seeds + 1):
            for enabled in {'both': ('false', 'true'), 'on': ('true',), 'off': ('false',)}[arguments.loops]:
                with tempfile.TemporaryDirectory() as folder:
                    summary = run(arguments.program, sequence,
                                  ['--seed', str(seed), '--set', 'loop.enabled=' + enabled, *more],
                                  pathlib.Path(folder))
                print(run_line(f'{sequence.name}, seed {seed}, loops {enabled}', summary), flush=True)
                for loop in summary['loops']['list']:
                    print(loop_line(loop, truth), flush=True)


if __name__ == '__main__':
    main()
