#!/usr/bin/env python3
"""chaos.py PROGRAM [-c CASES] [-r ROUNDS] [-s SEED] [KIND...]: runs a batch of many small cases again and again while one of
these things happens to it, then once undisturbed. At the end of each round its folder must hold what a batch has written that nothing
happened to: the same files with the same bytes, each case once in the tables, no case lost, no half file and no stage left. Numbers are
random, but the same for each SEED. Prints a line for each round, and each defect.

Counted is what a batch met: processes killed while they ran, inputs changed and batches started while it ran, renames that failed,
processes whose clock jumped, and for limits and the disk the cases that failed, or 1 where the batch itself ended. A limit that is wide
enough, or a disk that is large enough, counts nothing.

The kinds: children (killed), parent (killed), disk (full), memory, files, processes, seconds (limits), changed and removed (inputs, which
come back), clock (jumps back and forth), two (batches on one folder), rename (fails now and then)."""

import argparse
import hashlib
import os
import random
import re
import resource
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time

LIBRARY = r"""
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>
static unsigned state;
static unsigned next(void)
{
  if (state == 0)
    state = (unsigned)getpid() * 2654435761u + (unsigned)atoi(getenv("CHAOS_SEED")) + 1;
  return (state = state * 1664525u + 1013904223u) >> 8;
}
static void count(void)
{
  const int file = open(getenv("CHAOS_MET"), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
  if (file >= 0 && write(file, "x", 1) == 1)
    close(file);
}
static int fails(void)
{
  const char * const share = getenv("CHAOS_RENAME");
  if (!share || next() % 100 >= (unsigned)atoi(share))
    return 0;
  count();
  return 1;
}
int rename(const char * from, const char * to)
{
  if (fails())
    return errno = next() % 2 ? EIO : ESTALE, -1;
  return ((int (*)(const char *, const char *))dlsym(RTLD_NEXT, "rename"))(from, to);
}
int link(const char * from, const char * to)
{
  if (fails())
    return errno = EIO, -1;
  return ((int (*)(const char *, const char *))dlsym(RTLD_NEXT, "link"))(from, to);
}
int clock_gettime(clockid_t clock, struct timespec * now)
{
  const int code = ((int (*)(clockid_t, struct timespec *))dlsym(RTLD_NEXT, "clock_gettime"))(clock, now);
  static int isCounted;
  if (clock == CLOCK_REALTIME && getenv("CHAOS_CLOCK"))
  {
    now->tv_sec += (long)(next() % 2000000) - 1000000;
    if (!isCounted++)
      count();
  }
  return code;
}
int gettimeofday(struct timeval * restrict now, void * restrict zone)
{
  (void)zone;
  struct timespec time;
  clock_gettime(CLOCK_REALTIME, &time);
  now->tv_sec = time.tv_sec;
  now->tv_usec = time.tv_nsec / 1000;
  return 0;
}
time_t time(time_t * place)
{
  struct timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  return place ? (*place = now.tv_sec) : now.tv_sec;
}
"""
UNSTEADY = ("journal.jsonl", "index.html", "results.tsv", "results.json")  # hold times and memory
SECONDS = 600
USER = 61234  # without processes of its own


def contents(folder):
    """Files by their paths, with a hash of those that hold neither times nor memory."""
    found = {}
    for parent, _, names in os.walk(folder):
        for name in names:
            path = os.path.join(parent, name)
            with open(path, "rb") as file:
                data = file.read()
            place = os.path.relpath(path, folder)
            found[place] = "" if place in UNSTEADY else hashlib.md5(data).hexdigest()
    return found


def children_of(process):
    found = []
    for name in os.listdir("/proc"):
        if name.isdigit():
            try:
                with open(f"/proc/{name}/stat") as file:
                    state, parent = file.read().rsplit(")", 1)[1].split()[:2]
                    if int(parent) == process and state != "Z":
                        found.append(int(name))
            except (OSError, IndexError):
                pass  # ended meanwhile
    return found


