"""check_schemas.py SOURCE BIN: every JSON file that programs write, and every one that the documentation shows, is
valid by its schema, whose numbers are numbers. Each schema refuses what is not of its form."""
import copy
import json
import pathlib
import re
import subprocess
import sys
import tempfile

try:
    import jsonschema
except ImportError:
    print("skipped: the Debian package python3-jsonschema is missing")
    sys.exit(77)

SOURCE, BIN = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
SCHEMAS = {}
for path in (SOURCE / "share/quadmap/schemas").glob("*.schema.json"):
    schema = json.loads(path.read_text())
    jsonschema.Draft202012Validator.check_schema(schema)
    SCHEMAS["quadmap-" + path.name.split(".")[0]] = jsonschema.Draft202012Validator(schema)
failures, seen = [], set()


def run(program, *arguments):
    """A program of ours in the current folder; what it prints."""
    return subprocess.run([BIN / program, *map(str, arguments)], check=True, capture_output=True, text=True,
                          env={"PATH": "/usr/bin:/bin", "QUADMAP_SHARE_DIR": str(SOURCE / "share/quadmap")}).stdout


def require_valid(name, document):
    """Valid by the schema that its format names; damaged in any of a few ways it is not."""
    form = document.get("format")
    if form not in SCHEMAS:
        failures.append(f"{name}: its format {form!r} has no schema")
        return
    seen.add(form)
    for error in SCHEMAS[form].iter_errors(document):
        failures.append(f"{name}: {'/'.join(map(str, error.absolute_path))}: {error.message[:300]}")
    damaged = {f"without {key}": {k: v for k, v in document.items() if k != key}
               for key in SCHEMAS[form].schema["required"]}
    damaged["with more"] = {**document, "more": 1}
    damaged["of a newer version"] = {**document, "version": 2}
    damaged["with a version in words"] = {**document, "version": "1"}
    for how, other in damaged.items():
        if SCHEMAS[form].is_valid(other):
            failures.append(f"{name}: the schema of {form} admits it {how}")


def require_no_numbers_in_words(name, configuration):
    for section, options in configuration.items():
        for key, value in options.items():
            if isinstance(value, str) and re.fullmatch(r"-?[0-9.]+(e[-+]?[0-9]+)?|true|false", value):
                failures.append(f"{name}: [{section}] {key} is {value!r}, a text")


def check_objects(document):
    """What a writer may get wrong in one object."""
    for change in ({"center": ["1", 0, 0]}, {"size": [1, 1, 0]}, {"existence": 1.5}, {"first_seen": "today"}, {"colour": "red"}):
        other = copy.deepcopy(document)
        other["objects"][0].update(change)
        if SCHEMAS["quadmap-objects"].is_valid(other):
            failures.append(f"an object with {change} is valid")


def check_programs():
    scene = ("--frames", 40, "--resolution", "160x120")
    run("quadmap-simulate", "home", "-o", "x.rawlog", *scene)
    load = lambda path: json.loads(pathlib.Path(path).read_text())
    require_valid("truth", load("x.objects.gt.json"))
    for out, options in {"rawlog": (), "visual": ("--odometry", "visual"), "given": ("--odometry", "ground-truth"),
                         "quadric": ("--method", "quadric"), "point": ("--method", "point"),
                         "odometry": ("--method", "odometry"), "again": ("--map", "rawlog/objects.quadmap")}.items():
        run("quadmap-slam", "x.rawlog", "-o", out, *options)
        report = load(out + "/report.json")
        require_valid(out + "/report.json", report)
        require_no_numbers_in_words(out, report["configuration"])
        require_valid(out + "/objects.json", load(out + "/objects.json"))
        run("quadmap-evaluate", out, "--objects", "x.objects.gt.json", "--trajectory", "x.groundtruth.tum", "--json", "e.json")
        require_valid(out + " evaluated", load("e.json"))
    run("quadmap-localize", "x.rawlog", "--map", "rawlog", "-o", "localised")
    require_valid("localization.json", load("localised/localization.json"))
    objects = load("rawlog/objects.json")
    if not all("first_seen" in o and o["first_seen"] <= o["last_seen"] for o in objects["objects"]):
        failures.append("objects.json: no time when an object was seen")
    check_objects(objects)
    run("quadmap-evaluate", "rawlog/trajectory.tum", "--trajectory", "x.groundtruth.tum", "--json", "e.json")
    require_valid("a trajectory evaluated", load("e.json"))
    run("quadmap-export", "rawlog", "--json", "o.json")
    require_valid("quadmap-export --json", load("o.json"))
    require_valid("quadmap-map query --json", json.loads(run("quadmap-map", "query", "rawlog/objects.quadmap", "--json")))
    for question in (("nearest", "chair", "to", "the", "bed"), ("chairs",)):
        answer = run("quadmap-map", "query", "rawlog", *question, "--json")
        require_valid(f"answer to {question}", json.loads(answer))
    run("quadmap-map", "merge", "rawlog", "given", "-o", "merged.quadmap")
    require_valid("quadmap-map merge", load("merged.merge.json"))
    require_valid("quadmap-benchmark machine", json.loads(run("quadmap-benchmark", "machine", "--commit", "abc")))
    tables = BIN / "observation_tables"
    if tables.exists():
        run(tables.name, "orientation", "--scene", "home", "--seeds", 1, "--frames-step", 60, "--json", "t.json")
        require_valid("observation_tables --json", load("t.json"))


def check_documentation():
    text = (SOURCE / "doc/formats.md").read_text()
    blocks = re.findall(r"^```json\n(.*?)^```", text, re.S | re.M)
    for block in blocks:
        require_valid("doc/formats.md", json.loads(block))
    require_valid("rawlogs", json.loads((SOURCE / "rawlogs/home.objects.gt.json").read_text()))


with tempfile.TemporaryDirectory() as folder:
    import os
    os.chdir(folder)
    check_programs()
    check_documentation()
unseen = set(SCHEMAS) - seen - ({"quadmap-observation"} if not (BIN / "observation_tables").exists() else set())
failures += [f"no file of the form {form} was checked" for form in sorted(unseen)]
print("\n".join(failures) or f"valid: files of {len(seen)} forms")
sys.exit(bool(failures))
