#!/usr/bin/env python3
"""Follows a page word by word: usage PAGE FOLDER [ROOT].

In FOLDER (of a Debian in ROOT, by chroot), as a reader would, block after block. Below a line that ends with `FILE`: the
block is written to that file, or if it is a diff, changes it: lines that begin with - become those that begin with +, at
the only place where they and those between stand; `...` parts one change from the next. A line `$ COMMAND` is run, and
what it prints is what stands below it, where `...` stands for any lines, and <...> for any text within a line. A command
whose exit code is not 0 is an error.
"""
import os
import re
import subprocess
import sys


def blocks(page):
    """Of each fenced block: its first line's number, the file above it or None, if it is a diff, and its lines."""
    file, lines, begin, is_diff = None, None, 0, False
    for number, line in enumerate(page.splitlines(), 1):
        if line.startswith("```"):
            if lines is None:
                lines, begin, is_diff = [], number + 1, line == "```diff"
            else:
                yield begin, file, is_diff, lines
                file, lines = None, None
        elif lines is not None:
            lines.append(line)
        elif line.strip():
            named = re.search(r"`([\w./]+)`:$", line)
            file = named[1] if named else None


def changed(text, lines):
    """The text of a file after the changes of a diff."""
    hunks = [[]]
    for line in lines:
        if line == "...":
            hunks.append([])
        else:
            hunks[-1].append(line)
    for hunk in hunks:
        old = "".join(line[1:] + "\n" for line in hunk if line[:1] != "+")
        new = "".join(line[1:] + "\n" for line in hunk if line[:1] != "-")
        if text.count(old) != 1:
            sys.exit(f"{text.count(old)} places, not one, have:\n{old}")
        text = text.replace(old, new)
    return text


def write(place, is_diff, lines):
    os.makedirs(os.path.dirname(place), exist_ok=True)
    text = "\n".join(lines) + "\n"
    if is_diff:
        with open(place, encoding="utf-8") as file:
            text = changed(file.read(), lines)
    with open(place, "w", encoding="utf-8") as file:
        file.write(text)


def commands(begin, lines):
    """Of each command: its line's number, itself, and what it is to print."""
    found = []
    for number, line in enumerate(lines, begin):
        if line.startswith("$ "):
            found.append((number, line[2:], []))
        elif found:
            found[-1][2].append(line)
    return found


def pattern(expected):
    """A regular expression of what is to be printed."""
    text = ""
    for line in expected:
        if line == "...":
            text += r"(?:.*\n)*?"
        else:
            text += r".*?".join(re.escape(part) for part in line.split("<...>")) + r"\n"
    return re.compile(text)


def run(command, folder, root):
    """Its exit code, what it printed, and the folder that it leaves behind."""
    read, write = os.pipe()
    text = f"cd '{folder}'\n{command}\ncode=$?; pwd >&{write}; exit $code"
    done = subprocess.run((["chroot", root] if root else []) + ["bash", "-c", text], pass_fds=[write],
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    os.close(write)
    with os.fdopen(read) as end:
        return done.returncode, done.stdout, end.read().strip() or folder


def main():
    path, folder = sys.argv[1], os.path.abspath(sys.argv[2])
    root = sys.argv[3] if len(sys.argv) > 3 else ""
    followed = 0
    with open(path, encoding="utf-8") as file:
        page = file.read()
    for begin, file, is_diff, lines in blocks(page):
        if file:
            write(os.path.join(root + folder, file), is_diff, lines)
        for number, command, expected in commands(begin, lines):
            code, output, folder = run(command, folder, root)
            followed += 1
            if code != 0 or not pattern(expected).fullmatch(output):
                print(f"{path}:{number}: $ {command}\nexit code {code}, printed:\n{output}")
                return 1
    print(f"{path}: {followed} commands do what it says")
    return 0 if followed else 1


if __name__ == "__main__":
    sys.exit(main())
