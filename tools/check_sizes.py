#!/usr/bin/env python3
"""Fails where a file is over 500 lines, or where there are under 0.6 lines of test for one of source.

Prints the ratio by module. Source is what is shipped: src/ and apps/ without their *_test.cc; tests
are those and what is under tests/.
"""

import source_tree

MAX_LINES = 500
MIN_RATIO = 0.6
FOLDERS = ('src', 'apps', 'benchmark', 'tests')
OTHER_SUFFIXES = ('.py', '.sh', '.cmake')


def count_lines(path):
    return path.read_text().count('\n')


def long_files(root):
    files = source_tree.cpp_files(root, *FOLDERS)
    for folder in ('tools', 'cmake', 'tests', 'python'):
        files += sorted(p for p in (root / folder).rglob('*') if p.suffix in OTHER_SUFFIXES)
    for path in files:
        lines = count_lines(path)
        if lines > MAX_LINES:
            yield f'{path.relative_to(root)}: {lines} lines, over {MAX_LINES}'


def line_counts(root):
    """(source lines, test lines) by module; "tests" are those of no single module."""
    counts = {}
    for path in source_tree.cpp_files(root, 'src', 'apps', 'tests'):
        parts = path.relative_to(root).parts
        module = parts[2] if parts[0] == 'src' else parts[0]
        source, test = counts.get(module, (0, 0))
        if source_tree.is_test(path) or parts[0] == 'tests':
            test += count_lines(path)
        else:
            source += count_lines(path)
        counts[module] = (source, test)
    return counts


def check_tree(root):
    problems = list(long_files(root))
    counts = line_counts(root)
    source, test = (sum(column) for column in zip(*counts.values()))
    print(f'{"module":<12}{"source":>8}{"test":>8}{"ratio":>8}')
    for module, (s, t) in [*counts.items(), ('all', (source, test))]:
        print(f'{module:<12}{s:>8}{t:>8}{t / s if s else float("nan"):>8.2f}')
    if test < MIN_RATIO * source:
        problems.append(f'{test / source:.2f} lines of test for a line of source, under {MIN_RATIO}')
    return problems


if __name__ == '__main__':
    source_tree.report('sizes', check_tree(source_tree.ROOT))
