#!/usr/bin/env python3
"""Fails where a module includes or links one that comes after it in OFM_LAYERS.

Also fails on an include of the program's code, on one that is not written from src/, and on mutexes
outside base/ and map/. Tests may use the test world (sim) from any layer, and their own locks.
"""

import re

import source_tree

INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"')
LINKS = re.compile(r'\bofm::(\w+)')
TEST_WORLD = 'sim'
MUTEX = re.compile(r'\b(std::\w*(mutex|_lock|lock_guard|condition_variable\w*)|Mutex|MutexLock)\b|'
                   r'<(mutex|shared_mutex|condition_variable)>|"ofm/base/mutex\.h"')
MUTEX_MODULES = ('base', 'map')


def check_include(target, module, test, layers):
    """Why this module may not include the target; None where it may."""
    parts = target.split('/')
    if parts[0] != 'ofm':
        return f'"{target}" is not written from src/ (ofm/...)'
    used = parts[1]
    if used not in layers:
        return f'"{target}" is in no module of OFM_LAYERS'
    if layers.index(used) > layers.index(module) and not (test and used == TEST_WORLD):
        return f'{module} may not use {used}, a later layer'
    return None


def check_file(path, module, layers):
    test = source_tree.is_test(path)
    for number, line in enumerate(source_tree.without_comments(path.read_text()).split('\n'), 1):
        found = INCLUDE.match(line)
        reason = check_include(found.group(1), module, test, layers) if found else None
        if reason:
            yield number, reason
        if module not in MUTEX_MODULES and not test and MUTEX.search(line):
            yield number, f'mutexes live in {" and ".join(MUTEX_MODULES)} alone'


def check_links(path, module, layers):
    for number, line in enumerate(path.read_text().split('\n'), 1):
        for used in LINKS.findall(line):
            if used not in layers:
                yield number, f'ofm::{used} is no module of OFM_LAYERS'
            elif layers.index(used) > layers.index(module) and used != TEST_WORLD:
                yield number, f'{module} may not link {used}, a later layer'


def check_tree(root):
    layers = source_tree.layers(root)
    problems = []
    for folder in sorted(p for p in (root / 'src' / 'ofm').iterdir() if p.is_dir()):
        if folder.name not in layers:
            problems.append(f'src/ofm/{folder.name}: is not in OFM_LAYERS')
            continue
        for path in source_tree.cpp_files(root, f'src/ofm/{folder.name}'):
            problems += [f'{path.relative_to(root)}:{number}: {reason}'
                         for number, reason in check_file(path, folder.name, layers)]
        lists = folder / 'CMakeLists.txt'
        if lists.exists():
            problems += [f'{lists.relative_to(root)}:{number}: {reason}'
                         for number, reason in check_links(lists, folder.name, layers)]
    return problems


if __name__ == '__main__':
    source_tree.report('layers', check_tree(source_tree.ROOT))
