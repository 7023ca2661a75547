#!/usr/bin/env python3
"""Simulates the eight sequences (sitting, walking x static, xyz, rpy, halfsphere) and the same ways of the camera
without people, runs the program over them and prints docs/results.md's table.

Usage: tools/measure_simulated.py [--frames 240] [--seed 1] [--folder simulated] [--only WORD ...]
Rows: mode full with true masks, full without a network, and off; each with its ATE over that of mode full on the
sequence without people. Sequences and runs are kept in --folder: what is there already is not made again, so that an
interrupted measurement goes on where it ended. Delete it after a change of the program.
"""
import argparse
import json
import pathlib
import shutil
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent
PATHS = ('static', 'xyz', 'rpy', 'halfsphere')
PEOPLE = ('sitting', 'walking')
METHODS = {'full, true masks': ['--dynamics', 'full', '--segmenter', 'masks'],
           'full, no network': ['--dynamics', 'full', '--segmenter', 'none'],
           'off': ['--dynamics', 'off']}
STATIC_METHOD = 'full, no network'


def simulate(bench, people, path):
    """Makes a sequence unless it is there; returns its folder."""
    folder = bench.folder / f'{people}_{path}'
    if not (folder / 'associations.txt').exists():
        shutil.rmtree(folder, ignore_errors=True)
        subprocess.run([bench.program, 'simulate', str(folder), '--scene', bench.scene, '--people', people,
                        '--path', path, '--frames', str(bench.frames), '--seed', str(bench.seed),
                        '--noise', 'kinect', '--quiet', *bench.simulate_arguments], check=True,
                       stdout=subprocess.DEVNULL)
    return folder


def run(bench, sequence, method):
    """Runs once unless that was done; returns the summary."""
    output = bench.folder / 'runs' / sequence.name / method.replace(', ', '_').replace(' ', '_')
    if not (output / 'summary.json').exists():
        subprocess.run([bench.program, 'run', str(sequence), '--seed', str(bench.seed), '--quiet',
                        '--set', 'build_semantic_map=false', '--true-masks', str(sequence / 'mask'),
                        '--output', str(output), *METHODS[method]], check=True, stdout=subprocess.DEVNULL)
    return json.loads((output / 'summary.json').read_text())


def ate_cm(summary):
    """RMSE in cm; infinite where nothing was tracked."""
    ate = summary.get('trajectory', {}).get('ate')
    return 100 * ate['translation_m']['rmse'] if ate else float('inf')


def row(name, method, summary, static_cm):
    """One line: ATE, its ratio to the static sequence's, coverage, share of people among the pose's features."""
    culling = summary.get('culling') or {}
    actors = culling.get('actor_share_in_pose')
    ratio = f'{ate_cm(summary) / static_cm:.2f}' if static_cm else ''
    share = f'{100 * actors:.1f} %' if actors is not None else ''
    return (f'| {name} | {method} | {ate_cm(summary):.2f} | {ratio} '
            f'| {100 * summary["counts"]["tracked_share"]:.1f} % | {share} |')


def measure(bench):
    """Yields the lines of the table."""
    yield '| sequence | mode | ATE rmse [cm] | / without people | coverage | people\'s features in the pose |'
    yield '|' + '---|' * 6
    for path in PATHS:
        names = [f'{people}_{path}' for people in PEOPLE]
        wanted = [name for name in names if not bench.only or any(word in name for word in bench.only)]
        if not wanted:
            continue
        static = run(bench, simulate(bench, 'none', path), STATIC_METHOD)
        yield row(f'none_{path}', STATIC_METHOD, static, None)
        for name in wanted:
            sequence = simulate(bench, name.split('_')[0], path)
            for method in METHODS:
                yield row(name, method, run(bench, sequence, method), ate_cm(static))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--program', default=str(ROOT / 'build/release/bin/ofm-slam'))
    parser.add_argument('--folder', type=pathlib.Path, default=pathlib.Path('simulated'))
    parser.add_argument('--scene', default='office')
    parser.add_argument('--frames', type=int, default=240)
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--only', nargs='*', help='sequences whose name has one of these words')
    parser.add_argument('--simulate-arguments', nargs=argparse.REMAINDER, default=[],
                        help='all that follows goes to ofm-slam simulate, e.g. --blur')
    for line in measure(parser.parse_args()):
        print(line, flush=True)


if __name__ == '__main__':
    main()
