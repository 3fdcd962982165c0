#!/usr/bin/env python3
"""options.py [-n RUNS] [-s SEED] PROGRAM PHANTOM

Runs `rhombic render` and `rhombic mesh` with random options, on the phantom in the folder PHANTOM (which `rhombic phantom` writes) and
its labels. Most values are plausible, some are not. Each run ends with a documented exit code other than 1; one that fails prints one
sentence and leaves no file; one that succeeds leaves files that are not empty, the same bytes on one thread, meshes that `rhombic audit`
finds watertight, and pictures that their reports (--from) make again. Every option of the program's help is tried: one that is not known
here is an error. The same SEED gives the same runs.

Prints what is bad, with the command; at the end the number of runs, and of those that succeeded."""

import argparse
import hashlib
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile

SECONDS = 300  # for one command; more is a hang
DOCUMENTED = set(range(13)) - {1}
GENERAL = {"--help", "--version", "--threads", "--verbose", "--quiet", "--pipeline", "--from", "--output", "--list-presets"}
SMALL = ["--size", "160x120"]  # pictures are drawn fast

WILD_NUMBERS = ["0", "-1", "1e9", "nan", "inf", "1e-9", "abc", "", "0x10", "1,2", "1e400", "\u0663"]
NUMBERS = (["0.5", "1", "2", "3"], WILD_NUMBERS)
THRESHOLDS = ["300", "-300", "<-300", "otsu", "otsu-low", "otsu-high", "otsu-lowest", "1200.5", "0", "<100", "1000"]
NAMES = (["*", "kid*", "liver", "lung*", "group:bones", "s", "bone"], ["", "[", "..", "a/b", "$(x)", "group:x", "x" * 300])
PLANES = (["axial", "coronal", "sagittal=#10", "axial=12.5", "axial=s"], ["", "axial=", "oblique", "axial=1e9", "axial=nan", "coronal=#400"])
COLOURS = (["#fff", "red", "#12a4ff"], ["", "#12345g", "none", "red,"])

