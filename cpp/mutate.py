#!/usr/bin/env python3
"""Small faults in the C++ runtime, one at a time: which of them do its tests not notice?

In: headers of the runtime (by default those that hand data over, and those of tasks), and cpp/survivors.txt, the mutants that nothing
notices and why. Out: each mutant that survives; exit code 1 if one of them is not in the list, or one of the list is noticed or not
made. A mutant is one token that becomes another one. It is judged by the tests that include its header, then by the stress test under
ThreadSanitizer. A memory order that is too weak is judged by all of them under ThreadSanitizer: a test as it is does not see it.

Usage: cpp/mutate.py [--every N] [--jobs N] [--all | --list] [HEADER...]
"""

import argparse
import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
INCLUDE = HERE / "include"
HEADERS = ["asynchronous_task", "locked_buffer", "message_queue", "pair_lock", "periodic_task", "semaphore", "swinging_buffer",
           "task", "wait_free_buffer", "watchdog"]
# A test ends in moments, the stress test under ThreadSanitizer in seconds; what waits for ever is a fault.
LIMIT_S = {"test": 10, "stress": 120}
FLAGS = ["g++", "-std=c++20", "-w", "-pthread"]
TEST = ["-O0"]
THREAD = ["-O0", "-g1", "-fsanitize=thread", "-fno-builtin"]

TOKEN = re.compile(r"""
    //[^\n]* | /\*.*?\*/ | "(?:\\.|[^"\\\n])*" | '(?:\\.|[^'\\\n])*' | ^[ \t]*\#[^\n]*
  | [0-9][\w.']*
  | <=> | \+\+ | -- | -> | << | >> | && | \|\| | [<>=!+\-*/%&|^]=? | [A-Za-z_]\w* | \S
""", re.VERBOSE | re.MULTILINE | re.DOTALL)
OTHERS = {"==": ["!="], "!=": ["=="], "<=": ["<"], ">=": [">"], "&&": ["||"], "||": ["&&"], "++": ["--"], "--": ["++"],
          "+=": ["-="], "-=": ["+="], "true": ["false"], "false": ["true"]}
SPACED = {"<": ["<=", ">="], ">": [">=", "<="], "+": ["-"], "-": ["+"]}


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
            # Angle brackets of templates stand without spaces.
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


def reached(file, seen=None):
    """The headers of the runtime that a file includes."""
    seen = set() if seen is None else seen
    for name in re.findall(r'#include ["<](?:groundstate/)?([\w/]+\.hpp)[">]', file.read_text()):
        header = INCLUDE / "groundstate" / name
        if header.exists() and header not in seen:
            seen.add(header)
            reached(header, seen)
    return seen


def tests_of(header):
    """The tests that include a header, those that are about it alone first."""
    found = [(len(all_headers), test) for test in sorted((HERE / "tests").glob("*_test.cpp"))
             if test.stem not in ("allocation_test", "mcap_file_test") and header in (all_headers := reached(test))]
    return [test for _, test in sorted(found)]


def passes(folder, source, flags, libraries):
    """Whether a test passes: none if it cannot be compiled."""
    program = folder / "program"
    compiled = subprocess.run([*FLAGS, *flags, f"-I{folder / 'include'}", f"-I{INCLUDE}", f"-I{HERE / 'tests'}", str(source), "-o",
                               str(program), *libraries], capture_output=True)
    if compiled.returncode != 0:
        return None
    try:
        return subprocess.run([str(program)], capture_output=True, timeout=LIMIT_S["stress" if flags is THREAD else "test"], cwd=folder).returncode == 0
    except subprocess.TimeoutExpired:
        return False


def judged(header, start, end, other):
    """Who noticed a mutant: a name, `refused` if it cannot be compiled, none if it survived."""
    text = header.read_text()
    gtest = ["-lgtest", "-lgtest_main"]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        # Headers include each other by names beside them, so all of them stand beside the one that is mutated.
        (folder / "include" / "groundstate").mkdir(parents=True)
        for each in (INCLUDE / "groundstate").iterdir():
            if each != header:
                (folder / "include" / "groundstate" / each.name).symlink_to(each)
        (folder / "include" / "groundstate" / header.name).write_text(text[:start] + other + text[end:])
        tests = tests_of(header)
        rounds = [(test, TEST, gtest, test.stem) for test in tests]
        rounds.append((HERE / "tests" / "stress.cpp", THREAD, [], "stress under ThreadSanitizer"))
        if other.startswith("memory_order_"):
            rounds += [(test, THREAD, gtest, f"{test.stem} under ThreadSanitizer") for test in tests]
        for source, flags, libraries, told in rounds:
            said = passes(folder, source, flags, libraries)
            if said is None:
                return "refused"
            if not said:
                return told
    return None


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
        if not tests_of(header):
            parser.error(f"no test includes {header.name}")
    made = [(header, *mutant) for header in headers for mutant in mutants(header.read_text())]
    chosen = made[::arguments.every]
    if arguments.list:
        for mutant in chosen:
            print(told(*mutant))
        return
    # As they are, the tests pass, or whoever fails them says nothing.
    with tempfile.TemporaryDirectory() as name:
        for test in sorted({test for header in headers for test in tests_of(header)}):
            if not passes(pathlib.Path(name), test, TEST, ["-lgtest", "-lgtest_main"]):
                sys.exit(f"{test.name} does not pass as it is")
        if not passes(pathlib.Path(name), HERE / "tests" / "stress.cpp", THREAD, []):
            sys.exit("stress.cpp does not pass under ThreadSanitizer as it is")
    known, killed, refused, survivors, wrong = listed(), 0, 0, 0, []
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for mutant, said in zip(chosen, pool.map(lambda mutant: judged(*mutant), chosen)):
            line = told(*mutant)
            if arguments.all:
                print(f"{said or 'survived'}: {line}", flush=True)
            if said == "refused":
                refused += 1
            elif said:
                killed += 1
                if line in known:
                    wrong.append(f"noticed by {said}, and still in cpp/survivors.txt: {line}")
            else:
                survivors += 1
                if line not in known:
                    wrong.append(f"survived: {line}")
                    print(wrong[-1], flush=True)
    if arguments.every == 1 and arguments.headers == HEADERS:
        lines = {told(*mutant) for mutant in made}
        wrong += [f"in cpp/survivors.txt, but not made: {line}" for line in known if line not in lines]
    print("\n".join(line for line in wrong if not line.startswith("survived: ")))
    print(f"{len(chosen)} of {len(made)} mutants: {killed} noticed, {survivors} survived, {refused} not compiled")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
