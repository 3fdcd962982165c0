#!/usr/bin/env python3
"""load.py PROGRAM FOLDER [--run] COUNT...: what the layer of batches costs for COUNT cases that have run, without running them: their
journal has COUNT lines as a real batch of one case has written them, and each case's folder is a link to that of the real one. With --run,
each case has a small file of its own and is run.

Prints, for each COUNT, the seconds of one core and the memory of: --tables, which writes all tables and the index page, a run that finds
nothing to do, and one more case of a job array (--case); and the sizes of the journal and of the tables. With --run, also the seconds of
a core of the whole run, and the seconds and the memory of the batch without its cases."""

import json
import os
import resource
import shutil
import struct
import subprocess
import sys
import time

PIPELINE = "outputs:\n  - mesh: a.stl\n    threshold: 1.5\n  - mesh: b.ply\n    threshold: 2.5\n"


def write_volume(path, offset=0):
    size = 12
    header = bytearray(352)
    struct.pack_into("<i", header, 0, 348)
    struct.pack_into("<8h", header, 40, 3, size, size, size, 1, 1, 1, 1)
    struct.pack_into("<hh", header, 70, 2, 8)
    struct.pack_into("<8f", header, 76, *[1.0] * 8)
    struct.pack_into("<3f", header, 108, 352, 0, 0)
    struct.pack_into("<h", header, 254, 1)
    struct.pack_into("<12f", header, 280, -1, 0, 0, offset, 0, -1, 0, 0, 0, 0, 1, 0)
    header[344:348] = b"n+1\0"
    voxels = bytes(max(0, 5 - max(abs(x - 6), abs(y - 6), abs(z - 6))) for z in range(size) for y in range(size) for x in range(size))
    with open(path, "wb") as file:
        file.write(header + voxels)


def measure(*command):
    """Seconds of processor time and MiB."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    text = process.stderr.read()
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"{command} ends with {status}: {text.decode()[:500]}")
    return f"{usage.ru_utime + usage.ru_stime:.2f} s, {usage.ru_maxrss / 1024:.0f} MiB"


def run_cases(program, folder, count):
    """A batch of COUNT files. The kernel counts the largest process among a batch and its cases, so that the batch is asked while it runs."""
    scans, out = f"{folder}/scans-{count}", f"{folder}/run-{count}"
    os.mkdir(scans)
    for n in range(count):
        write_volume(f"{scans}/case-{n:07}.nii", n)
    batch = [program, "-q", "--threads", "1", "batch", scans, "--names-from-paths", "-o", out, "--pipeline", folder + "/pipeline.yaml"]
    peak, own, before = 0, 0, resource.getrusage(resource.RUSAGE_CHILDREN)
    process = subprocess.Popen([*batch, "--jobs", "1"], stdout=subprocess.DEVNULL)
    while process.poll() is None:
        with open(f"/proc/{process.pid}/status") as status, open(f"/proc/{process.pid}/stat") as times:
            peak = max([peak] + [int(line.split()[1]) for line in status if line.startswith("VmHWM")])
            own = sum(map(int, times.read().rsplit(")", 1)[1].split()[11:13])) / os.sysconf("SC_CLK_TCK")
        time.sleep(0.2)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    if process.returncode != 0:
        sys.exit(f"{batch} ends with {process.returncode}")
    with open(out + "/results.tsv") as table:
        done = sum(line.split("\t")[1] == "done" for line in table)
    print(f"{count} cases run: {done} done, {seconds:.1f} s, of which the batch itself {own:.1f} s, {peak / 1024:.0f} MiB; nothing to do {measure(*batch)}; "
          f"{sum(len(files) for _, _, files in os.walk(out))} files; " + sizes(out), flush=True)


def sizes(out):
    return ", ".join(f"{table} {os.path.getsize(f'{out}/{table}') / 1e6:.1f} MB"
                     for table in ("journal.jsonl", "results.json", "measures.tsv", "index.html"))


def main():
    arguments = [word for word in sys.argv[1:] if word != "--run"]
    program, folder = map(os.path.abspath, arguments[:2])
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    scan, pipeline = folder + "/scan.nii", folder + "/pipeline.yaml"
    write_volume(scan)
    with open(pipeline, "w") as file:
        file.write(PIPELINE)
    if "--run" in sys.argv:
        for count in map(int, arguments[2:]):
            run_cases(program, folder, count)
        return
    with open(folder + "/one.tsv", "w") as file:
        file.write("case\tscan\none\tscan.nii\n")
    subprocess.run([program, "-q", "batch", folder + "/one.tsv", "-o", folder + "/one", "--pipeline", pipeline], check=True)
    with open(folder + "/one/journal.jsonl") as file:
        record = json.loads(file.read().splitlines()[-1])
    for count in map(int, arguments[2:]):
        out, manifest = f"{folder}/out-{count}", f"{folder}/cases-{count}.tsv"
        os.mkdir(out)
        with open(manifest, "w") as cases, open(out + "/journal.jsonl", "w") as journal:
            cases.write("case\tscan\n")
            for n in range(count):
                name = f"case-{n:07}"
                cases.write(f"{name}\t{scan}\n")
                record["case"] = record["folder"] = name
                journal.write(json.dumps(record) + "\n")
                os.symlink(folder + "/one/one", f"{out}/{name}")
        batch = [program, "-q", "--threads", "1", "batch", manifest, "-o", out, "--pipeline", pipeline]
        print(f"{count} cases: --tables {measure(*batch, '--tables')}; nothing to do {measure(*batch)}; "
              f"--case {measure(*batch, '--case', name)}; " + sizes(out), flush=True)
        shutil.rmtree(out)


if __name__ == "__main__":
    main()