# Plausible and other values of each option; none of those without one.
COMMON = {
    "--series": (["1"], ["7", "", "*"]), "--frame": (["0"], ["1", "-1"]), "--level": (["0"], ["3", "-1"]),
    "--voxel-size": ([], ["5um", "0", "x"]), "--raw": ([], ["4x4x4,uint8", "0x0x0,int16,le", "x"]),
    "--on-irregular": (["resample", "error"], ["x"]), "--on-gap": (["error", "interpolate"], ["x"]),
    "--temporary": (["{folder}", "/var/tmp"], ["/nonexistent", "/proc", ""]),
    "--max-memory": (["100M", "8G"], ["0", "1", "1M", "-1", "abc"]), "--analyze": None, "--follow-links": None,
    "--density": (["0.5", "1"], WILD_NUMBERS), "--spacing": (["6", "5,6,8"], WILD_NUMBERS),
    "--kernel": (["cubic", "linear", "lanczos"], ["x"]), "--nested": None, "--no-sidecar": None, "--dry-run": None,
    "--denoise": (["gaussian:6", "none", "edges:6,10"], ["gaussian:0", "gaussian:1e9", "edges:1", "x"]),
    "--remove-table": None, "--keep-table": None,
}
SURFACES = {
    "--preset": (["auto", "ct-bone", "ct-bone-skin"], ["", "none", "./x.yaml"]),
    "--surface": (["s=" + threshold for threshold in THRESHOLDS] + ["s=300,red,0.4"], ["", "s", "=3", "s=nan", "s=", "s=1,red,2", "s=x"]),
    "--labels": (["{labels}"], ["{scan}", "/nonexistent", ""]), "--probabilities": ([], ["{labels}", "{scan}"]),
    "--label-table": (["{table}"], ["{scan}", "/nonexistent"]), "--label": NAMES, "--only": NAMES, "--hide": NAMES,
    "--draw": (["s=,0.3", "*=red", "*=,,matte"], ["", "s", "*=,2", "*=,,x"]), "--colours": (["anatomy", "file", "safe"], ["x"]),
    "--mode": (["lean", "fine", "tetrahedra", "octahedra", "parallelepipeds"], ["x"]), "--min-volume": NUMBERS, "--largest": None,
    "--fill": None, "--smooth": (["0.3", "0.8mm", "1"], WILD_NUMBERS),
    "--colour-by": (["thickness", "curvature", "curvature:9mm", "{scan}", "{scan},max:5mm", "{scan},0,7,inferno"],
                    ["", "x", "thickness,1,1", "thickness,nan,1", "curvature:0mm", "{scan},7,0"]),
}
PICTURES = {
    "--view": (["anterior", "left", "all", "30,15"], ["", "x", "nan,0", "30,91"]), "--slice": PLANES,
    "--lightbox": (["2", "5"], ["1", "400"]), "--sheet": None, "--landscape": None, "--dpi": (["36", "50"], ["601", "x"]),
    "--page-size": (["8M", "100k"], ["0", "x"]), "--no-slices": None, "--turntable": (["2", "4"], ["1", "721"]), "--dicom-sc": None,
    "--size": (["160x120", "17x80"], ["0x0", "1x1", "x", "99999x99999"]), "--focus": NAMES, "--ghost": (["0", "0.5", "1"], WILD_NUMBERS),
    "--zoom": NUMBERS, "--pixel-size": NUMBERS, "--same-scale": None, "--perspective": None,
    "--cut": (PLANES[0] + ["x>12", "y<0"], PLANES[1] + ["x>nan", "z>1e9"]), "--uncut": NAMES, "--show-slice": PLANES,
    "--style": (["clinic", "paper", "transparent"], ["x"]), "--background": COLOURS, "--no-shadows": None, "--no-silhouettes": None,
    "--window": (["auto", "bone", "350/50"], ["0/0", "-1/5", "nan/1", "x"]), "--neurological": None, "--no-outlines": None,
    "--annotate": (["none", "letters", "scale,legend", "figure", "footnote", "names"], ["", "x"]), "--no-letters": None,
    "--title": (["A title", "\u00e4 <b>&"], ["", "\x01", "two\nlines", "x" * 300]),
}
MESHES = {
    "--threshold": (THRESHOLDS, ["", "nan", "bone", "<"]), "--space": (["lps", "ras"], ["x"]), "--max-error": NUMBERS,
    "--max-triangles": (["500", "10%"], WILD_NUMBERS), "--measures": (["{folder}/m.csv", "{folder}/m.json"], ["{folder}/m.txt"]),
    "--audit": None, "--min-thickness": NUMBERS, "--require-watertight": None,
}
COMMANDS = {
    "render": ({**COMMON, **SURFACES, **PICTURES}, [".png", ".jpg", ".tif", ".exr", ".gif", ".pdf", ".html", ".bmp", ""]),
    "mesh": ({**COMMON, **SURFACES, **MESHES}, [".stl", ".ply", ".obj", ".vtp", ".glb", ".3mf", "-{name}.stl", ".txt", ""]),
}


def options_of(program, command):
    """The long names of the options that a command's help tells."""
    text = subprocess.run([program, command, "--help"], capture_output=True, text=True, check=True).stdout
    return set(re.findall(r"^  (?:-\w,)?(--[\w-]+)", text, re.MULTILINE))


def files_in(folder):
    return sorted(os.path.join(path, name) for path, _, names in os.walk(folder) for name in names)


def hashes(folder):
    """Of all files but reports, which tell the number of threads."""
    found = {}
    for path in files_in(folder):
        if not path.endswith(".json"):
            with open(path, "rb") as file:
                found[os.path.relpath(path, folder)] = hashlib.sha256(file.read()).hexdigest()
    return found


