#!/usr/bin/env python3
"""Runs every scenario with every mode of culling and every segmenter and prints docs/results.md's table.

Usage: tools/measure_dynamics.py --shared ../shared --sequences sequences [--seeds 5] [--only WORD ...]
A network runs once per scenario (run --write-masks into --masks), and the runs of all modes and seeds go by what
it found: the results are the same bytes as with the network itself, and its time is added to theirs.
Each finished run is kept in --record (JSON lines): a run that is there already is not made again, so that an
interrupted measurement goes on where it ended. Delete both after a change of the program.
Seeds decide RANSAC's draws alone, which most runs hardly ask for. --vary-features STEP shows how much of a difference
between two rows is luck: run k of N has 1000 + STEP (k - (N + 1) / 2) features (keep these runs in a --record of theirs).
The run in the middle measures the culling too.
The composed sequences are made by ../shared/tools/compose_dynamic.py (see ../shared/README.md).
"""
import argparse
import concurrent.futures
import json
import pathlib
import statistics
import tempfile

import measure_results

SCENARIOS = ('desk_walking', 'desk_standing', 'desk_box', 'desk_crowded')
MODES = ('off', 'paper', 'full')
STATIC = 'tum_fr1_desk'
FIRST_SEED = 1
FRONT_STAGES = ('image_pyramid', 'optical_flow', 'dense_flow', 'dynamics', 'features', 'tracking')


def segmenters(with_all):
    """The network's file by the segmenter's name; empty where there is none. Networks come last."""
    kinds = {'none': '', 'true masks': '', 'yolov8n 256x320': 'yolov8n-seg_256x320',
             'yolo11n 384x512': 'yolo11n-seg_384x512'}
    if with_all:
        kinds['yolov8n 480x640'] = 'yolov8n-seg_480x640'
    return kinds


def configurations(with_all):
    """(scenario, mode, segmenter); nothing is segmented for mode off, which ignores it."""
    yield STATIC, 'full', 'none'
    for segmenter in segmenters(with_all):
        for scenario in SCENARIOS:
            for mode in MODES:
                if mode != 'off' or segmenter == 'none':
                    yield scenario, mode, segmenter


def run_network(bench, scenario, network):
    """Writes a network's masks of a scenario; returns their folder. A finished one is not made again."""
    folder = bench.masks / network / scenario
    if not (folder / 'summary.json').exists():
        arguments = ['--segmenter', 'yolo-seg', '--model', str(bench.shared / 'models' / f'{network}.onnx'),
                     '--dynamics', 'off', '--write-masks', str(folder), '--set', 'build_semantic_map=false']
        with tempfile.TemporaryDirectory() as output:
            summary = measure_results.run(bench.program, bench.sequences / scenario, arguments, 0, pathlib.Path(output))
        (folder / 'summary.json').write_text(json.dumps(summary))
    return folder


def figures(summary, network_summary):
    """What the table needs of a run's summary; the time of reading masks is replaced by the network's."""
    stages = summary['stages']
    front = sum(stages[s]['cpu']['median_ms'] for s in FRONT_STAGES if s in stages)
    culling = summary.get('culling', {})
    process_ms = 1e3 * summary['process_cpu_s'] / summary['counts']['frames']
    segmentation = stages['segmentation']['cpu']
    if network_summary:
        process_ms -= segmentation['mean_ms']
        segmentation = network_summary['stages']['segmentation']['cpu']
        process_ms += segmentation['mean_ms']
    return {'ate_cm': 100 * summary['trajectory']['ate']['translation_m']['rmse'],
            'coverage': summary['counts']['tracked_share'],
            'reckoned': summary['counts']['frames_reckoned'],
            'front_ms': front, 'segmentation_ms': segmentation['median_ms'], 'process_ms': process_ms,
            'actor_in_pose': culling.get('actor_share_in_pose'),
            'static_kept': culling.get('static_share_kept')}


