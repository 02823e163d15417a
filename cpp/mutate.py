#!/usr/bin/env python3
"""Small faults in the C++ runtime, one at a time: which of them do its tests not notice?

In: headers of the runtime (by default those that hand data over, and those of tasks), and cpp/survivors.txt, the mutants that nothing
notices and why. Out: each mutant that survives; exit code 1 if one of them is not in the list, or one of the list is noticed or not
made. A mutant is one token that becomes another one. It is judged by the tests that include its header, then by the stress test under
ThreadSanitizer. A memory order that is too weak is judged by all of them under ThreadSanitizer alone: without it, no test sees one.

What a test said of a mutant is kept in target/cpp-mutants.txt, by a hash of all that it is compiled from. So a run that was ended goes
on where it was, and after a change of a test only that test is asked again. Without that file, all is judged anew.

Usage: cpp/mutate.py [--every N] [--jobs N] [--all | --list] [HEADER...]
"""

import argparse
import collections
import concurrent.futures
import functools
import hashlib
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time

HERE = pathlib.Path(__file__).resolve().parent
INCLUDE = HERE / "include"
KEPT = HERE.parent / "target" / "cpp-mutants.txt"
HEADERS = ["asynchronous_task", "locked_buffer", "message_queue", "pair_lock", "periodic_task", "semaphore", "swinging_buffer",
           "task", "wait_free_buffer", "watchdog"]
COMPILE = ["g++", "-std=c++20", "-w", "-pthread"]
PLAIN = ("-O0",)
THREAD = ("-O0", "-g1", "-fsanitize=thread", "-fno-builtin")
# A test may take ten times as long as with the headers as they are, and two seconds in any case; what waits for ever is a fault.
SLACK, LEAST_S = 10, 2
# The first fault that is noticed is enough.
HASTE = os.environ | {"GTEST_FAIL_FAST": "1", "TSAN_OPTIONS": "halt_on_error=1"}

TOKEN = re.compile(r"""
    //[^\n]* | /\*.*?\*/ | "(?:\\.|[^"\\\n])*" | '(?:\\.|[^'\\\n])*' | ^[ \t]*\#[^\n]*
  | [0-9][\w.']*
  | <=> | \+\+ | -- | -> | << | >> | && | \|\| | [<>=!+\-*/%&|^]=? | [A-Za-z_]\w* | \S
""", re.VERBOSE | re.MULTILINE | re.DOTALL)
OTHERS = {"==": ["!="], "!=": ["=="], "<=": ["<"], ">=": [">"], "||": ["&&"], "++": ["--"], "--": ["++"],
          "+=": ["-="], "-=": ["+="], "true": ["false"], "false": ["true"]}
SPACED = {"<": ["<=", ">="], ">": [">=", "<="], "+": ["-"], "-": ["+"], "&&": ["||"]}


def mutants(text):
    """Pairs of a range of the text and what comes there."""
    for token in TOKEN.finditer(text):
        word, start, end = token.group(), token.start(), token.end()
        spaced = text[start - 1:start] == " " and text[end:end + 1] == " "
        others = OTHERS.get(word, [])
        if not is_run(text, start):
            others = []
        elif word.startswith("memory_order_") and word != "memory_order_relaxed":
            others = ["memory_order_relaxed"]
        elif word in SPACED and spaced:
            # Angle brackets of templates stand without spaces, and so do references.
            others = SPACED[word]
        elif word == "!" and text[end:end + 1] not in " =":
            others = [""]
        elif word.isdigit():
            others = [str(int(word) + 1)]
        for other in others:
            yield start, end, other


def is_run(text, start):
    """Whether a line does something: it is no type, no alignment, and no assertion, which only says what callers must keep."""
    line = text[text.rfind("\n", 0, start) + 1:text.find("\n", start)]
    return not re.search(r"alignas|assert\(|template|operator|= delete|= default|#", line)


@functools.cache
def reached(file):
    """The headers of the runtime that a file includes."""
    found, open_files = set(), [file]
    while open_files:
        for name in re.findall(r'#include ["<](?:groundstate/)?([\w/]+\.hpp)[">]', open_files.pop().read_text()):
            header = INCLUDE / "groundstate" / name
            if header.exists() and header not in found:
                found.add(header)
                open_files.append(header)
    return found


