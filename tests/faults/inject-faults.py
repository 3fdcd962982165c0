#!/usr/bin/env python3
"""inject-faults.py PROGRAM TESTDATA [MOST [COMMAND...]]: runs each command of the program once for each system call on its inputs and outputs, and
lets this call fail (strace -e inject). Each run must end well, with the outputs of a run without a fault, or end with a sentence and a
documented exit code, without any output but those that the sentence names, and without other files; the inputs must be the same as
before. With -l alone it lists the commands.

Calls count from the first access to an input or output on. MOST is the largest number of faults for each command, kind of call and error (default
12); they are spread evenly over the calls. Prints a line for each command and each defect."""

import collections
import hashlib
import os
import re
import shutil
import subprocess
import sys
import tempfile

FAULTS = {  # what a full or damaged disk, a dead network share, limits and other programs do
    "openat": ("EIO", "EMFILE", "EACCES"), "read": ("EIO",), "pread64": ("EIO",), "write": ("ENOSPC", "EIO"), "writev": ("ENOSPC",),
    "pwrite64": ("ENOSPC",), "lseek": ("EIO",), "newfstatat": ("EIO",), "close": ("EIO",), "fsync": ("EIO", "ENOSPC"),
    "rename": ("EIO", "EXDEV"), "mkdir": ("ENOSPC",), "getdents64": ("EIO",), "flock": ("ENOLCK",), "ftruncate": ("ENOSPC",),
    "fallocate": ("ENOSPC",), "link": ("EPERM",), "unlink": ("EIO",), "chdir": ("EACCES",), "mmap": ("ENOMEM",), "clone3": ("EAGAIN",),
    "execve": ("ENOMEM",), "socketpair": ("EMFILE",), "pipe2": ("EMFILE",), "memfd_create": ("EMFILE",),
}
SECONDS = 120
THREADS = 2
DOCUMENTED = set(range(13)) - {1}  # which is for defects of the program, and of its installation

COMMANDS = {
    "info": ["info", "{in}/phantom.nii.gz"],
    "info-dicom": ["info", "{in}/dicom"],
    "mesh": ["mesh", "{in}/phantom.nii.gz", "-t", "375.5", "-o", "{out}/bone.stl"],
    "mesh-dicom": ["mesh", "{in}/dicom", "-t", "375.5", "--audit", "-o", "{out}/bone.ply"],
    "labels": ["mesh", "{in}/phantom-labels.nii.gz", "--labels", "{in}/phantom-labels.nii.gz", "--only", "*kidney*", "-o", "{out}/k.glb"],
    "render": ["render", "{in}/phantom.nii.gz", "--surface", "bone=375.5", "--size", "200", "-o", "{out}/bone.png"],
    "page": ["render", "{in}/phantom.nii.gz", "--surface", "bone=375.5", "--sheet", "-o", "{out}/page.pdf"],
    "resample": ["resample", "{in}/phantom.nii.gz", "-o", "{out}/lattice.fcc.nrrd"],
    "compare": ["compare-labels", "{in}/phantom-labels.nii.gz", "{in}/phantom-labels.nii.gz", "--only", "*kidney*", "-o", "{out}/t.csv"],
    "audit": ["audit", "{in}/bone.stl"],
    "obj": ["mesh", "{in}/phantom.nii.gz", "-t", "375.5", "-o", "{out}/bone.obj"],
    "vtp": ["mesh", "{in}/phantom.nii.gz", "-t", "375.5", "-o", "{out}/bone.vtp"],
    "3mf": ["mesh", "{in}/phantom.nii.gz", "-t", "375.5", "-o", "{out}/bone.3mf"],
    "turn": ["render", "{in}/phantom.nii.gz", "--surface", "bone=375.5", "--turntable", "3", "--size", "80", "-o", "{out}/turn.gif"],
    "web": ["render", "{in}/phantom.nii.gz", "--surface", "bone=375.5", "-o", "{out}/page.html"],
    "pacs": ["render", "{in}/dicom", "--surface", "bone=375.5", "--size", "80", "--dicom-sc", "-o", "{out}/bone.png"],
    "surfaces": ["render", "{in}/bone.stl", "--size", "80", "-o", "{out}/bone.jpg"],
    "back": ["resample", "{in}/lattice.fcc.nrrd", "-o", "{out}/scan.nii.gz"],
    "same": ["compare-pictures", "{in}/bone.png", "{in}/bone.png"],
    "phantom": ["phantom", "--spacing", "10", "-o", "{out}/phantom"],
    "statistics": ["batch", "-o", "{in}/batch", "--stats"],
    "tables": ["batch", "{in}/cases", "--names-from-paths", "--pipeline", "{in}/pipeline.yaml", "--dry-run", "-o", "{in}/batch"],
    "batch": ["batch", "{in}/cases", "--names-from-paths", "--pipeline", "{in}/pipeline.yaml", "--jobs", "1", "-o", "{out}/batch"],
    "bids": ["bids", "{in}/bids", "{out}/batch", "participant", "--pipeline", "{in}/pipeline.yaml", "--jobs", "1"],
    "experiments": ["compare", "{in}/experiments.yaml", "--no-pictures", "--repeats", "1", "-o", "{out}/results"],
}


