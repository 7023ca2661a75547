"""What is made from the program's help must say what the program says."""

import os
import pathlib
import re
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = os.environ['OFM_PROGRAM']
sys.path.insert(0, str(ROOT / 'tools'))

import make_configuration_reference  # noqa: E402
import make_man_page  # noqa: E402


class ConfigurationReference(unittest.TestCase):

    def test_is_that_of_the_program(self):
        yaml = subprocess.run([PROGRAM, 'run', '--print-config'], check=True, capture_output=True, text=True).stdout
        self.assertEqual((ROOT / 'docs/configuration.md').read_text(), make_configuration_reference.reference(yaml),
                         'run tools/make_configuration_reference.py PROGRAM > docs/configuration.md')

    def test_has_a_row_for_each_setting(self):
        rows = list(make_configuration_reference.settings(
            'seed: 0  # of all (int)\nflow:\n  points:\n    count: 3  # a | b (c) (real)\n  name: ""  # text (text)\n'))
        self.assertEqual([row[1] for row in rows], ['seed', 'flow.points.count', 'flow.name'])
        self.assertEqual(rows[1], ('flow.points', 'flow.points.count', '3', 'a | b (c)', 'real'))


class ManPage(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.commands = list(make_man_page.all_commands(PROGRAM))
        cls.page = '\n'.join(make_man_page.page(PROGRAM))

    def test_has_every_subcommand_and_option(self):
        self.assertGreater(len(self.commands), 10)
        for words, text in self.commands:
            for option in re.findall(r'^  (?:-\w,)?(--[\w-]+)', text, re.MULTILINE):
                self.assertIn(option.replace('-', r'\-'), self.page, words)
            if words:
                self.assertIn(' '.join(words).replace('-', r'\-').upper(), self.page)

    def test_no_line_is_taken_for_a_request(self):
        requests = {line.split()[0] for line in self.page.splitlines() if line.startswith('.')}
        self.assertEqual(requests, {'.TH', '.SH', '.PP', '.TP', '.nf', '.fi'})


class Completion(unittest.TestCase):

    def complete(self, *words):
        script = ('source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _ofm_slam; '
                  'printf "%s\\n" "${COMPREPLY[@]}"')
        path = ROOT / 'completions/ofm-slam.bash'
        result = subprocess.run(['bash', '-c', script, 'bash', str(path), PROGRAM, *words], check=True,
                                capture_output=True, text=True, cwd=ROOT / 'docs')
        self.assertEqual(result.stderr, '')
        return result.stdout.split()

    def test_offers_subcommands(self):
        self.assertEqual(self.complete('evaluate-m'), ['evaluate-map'])
        self.assertIn('import', self.complete('vocabulary', ''))

    def test_offers_the_options_of_the_subcommand(self):
        self.assertEqual(self.complete('run', 'somewhere', '--dyn'), ['--dynamics'])
        self.assertNotIn('--dynamics', self.complete('evaluate', '--'))

    def test_offers_what_an_option_may_be(self):
        self.assertEqual(self.complete('run', '--dynamics', 'p'), ['paper'])

    def test_offers_files(self):
        self.assertIn('frames.md', self.complete('run', 'fra'))


if __name__ == '__main__':
    unittest.main()
