#!/usr/bin/env python3
"""Writes docs/configuration.md from the settings that the program prints: name, default, meaning of each.

Usage: tools/make_configuration_reference.py PROGRAM > docs/configuration.md
"""
import re
import subprocess
import sys

LINE = re.compile(r'^( *)([\w.]+):(?: (.*?))?(?:  # (.*) \(([^()]*)\))?$')

HEAD = '''# Settings

Made by `tools/make_configuration_reference.py build/release/bin/ofm-slam > docs/configuration.md`; do not edit.

Every setting has a name. `ofm-slam run --print-config > my.yaml` writes them all, `--config my.yaml` reads a file (what
it does not name keeps its default), `--set features.count=1500` sets one. An unknown name, a value of the wrong type or
out of range is an error that names the file and line. What a run used is in `config.yaml` beside its results.
`configs/paper.yaml` is the OFM-SLAM paper to the letter.
'''


def settings(yaml):
    """(section, name, default, meaning, type) of each line that has a value."""
    path = []
    for line in yaml.splitlines():
        found = LINE.match(line)
        if not found:
            raise SystemExit(f'cannot read the line: {line}')
        indent, name, value, meaning, kind = found.groups()
        path = path[:len(indent) // 2]
        if value is None:
            path.append(name)
        else:
            yield '.'.join(path), '.'.join([*path, name]), value, meaning or '', kind or ''


def cell(text):
    return text.replace('|', '\\|')


def reference(yaml):
    lines, last = [HEAD], None
    for section, name, value, meaning, kind in settings(yaml):
        if section != last:
            lines += ['', f'## {section or "General"}', '', '| setting | default | type | meaning |', '|---|---|---|---|']
            last = section
        lines.append(f'| `{name}` | `{cell(value)}` | {cell(kind)} | {cell(meaning)} |')
    return '\n'.join(lines).replace('\n\n\n', '\n\n') + '\n'


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    yaml = subprocess.run([sys.argv[1], 'run', '--print-config'], check=True, capture_output=True, text=True).stdout
    print(reference(yaml), end='')


if __name__ == '__main__':
    main()
