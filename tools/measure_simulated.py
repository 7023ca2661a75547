#!/usr/bin/env python3
"""Simulates the eight sequences (sitting, walking x static, xyz, rpy, halfsphere) and the same ways of the camera
without people, runs the program over them and prints docs/results.md's table.

Usage: tools/measure_simulated.py [--frames 240] [--seeds 5] [--folder simulated] [--only WORD ...]
Rows: mode full with true masks, full without a network, and off; each with the median of its ATE over the seeds, which
make other rooms, people and noise, and that over the median of mode full on the sequences without people. Sequences and
runs are kept in --folder: what is there already is not made again, so that an interrupted measurement goes on where it
ended. Delete its runs after a change of the program, all of it after a change of the simulator.
"""
import argparse
import json
import pathlib
import shutil
import statistics
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent
PATHS = ('static', 'xyz', 'rpy', 'halfsphere')
PEOPLE = ('sitting', 'walking')
METHODS = {'full, true masks': ['--dynamics', 'full', '--segmenter', 'masks'],
           'full, no network': ['--dynamics', 'full', '--segmenter', 'none'],
           'off': ['--dynamics', 'off']}
STATIC_METHOD = 'full, no network'


def simulate(bench, people, path, seed):
    """Makes a sequence unless it is there; returns its folder."""
    folder = bench.folder / f'{people}_{path}_{seed}'
    if not (folder / 'associations.txt').exists():
        shutil.rmtree(folder, ignore_errors=True)
        subprocess.run([bench.program, 'simulate', str(folder), '--scene', bench.scene, '--people', people,
                        '--path', path, '--frames', str(bench.frames), '--seed', str(seed),
                        '--noise', 'kinect', '--quiet', *bench.simulate_arguments], check=True,
                       stdout=subprocess.DEVNULL)
    return folder


def run(bench, people, path, method, seed):
    """Runs once unless that was done; returns the summary."""
    sequence = simulate(bench, people, path, seed)
    output = bench.folder / 'runs' / sequence.name / method.replace(', ', '_').replace(' ', '_')
    if not (output / 'summary.json').exists():
        subprocess.run([bench.program, 'run', str(sequence), '--seed', str(seed), '--quiet',
                        '--set', 'build_semantic_map=false', '--true-masks', str(sequence / 'mask'),
                        '--output', str(output), *METHODS[method]], check=True, stdout=subprocess.DEVNULL)
    return json.loads((output / 'summary.json').read_text())


def ate_cm(summary):
    """RMSE in cm; infinite where nothing was tracked."""
    ate = summary.get('trajectory', {}).get('ate')
    return 100 * ate['translation_m']['rmse'] if ate else float('inf')


def median_ate_cm(summaries):
    return statistics.median(map(ate_cm, summaries))


def row(name, method, summaries, static_cm):
    """One line: ATE, its ratio to the static sequences', the worst coverage, share of what moves in the pose."""
    errors = sorted(map(ate_cm, summaries))
    median = statistics.median(errors)
    spread = f'{median:.3f} [{errors[0]:.3f}–{errors[-1]:.3f}]'
    ratio = f'{median / static_cm:.2f}' if static_cm else ''
    coverage = min(summary['counts']['tracked_share'] for summary in summaries)
    shares = [summary['culling']['actor_share_in_pose'] for summary in summaries
              if (summary.get('culling') or {}).get('actor_share_in_pose') is not None]
    share = f'{100 * statistics.median(shares):.1f} %' if shares else ''
    return f'| {name} | {method} | {spread} | {ratio} | {100 * coverage:.1f} % | {share} |'


def measure(bench):
    """Yields the lines of the table."""
    seeds = range(1, bench.seeds + 1)
    yield ('| sequence | mode | ATE rmse [cm], median [min–max] | / without people | coverage, worst '
           '| features on people and chairs in the pose |')
    yield '|' + '---|' * 6
    for path in PATHS:
        wanted = [people for people in PEOPLE
                  if not bench.only or any(word in f'{people}_{path}' for word in bench.only)]
        if not wanted:
            continue
        static = [run(bench, 'none', path, STATIC_METHOD, seed) for seed in seeds]
        yield row(f'none_{path}', STATIC_METHOD, static, None)
        for people in wanted:
            for method in METHODS:
                summaries = [run(bench, people, path, method, seed) for seed in seeds]
                yield row(f'{people}_{path}', method, summaries, median_ate_cm(static))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--program', default=str(ROOT / 'build/release/bin/ofm-slam'))
    parser.add_argument('--folder', type=pathlib.Path, default=pathlib.Path('simulated'))
    parser.add_argument('--scene', default='office')
    parser.add_argument('--frames', type=int, default=240)
    parser.add_argument('--seeds', type=int, default=5, help='1 to this')
    parser.add_argument('--only', nargs='*', help='sequences whose name has one of these words')
    parser.add_argument('--simulate-arguments', nargs=argparse.REMAINDER, default=[],
                        help='all that follows goes to ofm-slam simulate, e.g. --blur')
    for line in measure(parser.parse_args()):
        print(line, flush=True)


if __name__ == '__main__':
    main()