def measure(bench, configuration, seed):
    scenario, mode, segmenter = configuration
    sequence = bench.shared / 'data' / STATIC if scenario == STATIC else bench.sequences / scenario
    network = segmenters(True)[segmenter]
    arguments = ['--dynamics', mode, '--set', 'build_semantic_map=false']
    arguments += ['--segmenter', 'none' if segmenter == 'none' else 'masks']
    network_summary = None
    if network:
        folder = bench.masks / network / scenario
        arguments += ['--set', f'perception.masks_folder={folder}']
        network_summary = json.loads((folder / 'summary.json').read_text())
    middle_seed = (bench.seeds + 1) // 2
    if bench.vary_features:
        count = 1000 + bench.vary_features * (seed - middle_seed)
        arguments += ['--set', f'features.count={count}']
    if scenario != STATIC and seed == middle_seed:  # measuring culling takes long and hardly depends on the seed
        arguments += ['--true-masks', str(sequence / 'mask')]
    with tempfile.TemporaryDirectory() as output:
        summary = measure_results.run(bench.program, sequence, arguments, seed, pathlib.Path(output))
    return {'scenario': scenario, 'mode': mode, 'segmenter': segmenter, 'seed': seed,
            **figures(summary, network_summary)}


def row(key, runs, static_cm):
    """One line: median [min-max] of the ATE, its ratio to the static sequence's, the worst coverage."""
    ate = [r['ate_cm'] for r in runs]
    ratio = f'{statistics.median(ate) / static_cm:.2f}' if static_cm else ''
    def share(name):
        values = [r[name] for r in runs if r[name] is not None]
        return f'{100 * statistics.median(values):.1f} %' if values else ''
    def milliseconds(name):
        return f'{statistics.median(r[name] for r in runs):.0f}'
    return (f'| {" | ".join(key)} | {len(runs)} | {statistics.median(ate):.2f} [{min(ate):.2f}–{max(ate):.2f}] '
            f'| {ratio} | {100 * min(r["coverage"] for r in runs):.1f} % | {share("actor_in_pose")} '
            f'| {share("static_kept")} | {milliseconds("front_ms")} | {milliseconds("segmentation_ms")} '
            f'| {milliseconds("process_ms")} |')


def print_table(runs):
    groups = {}
    for run in runs:
        groups.setdefault((run['scenario'], run['mode'], run['segmenter']), []).append(run)
    base = [r['ate_cm'] for r in groups.get((STATIC, 'full', 'none'), [])]
    static_cm = statistics.median(base) if base else None
    print('| scenario | mode | segmenter | runs | ATE rmse [cm], median [min–max] | / static | coverage, worst '
          '| actor features in the pose | static features kept | culling + features + tracking [ms CPU] '
          '| segmentation [ms CPU] | process [ms CPU per frame] |')
    print('|' + '---|' * 12)
    for key in sorted(groups):
        print(row(key, groups[key], static_cm))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--program', default=str(measure_results.ROOT / 'build/release/bin/ofm-slam'))
    parser.add_argument('--shared', type=pathlib.Path, default=measure_results.ROOT / '../shared')
    parser.add_argument('--sequences', type=pathlib.Path, default=measure_results.ROOT / 'sequences')
    parser.add_argument('--seeds', type=int, default=5)
    parser.add_argument('--jobs', type=int, default=2, help='runs at a time')
    parser.add_argument('--masks', type=pathlib.Path, default=pathlib.Path('dynamics_masks'))
    parser.add_argument('--all', action='store_true', help='with yolov8n 480x640 too')
    parser.add_argument('--record', type=pathlib.Path, default=pathlib.Path('dynamics_runs.jsonl'))
    parser.add_argument('--vary-features', type=int, default=0, metavar='STEP', help='of features.count; 0 = none')
    parser.add_argument('--only', nargs='*', help='configurations with all of these words (scenario, mode, segmenter)')
    arguments = parser.parse_args()
    runs = []
    if arguments.record.exists():
        runs = [json.loads(line) for line in arguments.record.read_text().splitlines()]
    done = {(r['scenario'], r['mode'], r['segmenter'], r['seed']) for r in runs}
    wanted = [(c, seed) for seed in range(FIRST_SEED, FIRST_SEED + arguments.seeds) for c in configurations(arguments.all)
              if (*c, seed) not in done
              and all(any(word in part for part in c) for word in arguments.only or [])]
    networks = sorted({(c[0], segmenters(True)[c[2]]) for c, _ in wanted if segmenters(True)[c[2]]})
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool, arguments.record.open('a') as record:
        list(pool.map(lambda network: run_network(arguments, *network), networks))
        futures = [pool.submit(measure, arguments, c, seed) for c, seed in wanted]
        for future in concurrent.futures.as_completed(futures):
            runs.append(future.result())
            record.write(json.dumps(runs[-1]) + '\n')
            record.flush()
    print_table(runs)


if __name__ == '__main__':
    main()