def contents(folder):
    """Files by their paths, with a hash of what depends on neither time nor memory."""
    found = {}
    for parent, _, names in os.walk(folder):
        for name in names:
            path = os.path.join(parent, name)
            with open(path, "rb") as file:
                data = file.read()
            unsteady = name.endswith((".json", ".jsonl", ".html", ".tsv", ".pdf", "times.csv")) or "results." in name
            found[os.path.relpath(path, folder)] = "" if unsteady else hashlib.md5(data).hexdigest()
    return found


class Runs:
    def __init__(self, program, testdata, base):
        self.program = program
        self.inputs = os.path.join(base, "in")
        self.out = os.path.join(base, "out")
        self.trace = os.path.join(base, "trace")
        shutil.copytree(testdata, self.inputs)
        subprocess.run([program, "-q", "mesh", self.inputs + "/phantom.nii.gz", "-t", "375.5", "--no-sidecar", "-o", self.inputs + "/bone.stl"],
                       check=True)
        for case in ("cases/one.nii.gz", "cases/folder/two.nii.gz", "bids/sub-01/anat/sub-01_T1w.nii.gz"):
            os.makedirs(os.path.dirname(f"{self.inputs}/{case}"), exist_ok=True)
            shutil.copy(self.inputs + "/phantom.nii.gz", f"{self.inputs}/{case}")
        for name, text in {
            "bids/dataset_description.json": '{"Name": "phantom", "BIDSVersion": "1.8.0"}',
            "pipeline.yaml": "outputs:\n  - mesh: bone.stl\n    threshold: 375.5\n",
            "experiments.yaml": "title: T\nexperiments:\n  - name: a\n    field: {kind: corner, size: 12}\n    rows: [{method: lean}]\n",
        }.items():
            with open(f"{self.inputs}/{name}", "w") as file:
                file.write(text)
        for made in (["resample", self.inputs + "/phantom.nii.gz", "-o", self.inputs + "/lattice.fcc.nrrd"],
                     ["render", self.inputs + "/phantom.nii.gz", "--surface", "bone=375.5", "--size", "80", "-o", self.inputs + "/bone.png"],
                     ["batch", self.inputs + "/cases", "--names-from-paths", "--pipeline", self.inputs + "/pipeline.yaml", "-o",
                      self.inputs + "/batch"]):
            subprocess.run([program, "-q", *made], check=True)
        self.before = contents(self.inputs)

    def run(self, command, *options):
        """Exit code, lines on standard error, and files that are left."""
        shutil.rmtree(self.out, ignore_errors=True)
        os.mkdir(self.out)
        places = {"in": self.inputs, "out": self.out}
        arguments = [word.format(**places) for word in COMMANDS[command]]
        traced = ["strace", "-f", "-qq", "-o", self.trace, *options, self.program, "-q", "--threads", str(THREADS), *arguments]
        try:
            done = subprocess.run(traced, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=SECONDS)
            return done.returncode, done.stderr.decode(errors="replace").strip(), contents(self.out)
        except subprocess.TimeoutExpired:
            return "hangs", "", contents(self.out)

    def calls(self, command):
        """For each kind of call the numbers, counted in one thread, of those that come after the first access to an input."""
        self.run(command, "-e", "trace=" + ",".join(FAULTS))
        counts, numbers, begun, first = collections.Counter(), collections.defaultdict(set), False, None
        with open(self.trace) as lines:
            for line in lines:
                match = re.match(r"(\d+)\s+(\w+)\(", line)
                begun = begun or (self.inputs in line or self.out in line) and "execve(" not in line
                if match:
                    first = first or match.group(1)
                    counts[match.groups()] += 1
                    # Not the memory of a child's loader. Of threads those of ITK's pool, which start first, and of a batch itself:
                    # other libraries end the process where one can't be started.
                    number, is_first, is_thread = counts[match.groups()], match.group(1) == first, "CLONE_THREAD" in line
                    is_of_pool = is_thread and is_first and number <= THREADS
                    is_counted = is_first if match.group(2) == "mmap" else not is_thread or command == "batch" and is_first
                    if is_of_pool or begun and is_counted:
                        numbers[match.group(2)].add(number)
        return {call: sorted(found) for call, found in numbers.items()}


