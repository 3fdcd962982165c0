#!/usr/bin/env python3
"""malformed.py [-n MUTANTS] [-p PROGRAM_MUTANTS] [-s SEED] [-k FOLDER] BIN SEEDS [KIND...]

Damages small files of each format field by field (counts, types, offsets, units, signs, numbers that are none, parts that are cut off,
twice or in another order), and reads each mutant with the readers in one process (BIN/rhombicReadMutants), and some of them with
`rhombic info`, `mesh` and `audit`. None may end a process by a signal, hang, fail by the program's own fault, or be accepted with another
geometry or other values than reading.py finds in the same bytes. What does is kept in FOLDER and printed. SEEDS is the folder that
rhombicFuzzSeeds has written. The same SEED gives the same mutants.

Prints a line for each kind of file: mutants, how many were read, refused, and found bad."""

import argparse
import collections
import os
import random
import select
import shutil
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
import mutants  # noqa: E402
import reading  # noqa: E402

SCAN = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../testdata/phantom/phantom.nii.gz")
SECONDS = 100  # for one mutant; more is a hang
DOCUMENTED = set(range(13)) - {1}


class Reader:
    """The program that reads in one process; started again when a mutant has ended it."""

    def __init__(self, program):
        self.program = program
        self.process = None

    def read(self, path):
        if self.process is None:
            self.process = subprocess.Popen([self.program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        self.process.stdin.write(path.encode() + b"\n")
        self.process.stdin.flush()
        answer = b""
        while not answer.endswith(b"\nend\n"):
            if not select.select([self.process.stdout], [], [], SECONDS)[0]:
                self.process.kill()
                self.process.wait()
                self.process = None
                return "hangs"
            part = os.read(self.process.stdout.fileno(), 1 << 20)
            if not part:
                code, self.process = self.process.wait(), None
                return f"ended by {code}"
            answer += part
        return answer[:-5].decode(errors="replace").split("\n")[-1]

    def close(self):
        if self.process is not None:
            self.process.stdin.close()
            self.process.wait()


def judge(path, answer):
    """What is bad about an answer, or nothing."""
    kind = answer.split(" ", 1)[0]
    if kind == "refused":
        return ""
    if kind in ("hangs", "ended", "internal", "exception"):
        text = answer.split(" ", 1)[-1]
        return kind + " " + (bytes.fromhex(text[1:]).decode(errors="replace") if text.startswith("x") else text)
    try:
        return reading.check(path, answer)
    except Exception as error:  # whatever the other reading stumbles over
        return f"accepted, but {type(error).__name__}: {error}"


def run_program(program, path, folder):
    """What is bad about the commands, or nothing."""
    out = os.path.join(folder, "out")
    surface = path.endswith((".stl", ".ply", ".obj", ".glb", ".vtp"))
    if path.endswith(".yaml"):
        commands = [["render", SCAN, "--preset", path, "--size", "32", "-o", out + "/p.png"]]
    elif path.endswith(".tsv"):
        commands = [["batch", path, "-o", out + "/batch", "--dry-run"]]
    elif surface:
        commands = [["audit", path]]
    else:
        commands = [["info", path], ["mesh", path, "-t", "3.5", "-o", out + "/m.stl"]]
    for command in commands:
        shutil.rmtree(out, ignore_errors=True)
        os.mkdir(out)
        try:
            done = subprocess.run([program, "-q", "--threads", "1", *command],
                                  stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, timeout=SECONDS)
        except subprocess.TimeoutExpired:
            return command[0] + " hangs"
        text = done.stderr.decode(errors="replace")
        if done.returncode != 0 and done.returncode not in DOCUMENTED:
            return f"{command[0]} ends with {done.returncode}: {text[:300]}"
        if done.returncode != 0 and not text.strip():
            return f"{command[0]} ends with {done.returncode} without a sentence"
        left = os.listdir(out)
        if done.returncode != 0 and left and command[0] != "batch":
            return f"{command[0]} failed and left {left}"
    return ""


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("-n", type=int, default=1200)
    parser.add_argument("-p", type=int, default=0)
    parser.add_argument("-s", type=int, default=1)
    parser.add_argument("-k", default="")
    parser.add_argument("bin")
    parser.add_argument("seeds")
    parser.add_argument("kinds", nargs="*")
    given = parser.parse_intermixed_args()
    reader = Reader(os.path.join(given.bin, "rhombicReadMutants"))
    program = os.path.join(given.bin, "rhombic")
    kinds = {name: make for name, make in mutants.KINDS.items() if not given.kinds or name in given.kinds}
    share = {name: given.n // len(kinds) for name in kinds}
    totals = collections.Counter()
    with tempfile.TemporaryDirectory() as base:
        for name, kind in kinds.items():
            count = max(1, share[name] // kind.slowness)
            by_program = given.p // len(kinds)
            random_numbers = random.Random(f"{given.s} {name}")
            seeds = kind.seeds(given.seeds)
            results = collections.Counter()
            for seed in seeds:  # what is not damaged is read
                path = kind.write(seed, base)
                answer = reader.read(path)
                bad = judge(path, answer) or ("it is refused: " + answer if answer.startswith("refused") else "")
                if bad:
                    sys.exit(f"{name}: without damage: {bad}")
            for number in range(count):
                path = kind.write(kind.mutate(random_numbers.choice(seeds), random_numbers), base)
                answer = reader.read(path)
                bad = judge(path, answer)
                if not bad and number % max(1, count // max(1, by_program)) == 0 and results["program"] < by_program:
                    results["program"] += 1
                    bad = run_program(program, path, base)
                results["bad" if bad else "refused" if answer.startswith("refused") else "read"] += 1
                if bad:
                    print(f"{name} {number}: {bad}", flush=True)
                    if given.k:
                        os.makedirs(given.k, exist_ok=True)
                        place = os.path.join(given.k, f"{name}-{number}-{os.path.basename(path)}")
                        (shutil.copytree if os.path.isdir(path) else shutil.copy)(path, place)
            print(f"{name}: {count} mutants, {results['read']} read, {results['refused']} refused, {results['bad']} bad; "
                  f"{results['program']} by the program", flush=True)
            totals.update(results)
            totals["mutants"] += count
    reader.close()
    print(f"{totals['mutants']} mutants, {totals['program']} of them by the program, {totals['bad']} bad")
    return 1 if totals["bad"] else 0


if __name__ == "__main__":
    sys.exit(main())