class Runs:
    def __init__(self, program, phantom, seed):
        self.program = program
        self.random = random.Random(seed)
        self.inputs = {
            "{scan}": os.path.join(phantom, "phantom.nii.gz"), "{labels}": os.path.join(phantom, "phantom-labels.nii.gz"),
            "{table}": os.path.join(phantom, "phantom-labels.tsv"), "{dicom}": os.path.join(phantom, "dicom"),
        }
        self.folder = tempfile.mkdtemp()
        self.bad = 0

    def run(self, arguments):
        try:
            return subprocess.run([self.program, *arguments], capture_output=True, cwd=self.folder, timeout=SECONDS, check=False)
        except subprocess.TimeoutExpired:
            return None

    def choose(self):
        """A command with its options."""
        pick = self.random.choice
        command = pick(list(COMMANDS))
        table, endings = COMMANDS[command]
        scan = pick(["{scan}", "{dicom}", "{labels}"])
        arguments = [command, scan]
        if scan != "{labels}" and self.random.random() < 0.7:
            arguments += ["--threshold=300"] if command == "mesh" else ["--surface=s=300", "--surface=skin=-300,,0.3"]
        if command == "render" and self.random.random() < 0.7:
            arguments += SMALL
        is_wild = self.random.random() < 0.3
        for option in self.random.sample(sorted(table), self.random.randint(0, 5)):
            if option in arguments or table[option] is None:
                arguments += [option] if table[option] is None else []
                continue
            plausible, wild = table[option]
            if plausible or is_wild:
                arguments.append(option + "=" + pick(wild if is_wild and (not plausible or self.random.random() < 0.5) else plausible))
        ending = pick(endings if is_wild else endings[:-2])
        arguments += ["--output", "{folder}/o" + ending]
        for name, path in {**self.inputs, "{folder}": self.folder}.items():
            arguments = [argument.replace(name, path) for argument in arguments]
        return arguments

    def empty(self):
        shutil.rmtree(self.folder)
        os.makedirs(self.folder)

    def judge(self, arguments):
        """Whether a run succeeded, and what is bad about the run, or nothing."""
        self.empty()
        done = self.run(arguments)
        if done is None:
            return False, "hangs"
        files = files_in(self.folder)
        sentences = [line for line in done.stderr.decode(errors="replace").split("\n") if line.startswith("rhombic: ")]
        if done.returncode not in DOCUMENTED:
            return False, f"ends with {done.returncode} {sentences}"
        if done.returncode != 0:
            return False, f"leaves {files}" if files else f"{len(sentences)} sentences" if len(sentences) != 1 else ""
        if "--dry-run" in arguments:
            return True, f"leaves {files}" if files else ""
        if not files or any(os.path.getsize(path) == 0 for path in files):
            return True, "writes nothing, or an empty file"
        return True, self.compare(arguments, files)

    def compare(self, arguments, files):
        """What is bad about files that were written, or nothing."""
        before = hashes(self.folder)
        report = os.path.join(self.folder, "o.png.json")
        if arguments[0] == "render" and report in files and not any("o-" in path or ".dcm" in path for path in files):
            again = ["render", arguments[1], "--from", report, "--output", os.path.join(self.folder, "again.png")]
            again = self.run(again + [a for a in arguments if re.match("--(labels|probabilities|colour-by|series)=", a)])
            after = hashes(self.folder)
            if again is None or again.returncode != 0 or after.get("again.png") != after.get("o.png"):
                return "its report does not make it again" + ("" if again is None else f": {again.stderr[-300:]}")
        meshes = [path for path in files if arguments[0] == "mesh" and re.search(r"/o[^/]*\.(stl|ply|obj|vtp|glb|3mf)$", path)]
        for path in meshes:
            audit = self.run(["audit", path])
            if audit is None or audit.returncode != 0:
                return "audit: " + ("hangs" if audit is None else f"{audit.returncode} {(audit.stdout + audit.stderr)[-300:]}")
        self.empty()
        again = self.run(["--threads", "1", *arguments])
        if again is None or again.returncode != 0 or hashes(self.folder) != before:
            return "differs on one thread"
        return ""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-n", type=int, default=1000)
    parser.add_argument("-s", type=int, default=1)
    parser.add_argument("program", type=os.path.abspath)
    parser.add_argument("phantom", type=os.path.abspath)
    settings = parser.parse_args()
    unknown = {command: options_of(settings.program, command) ^ (set(table) | GENERAL & options_of(settings.program, command))
               for command, (table, _) in COMMANDS.items()}
    if any(unknown.values()):
        sys.exit(f"options.py and the program's help know other options: {unknown}")
    runs = Runs(settings.program, settings.phantom, settings.s)
    succeeded = bad = 0
    for _ in range(settings.n):
        arguments = runs.choose()
        has_succeeded, what = runs.judge(arguments)
        succeeded += has_succeeded
        bad += bool(what)
        if what:
            print(what, "\n   ", " ".join(repr(argument) if re.search(r"[^\w=./:,%#-]", argument) else argument for argument in arguments), flush=True)
    shutil.rmtree(runs.folder)
    print(f"{settings.n} runs, {succeeded} succeeded, {bad} bad")
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    main()