def defect_of(code, text, files, usual, is_silenced):
    """is_silenced: the fault, which each thread has once, met the sentence, too."""
    usual_code, usual_files = usual
    if isinstance(code, str) or code < 0 or code > 128:
        return f"{code}"
    if code == usual_code:
        return "" if files == usual_files else f"ended well, but {sorted(set(files.items()) ^ set(usual_files.items()))[:3]}"
    if code == 127 and "error while loading shared libraries" in text:
        return ""  # before the program begins
    if code not in DOCUMENTED and "nstall" not in text and "Cannot start" not in text:  # as where /dev/null can't be opened
        return f"exit code {code}"
    if not text and not is_silenced:
        return f"exit code {code} without a sentence"
    left = [path for path in files if not path.startswith("batch/") and f"/{path}" not in text]
    return f"exit code {code}, and it left {left[:3]}" if left else ""


def main():
    if sys.argv[1:] == ["-l"]:
        print("\n".join(COMMANDS))
        return 0
    program, testdata = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
    most = int(sys.argv[3]) if len(sys.argv) > 3 else 12
    chosen = sys.argv[4:] or list(COMMANDS)
    if shutil.which("strace") is None:
        print("skipped: strace is not installed")
        return 77
    faults = defects = 0
    with tempfile.TemporaryDirectory() as base:
        runs = Runs(program, testdata, base)
        for command in chosen:
            code, text, files = runs.run(command, "-e", "trace=none")
            if code != 0 or not files and command not in ("info", "info-dicom", "audit", "same", "statistics", "tables"):
                sys.exit(f"{command}: without a fault, exit code {code} and {len(files)} files: {text}")
            usual = code, files
            runs.before = contents(runs.inputs)  # with what the command writes there
            numbers = runs.calls(command)
            tried = bad = 0
            for call, errors in FAULTS.items():
                found = numbers.get(call, [])
                for error in errors:
                    for n in found[:: max(1, -(-len(found) // most))]:
                        place = ["-e", f"inject={call}:error={error}:when={n}"]
                        code, text, files = runs.run(command, *place)
                        tried += 1
                        with open(runs.trace) as lines:
                            is_silenced = any("(2, " in line and "INJECTED" in line for line in lines)
                        defect = defect_of(code, text, files, usual, is_silenced)
                        if not defect and contents(runs.inputs) != runs.before:
                            defect = "it changed the inputs"
                            shutil.rmtree(runs.inputs)
                            runs = Runs(program, testdata, base)
                            runs.run(command, "-e", "trace=none")
                            runs.before = contents(runs.inputs)
                        if defect:
                            bad += 1
                            print(f"{command}: {call} {n}, {error}: {defect}: {text[:300]}", flush=True)
            print(f"{command}: {tried} faults, {tried - bad} survived", flush=True)
            faults += tried
            defects += bad
    print(f"{faults} faults, {faults - defects} survived")
    return 1 if defects else 0


if __name__ == "__main__":
    sys.exit(main())
