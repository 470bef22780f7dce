#!/usr/bin/env python3
"""What each rule of perception is worth: switches it off, maps, and compares with the truth.

  ablation.py --check             each rule of rules/*.json still fits the sources
  ablation.py [OPTION]... DIR     builds and runs in DIR; writes DIR/results.json and prints the table
    --rooms N --first-seed S      random rooms, drifting odometry, 320x240 (default: 4, from 301)
    --rules A,B                   these only; A+B+C: these at once
    --jobs N                      at a time (default: number of cores)
    --page FILE                   the table, of all rules, replaces the last one of this page

A rule is {"rule", "equation", "what", "edits": [{"file", "from", "to"}]}: the edits switch it off. Real
recordings are taken from $QUADMAP_TEST_DATA, poses given. What is done already is not done again.
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import threading

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]
SOURCES = ("CMakeLists.txt", "CMakePresets.json", "LICENSE", "README.md", "CHANGELOG.md", "cmake", "libs", "apps", "doc", "share")
REAL = {  # name: folder, detections, poses, share of the images that is left out at the start
    "kitchen_a NanoDet": ("kitchen_a", "detections", "ground-truth", 0),
    "kitchen_a YOLOv8n": ("kitchen_a", "detections_yolov8n", "ground-truth", 0),
    "kitchen_a without its floor": ("kitchen_a", "detections_yolov8n", "ground-truth", 0.5),
    "tum_fr2_desk": ("tum_fr2_desk", "detections", "ground-truth", 0),
    "tum_fr3_cabinet": ("tum_fr3_cabinet", "detections", "odometry", 0),
}
SCENES = ("no-floor",)  # beside the rooms


def read_rules():
    return [rule for path in sorted((HERE / "rules").glob("*.json")) for rule in json.loads(path.read_text())]


def switched_off(rule, root):
    """The sources without the rule: {file: text}. Raises ValueError where they do not have it."""
    texts = {}
    for edit in rule["edits"]:
        name = edit["file"]
        text = texts.get(name) or (root / name).read_text()
        if text.count(edit["from"]) != 1:
            raise ValueError(f'{rule["rule"]}: {text.count(edit["from"])} times in {name}: {edit["from"]}')
        texts[name] = text.replace(edit["from"], edit["to"])
    return texts


def chosen(names):
    """The rules of those names; of A+B one that switches off both. Raises ValueError when there is no such rule, or
    when the edits of one leave nothing for those of another."""
    rules, out = {rule["rule"]: rule for rule in read_rules()}, []
    for name in names:
        parts = [rules.get(part) for part in name.split("+")]
        if None in parts:
            raise ValueError(f"{name}: no such rule")
        out.append({"rule": name, "equation": "; ".join(filter(None, (part["equation"] for part in parts))),
                    "what": "; ".join(part["what"] for part in parts),
                    "edits": [edit for part in parts for edit in part["edits"]]})
        switched_off(out[-1], ROOT)
    return out


def check():
    wrong, names = [], set()
    for rule in read_rules():
        if rule["rule"] in names:
            wrong.append(f'{rule["rule"]}: twice')
        names.add(rule["rule"])
        try:
            switched_off(rule, ROOT)
        except (OSError, ValueError) as error:
            wrong.append(str(error))
    print("\n".join(wrong) or f"{len(names)} rules fit the sources")
    return bool(wrong)


def run(*command, **options):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, **options)
    if done.returncode:
        raise RuntimeError(f'{" ".join(map(str, command))}\n{done.stdout[-2000:]}{done.stderr[-2000:]}')


class Bench:
    """Programs, libraries with all rules and without one, recordings, and what came out, in one folder."""

    def __init__(self, folder):
        self.folder, self.lock = folder, threading.Lock()
        self.source, self.build = folder / "source", folder / "source/build/release"
        self.results_file = folder / "results.json"
        self.results = json.loads(self.results_file.read_text()) if self.results_file.exists() else {}

    def build_programs(self):
        for path in (path for name in SOURCES for path in [ROOT / name, *(ROOT / name).rglob("*")] if path.is_file()):
            copy = self.source / path.relative_to(ROOT)
            copy.parent.mkdir(parents=True, exist_ok=True)
            # A run that was cut off may have left a rule switched off.
            if not copy.exists() or copy.read_bytes() != path.read_bytes():
                copy.write_bytes(path.read_bytes())
                shutil.copymode(path, copy)
        run("cmake", "--preset", "release", "-DQUADMAP_BUILD_TESTS=OFF", "-DQUADMAP_TOGETHER=ON", cwd=self.source)
        run("cmake", "--build", self.build, "--target", "programs")

    def libraries_without(self, rule):
        """Folder with the libraries that do without the rule."""
        folder = self.folder / "libraries" / rule["rule"]
        with self.lock:  # one folder of sources
            if not folder.exists():
                self.build_without(rule, folder)
        return folder

    def build_without(self, rule, folder):
        kept = {name: (self.source / name).read_text() for name in {edit["file"] for edit in rule["edits"]}}
        try:
            for name, text in switched_off(rule, self.source).items():
                (self.source / name).write_text(text)
            run("cmake", "--build", self.build, "--target", "programs")
            folder.mkdir(parents=True)
            # All of them: rules are in several, and those of the build change with the next rule.
            for library in (self.build / "lib").glob("libquadmap-*.so.0"):
                shutil.copy(library, folder)
        finally:
            for name, text in kept.items():
                (self.source / name).write_text(text)

    def recordings(self, rooms):
        """{name: (folder, poses)}; those that are not there are made."""
        out = {}
        data = pathlib.Path(os.environ.get("QUADMAP_TEST_DATA", ROOT.parent / "shared/data")).resolve()
        for name, (source, boxes, poses, without) in REAL.items():
            if (data / source).exists():
                out[name] = (self.recorded(name, data / source, boxes, poses, without), poses)
        for scene in SCENES:
            out[f"room {scene}"] = (self.simulated(scene), "odometry")
        for seed in rooms:
            out[f"room {seed}"] = (self.simulated("random", seed), "odometry")
        return out

    def recorded(self, name, source, boxes, poses, without):
        folder = self.folder / "recordings" / name.replace(" ", ".")
        if not (folder / "objects.gt.json").exists():
            shutil.rmtree(folder, ignore_errors=True)
            (folder / "images").mkdir(parents=True)
            for path in source.iterdir():
                if path.name != "associations.txt":
                    (folder / "images" / path.name).symlink_to(path)
            associations = (source / "associations.txt").read_text().splitlines(keepends=True)
            (folder / "images/associations.txt").write_text("".join(associations[int(without * len(associations)):]))
            run(self.build / "bin/quadmap-import", "tum", folder / "images", "--images-anywhere", "--poses-as", poses,
                "--detections", source / boxes, "-o", folder / "x.rawlog")
            shutil.copy(source / "groundtruth.txt", folder / "groundtruth.tum")
            shutil.copy(source / "objects_gt.json", folder / "objects.gt.json")
        return folder

    def simulated(self, scene, seed=1):
        folder = self.folder / f"recordings/{scene}.{seed}"
        if not (folder / "objects.gt.json").exists():
            folder.mkdir(parents=True, exist_ok=True)
            run(self.build / "bin/quadmap-simulate", scene, "--seed", seed, "--resolution", "320x240",
                "-o", folder / "x.rawlog")
            for name in ("groundtruth.tum", "objects.gt.json"):
                (folder / f"x.{name}").rename(folder / name)
        return folder

    def measure(self, rule, libraries, recording, poses):
        """F1, Trans [m], Shape and the worth, F1 times the IoU in 3D, of one run."""
        out = self.folder / "runs" / rule / recording.name
        environment = dict(os.environ, LD_LIBRARY_PATH=str(libraries))
        shutil.rmtree(out, ignore_errors=True)
        out.parent.mkdir(parents=True, exist_ok=True)
        odometry = "ground-truth" if poses == "ground-truth" else "rawlog"
        run(self.build / "bin/quadmap-slam", recording / "x.rawlog", "-o", out, "--threads", 1,
            "--odometry", odometry, env=environment)
        figures = out.with_suffix(".json")
        run(self.build / "bin/quadmap-evaluate", out, "--objects", recording / "objects.gt.json",
            "--trajectory", recording / "groundtruth.tum", "--json", figures)
        objects = json.loads(figures.read_text())["objects"]
        shutil.rmtree(out)
        worth = objects["f1"] * (objects["iou_3d"] or 0)
        return {"f1": objects["f1"], "trans": objects["trans_m"], "shape": objects["shape_iou"], "worth": worth}

    def keep(self, rule, name, figures):
        with self.lock:
            self.results.setdefault(rule, {})[name] = figures
            self.results_file.write_text(json.dumps(self.results, indent=1))


def run_all(bench, rules, rooms, jobs):
    """Returns the names of the recordings."""
    bench.build_programs()
    recordings = bench.recordings(rooms)
    left = len(rules) + 1

    def without(rule):
        nonlocal left
        missing = [name for name in recordings if name not in bench.results.get(rule["rule"], {})]
        libraries = bench.libraries_without(rule) if missing else None
        for name in missing:
            bench.keep(rule["rule"], name, bench.measure(rule["rule"], libraries, *recordings[name]))
        left -= 1
        print(f"\r{left} rules left ", end="", file=sys.stderr, flush=True)

    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        for job in [pool.submit(without, rule) for rule in [{"rule": "none", "edits": []}] + rules]:
            job.result()
    print(file=sys.stderr)
    return list(recordings)


def table(bench, rules, recordings):
    """One row a rule, those that are worth most first: loss of each figure without it, in hundredths."""
    groups = {"rooms": [r for r in recordings if r.startswith("room ")], "real": [r for r in recordings if r in REAL]}
    base, rows = bench.results["none"], []

    def loss(rule, names, figure):
        differences = [base[n][figure] - bench.results[rule][n][figure] for n in names
                       if base[n][figure] is not None and bench.results[rule][n][figure] is not None]
        return 100 * statistics.fmean(differences) if differences else 0.0

    for rule in rules:
        worths = [base[n]["worth"] - bench.results[rule["rule"]][n]["worth"] for n in recordings]
        cells = [f'{loss(rule["rule"], names, figure):.1f}' for names in groups.values() if names
                 for figure in ("f1", "shape", "worth")]
        rows.append((statistics.fmean(worths), max(worths), rule, cells))
    rows.sort(key=lambda row: -row[0])
    lines = ["| rule | equation | what it does | " + " | ".join(
        f"{group}: {figure}" for group, names in groups.items() if names for figure in ("F1", "Shape", "worth")) + " | most |"]
    lines.append("|" + "---|" * (lines[0].count("|") - 1))
    for _, most, rule, cells in rows:
        lines.append(f'| {rule["rule"]} | {rule["equation"]} | {rule["what"]} | {" | ".join(cells)} | {100 * most:.1f} |')
    return "\n".join(lines) + "\n"


def put_on(page, text):
    """Replaces the last table of a page, or makes a page of it."""
    lines = page.read_text().splitlines(keepends=True) if page.exists() else []
    end = max((i + 1 for i, line in enumerate(lines) if line.startswith("|")), default=len(lines))
    begin = end
    while begin > 0 and lines[begin - 1].startswith("|"):
        begin -= 1
    page.write_text("".join(lines[:begin]) + text + "".join(lines[end:]))


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("folder", nargs="?", type=lambda name: pathlib.Path(name).resolve())
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--rooms", type=int, default=4)
    parser.add_argument("--first-seed", type=int, default=301)
    parser.add_argument("--rules", default="")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--page", type=pathlib.Path)
    choice = parser.parse_args()
    if choice.check or not choice.folder:
        sys.exit(check() if choice.check else parser.error("a folder is needed"))
    if choice.rules and choice.page:
        parser.error("a page has the table of all rules: --page goes without --rules")
    try:
        rules = chosen(choice.rules.split(",")) if choice.rules else read_rules()
    except ValueError as error:
        parser.error(str(error))
    bench = Bench(choice.folder)
    rooms = range(choice.first_seed, choice.first_seed + choice.rooms)
    text = table(bench, rules, run_all(bench, rules, rooms, choice.jobs))
    put_on(choice.page, text) if choice.page else print(text)


if __name__ == "__main__":
    main()
