#!/usr/bin/env python3
"""Runs scenarios with and without culling, measures their maps and prints docs/results.md's table.

Usage: tools/measure_map.py --shared ../shared --sequences sequences --masks masks/yolov8n-seg_480x640
       [--resolutions 0.05 0.02] [--only WORD ...]
Culling is off, goes by true masks, or by what a network found: --masks holds a folder per scenario as
`run --write-masks` makes it (tools/measure_dynamics.py writes them too); without it those rows are left out.
What is counted (`ofm-slam evaluate-map --help`; the room without actors is the real recording that the scenarios
are composed from, with its true poses):
- actor voxels left: of the voxels that actors alone ever filled, those occupied in map.ot;
- surface mapped: of the voxels that the surface of the room without actors fills, those occupied in map.ot or next to
  one that is;
- of what any frame shows: the same of those voxels that the scenario's frames show at all;
- accuracy: the median distance of map.ply's points from that surface, point to plane.
"""
import argparse
import json
import pathlib
import subprocess
import tempfile

import measure_results

SCENARIOS = ('desk_walking', 'desk_standing', 'desk_box', 'desk_crowded')
STATIC = 'tum_fr1_desk'
HEADER = ('| scenario | culling | resolution | actor voxels left | surface mapped | of what any frame shows '
          '| accuracy [mm] | points off the surface | ATE [cm] |')


def configurations(masks):
    """(scenario, culling, further arguments) of every row but for the resolution."""
    for scenario in SCENARIOS:
        yield scenario, 'off', ['--dynamics', 'off', '--segmenter', 'none']
        yield scenario, 'true masks', ['--segmenter', 'masks']
        if masks:
            folder = masks / scenario
            yield scenario, masks.name, ['--segmenter', 'masks', '--set', f'perception.masks_folder={folder}']


def measure(bench, scenario, more, resolution_m):
    """Runs once and evaluates the map; returns both reports."""
    sequence = bench.sequences / scenario
    with tempfile.TemporaryDirectory() as name:
        output = pathlib.Path(name)
        arguments = [*more, '--set', f'dense.resolution_m={resolution_m}']
        summary = measure_results.run(bench.program, sequence, arguments, bench.seed, output, bench.camera)
        report = output / 'map.json'
        subprocess.run([bench.program, 'evaluate-map', str(output), str(sequence), '--static',
                        str(bench.shared / 'data' / STATIC), '--json', str(report)],
                       check=True, stdout=subprocess.DEVNULL)
        return summary, json.loads(report.read_text())


def row(scenario, culling, summary, figures):
    """One line of the table."""
    off = figures['points_off_surface'] / figures['points'] if figures['points'] else 0
    seen_mapped = figures['surface_voxels_seen_mapped'] / max(1, figures['surface_voxels_seen'])
    ate_cm = 100 * summary['trajectory']['ate']['translation_m']['rmse']
    return (f'| {scenario} | {culling} | {100 * figures["resolution_m"]:.0f} cm '
            f'| {figures["actor_voxels_occupied"]} of {figures["actor_voxels"]} '
            f'({100 * figures["actor_residue_share"]:.2f} %) '
            f'| {100 * figures["surface_share_mapped"]:.1f} % | {100 * seen_mapped:.1f} % '
            f'| {1e3 * figures["median_distance_m"]:.1f} | {100 * off:.1f} % | {ate_cm:.2f} |')


def is_wanted(words, names):
    return not words or all(any(word in name for name in names) for word in words)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--program', default=str(measure_results.ROOT / 'build/release/bin/ofm-slam'))
    parser.add_argument('--shared', type=pathlib.Path, default=measure_results.ROOT / '../shared')
    parser.add_argument('--sequences', type=pathlib.Path, default=measure_results.ROOT / 'sequences')
    parser.add_argument('--masks', type=pathlib.Path, help="a network's masks, a folder per scenario")
    parser.add_argument('--camera', default='tum-fr1', help='of run; a file with another depth_delay_s, say')
    parser.add_argument('--resolutions', type=float, nargs='*', default=[0.05, 0.02], help='[m]')
    parser.add_argument('--seed', type=int, default=0)
    parser.add_argument('--only', nargs='*', help='rows with all of these words in scenario or culling')
    bench = parser.parse_args()
    print(HEADER)
    print('|' + '---|' * 9)
    for scenario, culling, more in configurations(bench.masks):
        if not is_wanted(bench.only, (scenario, culling)):
            continue
        for resolution_m in bench.resolutions:
            print(row(scenario, culling, *measure(bench, scenario, more, resolution_m)), flush=True)


if __name__ == '__main__':
    main()