def judges_of(header, other=""):
    """Pairs of a test that includes a header and of flags: those that are about it alone first, since they notice most; the stress
    test last."""
    tests = [test for test in sorted((HERE / "tests").glob("*_test.cpp"))
             if test.stem not in ("allocation_test", "mcap_file_test") and header in reached(test)]
    tests.sort(key=lambda test: len(reached(test)))
    stress = HERE / "tests" / "stress.cpp"
    if other.startswith("memory_order_"):
        return [(stress, THREAD), *((test, THREAD) for test in tests)]
    return [*((test, PLAIN) for test in tests), (stress, THREAD)]


class Bench:
    """Where programs are compiled and run, from the headers as they are or with one of them replaced; what they said is kept."""

    def __init__(self, folder):
        self.folder, self.lock = folder, threading.Lock()
        self.compiler = subprocess.run([COMPILE[0], "--version"], capture_output=True, text=True, check=True).stdout.splitlines()[0]
        KEPT.parent.mkdir(exist_ok=True)
        lines = KEPT.read_text().splitlines() if KEPT.exists() else []
        self.kept = {words[0]: (words[1], float(words[2])) for line in lines if len(words := line.split()) == 3}
        # What programs include of others' headers is compiled once for each set of flags.
        programs = {*INCLUDE.glob("groundstate/*.hpp"), *(HERE / "tests").glob("*_test.cpp")}
        others = {name for file in programs for name in re.findall(r"#include <([\w/.]+)>", file.read_text())}
        for flags in (PLAIN, THREAD):
            self.common(flags).parent.mkdir()
            self.common(flags).write_text("".join(f"#include <{name}>\n" for name in sorted(others) if not name.startswith("groundstate/")))
            subprocess.run([*COMPILE, *flags, "-x", "c++-header", str(self.common(flags))], check=True)

    def common(self, flags):
        return self.folder / f"common-{len(flags)}" / "common.hpp"

    def asked(self, test, flags, header=None, text=None):
        """What a test says, and after how many seconds: `passed`, `failed`, `endless`, or `refused` if it cannot be compiled."""
        parts = [self.compiler, *COMPILE, *flags, test.name, test.read_text()]
        for each in sorted(reached(test)):
            parts += [each.name, text if each == header else each.read_text()]
        key = hashlib.sha256("\0".join(parts).encode()).hexdigest()
        if key not in self.kept:
            limit_s = max(LEAST_S, SLACK * self.asked(test, flags)[1]) if header else None
            with tempfile.TemporaryDirectory(dir=self.folder) as name:
                said, seconds = self.tried(pathlib.Path(name), test, flags, header, text, limit_s)
            with self.lock, KEPT.open("a") as file:
                file.write(f"{key} {said} {seconds:.3f}\n")
            self.kept[key] = said, seconds
        return self.kept[key]

    def tried(self, folder, test, flags, header, text, limit_s):
        # Headers include each other by names beside them, so all of them stand beside the one that is replaced.
        (folder / "groundstate").mkdir()
        for each in (INCLUDE / "groundstate").iterdir():
            if each != header:
                (folder / "groundstate" / each.name).symlink_to(each)
        if header:
            (folder / "groundstate" / header.name).write_text(text)
        libraries = ["-lgtest", "-lgtest_main"] if test.stem.endswith("_test") else []
        compiled = subprocess.run([*COMPILE, *flags, f"-I{folder}", f"-I{HERE / 'tests'}", "-include", str(self.common(flags)), str(test),
                                   "-o", str(folder / "program"), *libraries], capture_output=True)
        if compiled.returncode != 0:
            return "refused", 0
        start = time.monotonic()
        program = subprocess.Popen([str(folder / "program")], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, cwd=folder,
                                   env=HASTE, start_new_session=True)
        try:
            said = "passed" if program.wait(limit_s) == 0 else "failed"
        except subprocess.TimeoutExpired:
            said = "endless"
        # A test of what must die has children, which may wait for ever, too.
        try:
            os.killpg(program.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        program.wait()
        return said, time.monotonic() - start

    def judged(self, header, start, end, other):
        """Who noticed a mutant: a name, `refused` if it cannot be compiled, none if it survived."""
        text = header.read_text()
        for test, flags in judges_of(header, other):
            said, _ = self.asked(test, flags, header, text[:start] + other + text[end:])
            if said == "refused":
                return said
            if said != "passed":
                return name_of(test, flags) + (" without end" if said == "endless" else "")
        return None


def name_of(test, flags):
    return test.stem + (" under ThreadSanitizer" if flags == THREAD else "")


def told(header, start, end, other):
    """A mutant as a line of the list: it stays the same when lines move."""
    text = header.read_text()
    first, last = text.rfind("\n", 0, start) + 1, text.find("\n", start)
    before, line = text[first:start], text[first:last]
    changed = f"{before}{other}{text[end:last]}"
    return f"{header.name}: {' '.join(line.split())} => {' '.join(changed.split())}"


def listed():
    """What is known to survive, and why."""
    file = HERE / "survivors.txt"
    known = {}
    for number, line in enumerate(file.read_text().splitlines() if file.exists() else [], 1):
        if not line.strip() or line.startswith("#"):
            continue
        mutant, mark, reason = line.partition(" // because ")
        if not mark or not reason.strip():
            sys.exit(f"cpp/survivors.txt:{number}: a mutant, ` // because `, and the reason")
        known[mutant.strip()] = reason
    return known


def main():
    parser = argparse.ArgumentParser(description="mutants of the C++ runtime")
    parser.add_argument("headers", nargs="*", default=HEADERS, metavar="HEADER")
    parser.add_argument("--every", type=int, default=1, metavar="N", help="only every Nth mutant")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), metavar="N")
    parser.add_argument("--all", action="store_true", help="tell what became of each")
    parser.add_argument("--list", action="store_true", help="list the mutants and judge none")
    arguments = parser.parse_args()
    if arguments.every < 1 or arguments.jobs < 1:
        parser.error("--every and --jobs take a number from 1")
    headers = [INCLUDE / "groundstate" / f"{name.removesuffix('.hpp')}.hpp" for name in arguments.headers]
    for header in headers:
        if not header.exists():
            parser.error(f"{header.name} is no header of the runtime")
        if len(judges_of(header)) == 1:
            parser.error(f"no test includes {header.name}")
    made = [(header, *mutant) for header in headers for mutant in mutants(header.read_text())]
    chosen = made[::arguments.every]
    if arguments.list:
        for mutant in chosen:
            print(told(*mutant))
        return
    known, by, wrong = listed(), collections.Counter(), []
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        bench = Bench(pathlib.Path(folder))
        # As they are, the tests pass, or whoever fails them says nothing.
        for test, flags in sorted({judge for header, _, _, other in chosen for judge in judges_of(header, other)}):
            if bench.asked(test, flags)[0] != "passed":
                sys.exit(f"{name_of(test, flags)} does not pass as it is")
        for mutant, said in zip(chosen, pool.map(lambda mutant: bench.judged(*mutant), chosen)):
            line = told(*mutant)
            by[said] += 1
            if arguments.all:
                print(f"{said or 'survived'}: {line}", flush=True)
            if said is None and line not in known:
                wrong.append(f"survived: {line}")
                print(wrong[-1], flush=True)
            elif said not in (None, "refused") and line in known:
                wrong.append(f"noticed by {said}, and still in cpp/survivors.txt: {line}")
    if arguments.every == 1 and arguments.headers == HEADERS:
        lines = {told(*mutant) for mutant in made}
        wrong += [f"in cpp/survivors.txt, but not made: {line}" for line in known if line not in lines]
    print("\n".join(line for line in wrong if not line.startswith("survived: ")))
    for name in sorted(by.keys() - {None, "refused"}, key=by.get, reverse=True):
        print(f"{by[name]:5} noticed by {name}")
    print(f"{len(chosen)} of {len(made)} mutants: {by.total() - by[None] - by['refused']} noticed, {by[None]} survived, "
          f"{by['refused']} not compiled")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
