#!/usr/bin/env python3
"""Runs the program over the sequences at hand with several seeds and prints docs/results.md's tables.

Usage: tools/measure_results.py --shared ../shared --sequences sequences [--seeds 5] [--only NAME ...]
The composed sequences are made by ../shared/tools/compose_dynamic.py (see ../shared/README.md).
"""
import argparse
import json
import pathlib
import statistics
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent


def configurations(shared, sequences):
    """(name, sequence, further arguments) of every row."""
    yolo = ['--segmenter', 'yolo-seg', '--model', str(shared / 'models/yolov8n-seg_480x640.onnx')]
    walking = sequences / 'desk_walking'
    return [
        ('tum_fr1_desk', shared / 'data/tum_fr1_desk', []),
        ('tum_fr1_xyz_240', shared / 'data/tum_fr1_xyz_240', []),
        ('desk_walking, no culling', walking, ['--dynamics', 'off']),
        ('desk_walking, true masks', walking, ['--segmenter', 'masks']),
        ('desk_walking, yolov8n-seg 480x640', walking, yolo),
    ]


def run(program, sequence, arguments, seed, output, camera='tum-fr1'):
    """Runs once; returns the summary."""
    command = [program, 'run', str(sequence), '--camera', camera, '--seed', str(seed), '--quiet',
               '--output', str(output), *arguments]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return json.loads((output / 'summary.json').read_text())


def row(name, summaries):
    """One line of the table: median [min-max] of the ATE in cm, and the worst coverage."""
    def ate(kind):
        return [100 * s[kind]['ate']['translation_m']['rmse'] for s in summaries]
    final, live = ate('trajectory'), ate('trajectory_live')
    coverage = min(s['counts']['tracked_share'] for s in summaries)
    thread = [s['stages']['features']['cpu']['median_ms'] + s['stages']['tracking']['cpu']['median_ms']
              for s in summaries]
    tail = [s['stages']['features']['cpu']['p99_ms'] + s['stages']['tracking']['cpu']['p99_ms']
            for s in summaries]
    frames = summaries[0]['counts']['frames']
    process = statistics.median(1e3 * s['process_cpu_s'] / frames for s in summaries)
    memory = max(s['peak_memory_mib'] for s in summaries)
    return (f'| {name} | {statistics.median(final):.2f} [{min(final):.2f}–{max(final):.2f}] '
            f'| {statistics.median(live):.2f} | {100 * coverage:.1f} % | {statistics.median(thread):.1f} / '
            f'{max(tail):.1f} | {process:.0f} | {memory:.0f} |')


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--program', default=str(ROOT / 'build/release/bin/ofm-slam'))
    parser.add_argument('--shared', type=pathlib.Path, default=ROOT / '../shared')
    parser.add_argument('--sequences', type=pathlib.Path, default=ROOT / 'sequences')
    parser.add_argument('--seeds', type=int, default=5)
    parser.add_argument('--only', nargs='*', help='rows whose name contains one of these words')
    arguments = parser.parse_args()
    print('| sequence | ATE rmse [cm], median [min–max] | live | coverage, worst | features + tracking '
          '[ms CPU], median / p99 | process [ms CPU per frame] | peak memory [MiB] |')
    print('|---|---|---|---|---|---|---|')
    for name, sequence, more in configurations(arguments.shared, arguments.sequences):
        if arguments.only and not any(word in name for word in arguments.only):
            continue
        with tempfile.TemporaryDirectory() as folder:
            summaries = [run(arguments.program, sequence, more, seed, pathlib.Path(folder) / str(seed))
                         for seed in range(1, arguments.seeds + 1)]
        print(row(name, summaries), flush=True)


if __name__ == '__main__':
    main()