class Chaos:
    def __init__(self, given, base):
        self.program, self.base, self.cases = os.path.abspath(given.program), base, given.cases
        self.random = random.Random(given.seed)
        self.faults, self.text = 0, ""
        self.library = os.path.join(base, "chaos.so")
        with open(os.path.join(base, "chaos.c"), "w") as file:
            file.write(LIBRARY)
        subprocess.run(["cc", "-shared", "-fPIC", "-O1", "-o", self.library, os.path.join(base, "chaos.c"), "-ldl"], check=True)
        self.inputs = os.path.join(base, "in")
        os.mkdir(self.inputs)
        self.write_inputs()
        with open(os.path.join(base, "pipeline.yaml"), "w") as file:
            file.write("outputs:\n  - mesh: a.stl\n    threshold: 1.5\n  - mesh: b.ply\n    threshold: 2.5\n")
        self.out = os.path.join(base, "usual")
        assert self.run() == 0, "the undisturbed batch fails"
        self.usual = contents(self.out)

    def write_inputs(self):
        """Each case has a small volume of its own."""
        for n in range(self.cases):
            size = 12
            header = bytearray(352)
            struct.pack_into("<i", header, 0, 348)
            struct.pack_into("<8h", header, 40, 3, size, size, size, 1, 1, 1, 1)
            struct.pack_into("<hh", header, 70, 2, 8)
            struct.pack_into("<8f", header, 76, 1, 1, 1, 1, 1, 1, 1, 1)
            struct.pack_into("<3f", header, 108, 352, 0, 0)
            struct.pack_into("<h", header, 254, 1)
            struct.pack_into("<12f", header, 280, -1, 0, 0, n, 0, -1, 0, 0, 0, 0, 1, 0)
            header[344:348] = b"n+1\0"
            middle = size // 2
            voxels = bytes(max(0, 5 - max(abs(x - middle), abs(y - middle), abs(z - middle)) - (x * y + n) % 2)
                           for z in range(size) for y in range(size) for x in range(size))
            with open(os.path.join(self.inputs, f"c{n:03}.nii"), "wb") as file:
                file.write(header + voxels)

    def start(self, limits=(), **environment):
        def prepare():
            for limit, value in limits:
                resource.setrlimit(limit, (value, value))
                if limit == resource.RLIMIT_NPROC and os.geteuid() == 0:  # root has no such limit
                    os.setgroups([])
                    os.setgid(USER)
                    os.setuid(USER)
        return subprocess.Popen([self.program, "-q", "--threads", "2", "batch", self.inputs, "--names-from-paths", "--pipeline",
                                 os.path.join(self.base, "pipeline.yaml"), "--jobs", "2", "--max-memory", "1G", "-o", self.out],
                                stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                env={**os.environ, "CHAOS_SEED": str(self.random.randrange(10**6)), **environment}, preexec_fn=prepare)

    def end(self, process):
        try:
            text = process.communicate(timeout=SECONDS)[1]
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()
            self.text = ""
            return "hangs"
        self.text = text.decode(errors="replace")
        return process.returncode

    def run(self, *limits, **environment):
        return self.end(self.start(limits, **environment))

    def preload(self, **environment):
        met = os.path.join(self.base, "met")
        open(met, "w").close()
        code = self.run(LD_PRELOAD=self.library, CHAOS_MET=met, **environment)
        self.faults += os.path.getsize(met)
        return code

    def counted(self, code):
        """Counts the cases that a run lost, or 1 where it ended itself."""
        failed = re.search(r"(\d+) cases? of \d+ failed", self.text)
        self.faults += int(failed[1]) if failed else int(code != 0)
        return code

    # What happens; each returns the exit code of what ran, -9 where it was killed.
    def children(self):
        process = self.start()
        while process.poll() is None:
            time.sleep(self.random.uniform(0.02, 0.3))
            found = children_of(process.pid)
            if found and process.poll() is None:
                try:
                    os.kill(self.random.choice(found), signal.SIGKILL)
                    self.faults += 1
                except ProcessLookupError:
                    pass
        return self.end(process)

    def parent(self):
        code = 0
        for _ in range(4):
            process = self.start()
            time.sleep(self.random.uniform(0.05, 3.0))
            if process.poll() is None:
                process.kill()
                self.faults += 1
            code = self.end(process)
        return code

    def disk(self):
        """The folder of outputs is a small disk."""
        os.mkdir(self.out)
        kilobytes = self.cases * self.random.choice([20, 50, 80])  # a case makes some 100
        if subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={kilobytes}k,nr_inodes={self.random.choice([0, 3 * self.cases])}", "none", self.out],
                          stderr=subprocess.DEVNULL).returncode != 0:
            os.rmdir(self.out)
            return 0
        try:
            code = self.counted(self.run())
            kept = os.path.join(self.base, "kept")
            shutil.copytree(self.out, kept)
        finally:
            subprocess.run(["umount", self.out], check=True)
        os.rmdir(self.out)
        os.rename(kept, self.out)
        return code

    def limited(self, limit, values):
        return self.counted(self.run((limit, self.random.choice(values))))

    def memory(self):
        return self.limited(resource.RLIMIT_AS, [n << 20 for n in (32, 36, 40, 44, 48, 60)])

    def files(self):
        return self.limited(resource.RLIMIT_NOFILE, [5, 6, 7, 8, 9, 10, 12])

    def processes(self):
        """Each number of processes and threads, always from the start: each call that starts one fails for some number."""
        os.chmod(self.base, 0o755)
        code = 0
        for number in (1, 2, 8, 7, 6, 5, 3, 4):
            shutil.rmtree(self.out, ignore_errors=True)
            os.mkdir(self.out)
            os.chmod(self.out, 0o777)
            try:
                code = self.counted(self.run((resource.RLIMIT_NPROC, number)))
            except PermissionError:  # the program's folder is root's own
                return 0
            if code == 1:
                break
        return code

    def seconds(self):
        return self.limited(resource.RLIMIT_CPU, [1, 2, 3])

    def hide(self, change):
        process = self.start()
        names = sorted(os.listdir(self.inputs))
        before = {}
        for _ in range(10):
            time.sleep(self.random.uniform(0.02, 0.3))
            path = os.path.join(self.inputs, self.random.choice(names))
            if path not in before:
                with open(path, "rb") as file:
                    before[path] = file.read(), os.stat(path)
                change(path, before[path][0])
                self.faults += process.poll() is None
        code = self.end(process)
        for path, (data, times) in before.items():
            with open(path, "wb") as file:
                file.write(data)
            os.utime(path, ns=(times.st_atime_ns, times.st_mtime_ns))
        return code

    def removed(self):
        return self.hide(lambda path, data: os.remove(path))

    def changed(self):
        def change(path, data):
            with open(path, "wb") as file:  # the same size, or half of it
                file.write(data[:352] + bytes(len(data) - 352) if self.random.randrange(2) else data[:len(data) // 2])
        return self.hide(change)

    def clock(self):
        return self.preload(CHAOS_CLOCK="1")

    def rename(self):
        return self.preload(CHAOS_RENAME=str(self.random.choice([5, 20, 50])))

    def two(self):
        first = self.start()
        time.sleep(self.random.uniform(0.0, 1.0))
        self.faults += first.poll() is None
        code = self.run()
        return self.end(first) or code

    def defect(self, code):
        """What is wrong after a disturbed run and the undisturbed one behind it; nothing if all is well."""
        if isinstance(code, str) or code < 0 and code not in (-signal.SIGKILL, -signal.SIGXCPU):
            return f"the disturbed run: {code}"
        if code == 1:  # which is for defects of the program
            return f"the disturbed run ends with 1: {self.text[:300]}"
        last = self.run()
        if last != 0:
            return f"the undisturbed run ends with {last}: {self.text[:300]}"
        found = contents(self.out)
        wrong = sorted(path for path in {*found, *self.usual} if found.get(path) != self.usual.get(path))
        if wrong:
            return f"{len(wrong)} files are others: {wrong[:5]}"
        with open(os.path.join(self.out, "results.tsv")) as file:
            rows = [line.split("\t") for line in file.read().splitlines()[1:]]
        names = sorted(row[0] for row in rows)
        if names != sorted(set(names)) or len(names) != self.cases or any(row[1] != "done" for row in rows):
            return "the table has not each case once, done"
        return ""


KINDS = ("children", "parent", "disk", "memory", "files", "processes", "seconds", "changed", "removed", "clock", "two", "rename")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program")
    parser.add_argument("kinds", nargs="*")
    parser.add_argument("-c", "--cases", type=int, default=40)
    parser.add_argument("-r", "--rounds", type=int, default=1)
    parser.add_argument("-s", "--seed", type=int, default=1)
    given = parser.parse_intermixed_args()
    faults = defects = 0
    with tempfile.TemporaryDirectory() as base:
        chaos = Chaos(given, base)
        for number in range(given.rounds):
            for kind in given.kinds or KINDS:
                chaos.out, chaos.faults, begin = os.path.join(base, "out"), 0, time.monotonic()
                code = getattr(chaos, kind)()
                text = chaos.text.strip().replace("\n", " ")[-160:]
                defect = chaos.defect(code)
                faults += chaos.faults
                defects += 1 if defect else 0
                print(f"{kind} {number}: {chaos.faults} faults met, exit code {code} ({text}): {defect or 'the same files at the end'} "
                      f"[{time.monotonic() - begin:.0f} s]", flush=True)
                shutil.rmtree(chaos.out, ignore_errors=True)
    print(f"{faults} faults met in batches of {given.cases} cases, {defects} defects")
    return 1 if defects else 0


if __name__ == "__main__":
    sys.exit(main())
