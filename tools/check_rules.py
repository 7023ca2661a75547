#!/usr/bin/env python3
"""Fails where the library does what a library must not, or what makes two runs differ."""

import re

import source_tree

# Each with its reason. Tests are free of them.
FORBIDDEN = (
    (r'\bstd::(cout|cerr|clog)\b|\bf?printf\(|\bputs\(', 'the library logs through spdlog'),
    (r'\b(std::)?(exit|abort|_exit|quick_exit|terminate)\(', 'the library throws, and never ends the process'),
    (r'\bstd::(uniform_\w+|normal|bernoulli|discrete)_?(int_|real_)?distribution\b|\bstd::(shuffle|sample)\b',
     'its draws depend on the standard library; see ofm/base/random.h'),
    (r'\bstd::random_device\b|\bs?rand\(|\bcv::theRNG\b|\bcv::randu\b|\bcv::randn\b',
     'draws come from ofm::MakeRandomEngine'),
    (r'\busleep\(|\bnanosleep\(|\bsleep_for\(', 'nothing sleeps to synchronise'),
)


def check_tree(root):
    problems = []
    for path in source_tree.cpp_files(root, 'src'):
        if source_tree.is_test(path):
            continue
        for number, line in enumerate(source_tree.without_comments(path.read_text()).split('\n'), 1):
            problems += [f'{path.relative_to(root)}:{number}: {reason}'
                         for pattern, reason in FORBIDDEN if re.search(pattern, line)]
    return problems


if __name__ == '__main__':
    source_tree.report('rules', check_tree(source_tree.ROOT))
