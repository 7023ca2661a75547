"""What the checks of this folder know of the source tree."""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
COMMENT = re.compile(r'//[^\n]*|/\*.*?\*/', re.DOTALL)


def layers(root):
    """The modules in CMakeLists.txt's order: each may use those before it."""
    text = (root / 'CMakeLists.txt').read_text()
    found = re.search(r'set\(OFM_LAYERS\s+([^)]*)\)', text)
    if not found:
        raise SystemExit('CMakeLists.txt: OFM_LAYERS is not set')
    return found.group(1).split()


def cpp_files(root, *folders):
    """The C++ files below the folders, in order."""
    files = [p for folder in folders for p in (root / folder).rglob('*')]
    return sorted(p for p in files if p.suffix in ('.h', '.cc'))


def is_test(path):
    return path.stem.endswith('_test')


def without_comments(text):
    """The text with its comments blanked out, line numbers unchanged."""
    return COMMENT.sub(lambda m: '\n' * m.group().count('\n'), text)


def report(what, problems):
    """Prints the problems, or that there are none, and ends with the matching status."""
    for problem in problems:
        print(problem)
    print(f'{what}: {len(problems)} problem(s)' if problems else f'{what}: ok')
    sys.exit(1 if problems else 0)
