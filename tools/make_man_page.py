#!/usr/bin/env python3
"""Writes the manual page ofm-slam(1) from what the program says of itself with --help.

Usage: tools/make_man_page.py PROGRAM > ofm-slam.1
"""
import re
import subprocess
import sys

ENTRY = re.compile(r'^  (\S.*?)(?:  +(\S.*))?$')
TEXT = re.compile(r'^ {20,}(\S.*)$')


def help_of(program, words):
    return subprocess.run([program, *words, '--help'], check=True, capture_output=True, text=True).stdout


def subcommands(text):
    """Names in the section "Subcommands:" of a help text."""
    section = re.search(r'^Subcommands:\n((?:  .*\n?)*)', text, re.MULTILINE)
    return [line.split()[0] for line in section.group(1).splitlines() if ENTRY.match(line) and line[2] != ' '] \
        if section else []


def all_commands(program, words=()):
    """(words, help text) of the program and of everything under it, in the order of its help."""
    text = help_of(program, words)
    yield words, text
    for name in subcommands(text):
        yield from all_commands(program, (*words, name))


def escape(text):
    text = text.replace('\\', r'\e').replace('-', r'\-')
    return r'\&' + text if text[:1] in ".'" else text


def roff_of_options(lines):
    """Entries of the sections of positionals, options and subcommands."""
    for line in lines:
        entry, text = ENTRY.match(line), TEXT.match(line)
        if text:
            yield escape(text.group(1))
        elif entry:
            yield '.TP'
            yield r'\fB' + escape(entry.group(1)) + r'\fR'
            if entry.group(2):
                yield escape(entry.group(2))


def roff_of_help(text):
    """The body of a help text: what comes after "Usage:"."""
    for block in text.strip('\n').split('\n\n'):
        lines = block.splitlines()
        head = re.fullmatch(r'(Positionals|Options|Subcommands):', lines[0])
        if head:
            yield '.PP'
            yield rf'\fI{head.group(1)}\fR'
            yield from roff_of_options(lines[1:])
        else:
            yield '.PP'
            yield '.nf'
            yield from map(escape, lines)
            yield '.fi'


def page(program):
    version = subprocess.run([program, '--version'], check=True, capture_output=True, text=True).stdout.split()[-1]
    commands = list(all_commands(program))
    description = commands[0][1].splitlines()[0]
    yield rf'.TH OFM\-SLAM 1 "" "ofm\-slam {version}" "User Commands"'
    yield '.SH NAME'
    yield rf'ofm\-slam \- {escape(description)}'
    yield '.SH SYNOPSIS'
    yield r'\fBofm\-slam\fR \fISUBCOMMAND\fR [\fIOPTION\fR...] [\fIARGUMENT\fR...]'
    for words, text in commands:
        what, usage, body = re.fullmatch(r'(?:(.*)\n)?Usage: (.*)\n((?:.*\n?)*)', text).groups()
        yield '.SH DESCRIPTION' if not words else f'.SH {escape(" ".join(words)).upper()}'
        if what:
            yield escape(what) + '.'
            yield '.PP'
        yield rf'\fB{escape(usage)}\fR'
        yield from roff_of_help(body)
    yield '.SH EXIT STATUS'
    yield '0 where all went well; otherwise 1, and one line on the standard error stream says what to do.'


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    print('\n'.join(page(sys.argv[1])))


if __name__ == '__main__':
    main()
