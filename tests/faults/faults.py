#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The program tried from outside: killed, interrupted, without disk, without memory.

usage: faults.py LACUNA SCRATCH [--long] [--seed N] [--only NAME]
Each trial runs LACUNA on a recipe in a folder of its own below SCRATCH and does something to it. What has to
hold: a file is the old one or the new one, whole; nothing else is left in the folder, but for the whole new
file of a recipe that was killed while it replaced one; what fails says so in a sentence, with exit code 1; an
interrupted recipe ends with 130 within half a second. A part that this machine cannot try (no root, no mount)
is named in the output. Exit 1 when anything fails.
"""
import argparse
import contextlib
import os
import pathlib
import random
import resource
import shutil
import signal
import subprocess
import sys
import time

NOBODY = 65534
INTERRUPT_SECONDS = 0.5  # what the program promises on a machine with nothing else to do
TIMEOUT = 60

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("lacuna", type=pathlib.Path)
parser.add_argument("scratch", type=pathlib.Path)
parser.add_argument("--long", action="store_true", help="200 kills of each kind rather than a few")
parser.add_argument("--seed", type=int, default=1)
parser.add_argument("--only", default="", help="the parts whose name holds this")
arguments = parser.parse_args()
LACUNA = str(arguments.lacuna.resolve())
SCRATCH = arguments.scratch.resolve()
dice = random.Random(arguments.seed)
failures = []


def fail(what):
    failures.append(what)
    print("FAIL " + what, flush=True)


def often(short, long):
    return long if arguments.long else short


def busy():
    """How many times slower than an idle machine this one may be, at least 1."""
    return max(1.0, os.getloadavg()[0] / (os.cpu_count() or 1))


@contextlib.contextmanager
def folder(name, recipe):
    """An empty folder below SCRATCH, with the recipe beside it and not in it."""
    path = SCRATCH / name
    shutil.rmtree(path, ignore_errors=True)
    path.mkdir(parents=True)
    head = 'local lacuna = require "lacuna"\nio.stdout:setvbuf "line"\n'
    (SCRATCH / (name + ".lua")).write_text(head + recipe)
    yield path
    shutil.rmtree(path, ignore_errors=True)


def start(path, *words, **options):
    pipe = subprocess.PIPE
    options = {"stdin": pipe, "stdout": pipe, "stderr": pipe, "text": True, **options}
    recipe = SCRATCH / (path.name + ".lua")
    return subprocess.Popen([LACUNA, str(recipe), *words], cwd=path, **options)


def finish(process, what, told=""):
    try:
        out, err = process.communicate(told, timeout=TIMEOUT)
    except subprocess.TimeoutExpired:
        process.kill()
        out, err = process.communicate()
        fail(f"{what}: not done after {TIMEOUT} s")
    return process.returncode, out or "", err or ""


def run(path, what, *words, **options):
    return finish(start(path, *words, **options), what)


def must_work(path, what):
    code, out, err = run(path, what)
    if code != 0:
        sys.exit(f"{what}: the recipe fails without any fault: exit {code}: {err}")
    return out


def workers_of(process):
    """The process numbers of the CAD processes that this one has started."""
    found = []
    with contextlib.suppress(OSError):
        for task in os.listdir(f"/proc/{process.pid}/task"):
            for child in pathlib.Path(f"/proc/{process.pid}/task/{task}/children").read_text().split():
                if "lacuna-cad" in pathlib.Path(f"/proc/{child}/comm").read_text():
                    found.append(int(child))
    return found


def alive(pid):
    try:
        return pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] not in "ZX"
    except OSError:
        return False


def check_sentence(what, code, err, names=()):
    if code != 1:
        fail(f"{what}: exit {code}, not 1: {err.strip()[:200]}")
    elif len(err.strip()) < 20 or not err.startswith("lacuna: "):
        fail(f"{what}: no sentence but {err.strip()[:200]!r}")
    elif names and not any(name in err for name in names):
        fail(f"{what}: names none of {', '.join(names)}: {err.strip()[:200]}")


def check_files(path, what, wholes, may_miss=True):
    """Every file in the folder is known, and has one of the contents in wholes[name]."""
    for entry in sorted(path.iterdir()):
        if entry.name not in wholes:
            fail(f"{what}: {entry.name} is left in the folder")
        elif entry.read_bytes() not in wholes[entry.name]:
            fail(f"{what}: {entry.name} is half a file ({entry.stat().st_size} bytes)")
    if not may_miss:
        for name in wholes:
            if not (path / name).exists():
                fail(f"{what}: {name} is gone")


# --- killed while it makes and writes meshes ---

def check_replaced(path, what, is_whole):
    """A kill between the two system calls that replace a file leaves the new one whole under a hidden name,
    which the next replacing removes.

    `is_whole(name, bytes)` says whether a file's content is one of those it may have."""
    for left in [entry for entry in path.iterdir() if ".replacing-" in entry.name]:
        name, content = left.name[1:].split(".replacing-")[0], left.read_bytes()
        print(f"{what}: killed while it replaced {name}", flush=True)
        if not is_whole(name, content):
            fail(f"{what}: {left.name} is half a file ({len(content)} bytes)")
        must_work(path, what)
        if left.exists():
            fail(f"{what}: {left.name} stays in the folder after the next writing")


WRITES = """
local m = lacuna.synthetic.prism { sides = 6, radius = 2, height = 5, holes = 1 }
local v = m:open_volume { source = "source", target = "target", walls = "auto" }
v:close()
local mesh = v:sweep { layers = 40, size = 0.1 }
for i = 1, 6 do
  mesh:write "old.msh" mesh:write "new.msh" mesh:write "new.vtu" v:write_facets "new.stl"
end
"""
WRITES_CAD = """
local m = lacuna.synthetic.prism { sides = 14, holes = 3 }
local v = m:open_volume { source = "source", target = "target", walls = "auto" }
v:write_cad "old.step" v:write_cad "new.step"
"""


def without_dates(text):
    """A STEP file without the line that says when it was written."""
    return b"\n".join(line for line in text.split(b"\n") if b"FILE_NAME" not in line)


def killed():
    for kind, code in ((signal.SIGKILL, -9), (signal.SIGTERM, 143), (signal.SIGINT, 130)):
        with folder("killed", WRITES) as path:
            old = b"what was there before\n"
            (path / "old.msh").write_bytes(old)
            begin = time.monotonic()
            must_work(path, "killed")
            span = time.monotonic() - begin
            wholes = {entry.name: [entry.read_bytes()] for entry in path.iterdir()}
            wholes["old.msh"].append(old)
            hits = 0
            for trial in range(often(2, 200)):
                for entry in path.iterdir():
                    entry.unlink()
                (path / "old.msh").write_bytes(old)
                what = f"{kind.name} trial {trial}"
                process = start(path)
                time.sleep(dice.uniform(0.01, span))
                process.send_signal(kind)
                ended, _, err = finish(process, what)
                # Before the program listens, a signal ends it as it ends any program.
                if ended not in (code, 0, -kind):
                    fail(f"{what}: exit {ended}, not {code}: {err.strip()[:200]}")
                hits += ended != 0
                check_replaced(path, what, lambda name, content: content in wholes.get(name, ()))
                check_files(path, what, wholes)
                if not (path / "old.msh").exists():
                    fail(f"{what}: the old file is gone")
            print(f"killed: {kind.name} hit {hits} recipes of {trial + 1}, {span:.2f} s long", flush=True)


def killed_in_cad():
    with folder("killed_in_cad", WRITES_CAD) as path:
        old = b"what was there before\n"
        begin = time.monotonic()
        must_work(path, "killed_in_cad")
        span = time.monotonic() - begin
        whole = without_dates((path / "new.step").read_bytes()).count(b"\n")
        for trial in range(often(2, 50)):
            for entry in path.iterdir():
                entry.unlink()
            (path / "old.step").write_bytes(old)
            what = f"SIGKILL while CAD is written, trial {trial}"
            process = start(path)
            time.sleep(dice.uniform(0, span))
            workers = workers_of(process)
            process.kill()
            finish(process, what)
            patience = time.monotonic() + 2 * busy()
            while any(map(alive, workers)) and time.monotonic() < patience:
                time.sleep(0.01)
            if any(map(alive, workers)):
                fail(f"{what}: the CAD process outlives the program")

            def is_whole(name, text):
                return without_dates(text).count(b"\n") == whole or (name, text) == ("old.step", old)

            check_replaced(path, what, is_whole)
            for entry in path.iterdir():
                text = entry.read_bytes()
                if entry.name not in ("old.step", "new.step"):
                    fail(f"{what}: {entry.name} is left in the folder")
                elif not is_whole(entry.name, text):
                    fail(f"{what}: {entry.name} is half a file ({len(text)} bytes)")


# --- the CAD process killed ---

WORKER = """
local params = lacuna.params { caught = true }
local function round()
  local m = lacuna.load "part.step"
  local v = m:open_volume { source = m:face { near = { 0, 0, -9 } }, target = m:face { near = { 0, 0, 9 } },
    walls = "auto" }
  v:sweep { layers = 2, size = 0.2 }
  v:write_cad "out.step"
end
local errors = 0
print "READY"
for i = 1, 2 do
  if params.caught then
    local fine, message = pcall(round)
    if not fine then
      print("ERROR " .. tostring(message))
      round()
    end
  else
    round()
  end
end
"""


def worker_killed():
    with folder("part", """
local m = lacuna.synthetic.prism { sides = 12, holes = 3 }
m:open_volume { source = "source", target = "target", walls = "auto" }:write_cad "part.step"
""") as made:
        must_work(made, "part.step")
        part = (made / "part.step").read_bytes()
    with folder("worker", WORKER) as path:
        (path / "part.step").write_bytes(part)
        begin = time.monotonic()
        must_work(path, "worker")
        span = time.monotonic() - begin
        lines = (path / "out.step").read_bytes().count(b"\n")
        hits = errors = 0
        for trial in range(often(2, 200)):
            (path / "out.step").unlink(missing_ok=True)
            what = f"CAD process killed, trial {trial}"
            process = start(path, "caught=" + ("true" if trial % 2 == 0 else "false"))
            time.sleep(dice.uniform(0.02, span))
            workers = workers_of(process)
            for pid in workers:
                with contextlib.suppress(ProcessLookupError):
                    os.kill(pid, signal.SIGKILL)
            hits += bool(workers)
            code, out, err = finish(process, what)
            told = [line for line in out.splitlines() if line.startswith("ERROR ")]
            if code == 1 and trial % 2 == 1 and workers:
                errors += 1
                check_sentence(what, code, err, ("part.step", "out.step"))
            elif code != 0:
                fail(f"{what}: exit {code}: {err.strip()[:200]} {' '.join(told)[:200]}")
            for line in told:
                errors += 1
                if not any(name in line for name in ("part.step", "out.step")):
                    fail(f"{what}: the error names no file: {line[:200]}")
            for entry in path.iterdir():
                if entry.name not in ("part.step", "out.step"):
                    fail(f"{what}: {entry.name} is left in the folder")
            if (path / "out.step").exists() and (path / "out.step").read_bytes().count(b"\n") != lines:
                fail(f"{what}: out.step is half a file")
        print(f"worker: {hits} killed in {trial + 1} trials, {errors} errors, {span:.2f} s long", flush=True)


# --- no room, no right, no folder, no memory ---

MESH = """
local m = lacuna.synthetic.prism { sides = 6, radius = 2, height = 5, facets = 8 }
local v = m:open_volume { source = "source", target = "target", walls = "auto" }
v:close()
local mesh = v:sweep { layers = 8, size = 0.3 }
"""
OUTPUTS = {
    "out.msh": 'mesh:write "out.msh"', "out.vtu": 'mesh:write "out.vtu"', "out.vtk": 'mesh:write "out.vtk"',
    "out.stl": 'v:write_facets "out.stl"', "out.obj": 'v:write_facets "out.obj"',
    "out.step": 'v:write_cad "out.step"',
}
SMALL = 4096  # bytes; less than any of the outputs


def no_room():
    for name, line in OUTPUTS.items():
        with folder("no_room", MESH + line) as path:
            code, _, err = run(path, name,
                               preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (SMALL, SMALL)))
            check_sentence(f"{name} under ulimit -f", code, err, (name,))
            check_files(path, f"{name} under ulimit -f", {})
    caught = "\n".join(f"print(pcall(function() {line} end))" for line in OUTPUTS.values())
    with folder("full", MESH + caught) as path:
        mount = ["mount", "-t", "tmpfs", "-o", f"size={2 * SMALL}", "tmpfs", str(path)]
        mounted = os.geteuid() == 0 and subprocess.run(mount, stderr=subprocess.DEVNULL).returncode == 0
        if not mounted:
            print("left out: no_room: a full disk, as no file system may be mounted here", flush=True)
            return
        try:
            old = b"what was there before\n"
            (path / "out.msh").write_bytes(old)
            code, out, err = run(path, "full disk")
            rows = [row for row in out.splitlines() if row.startswith(("false", "true"))]
            if code != 0 or len(rows) != len(OUTPUTS):
                fail(f"full disk: exit {code}: {err.strip()[:200]}")
            for name, row in zip(OUTPUTS, rows):
                if not row.startswith("false") or name not in row:
                    fail(f"full disk: {name}: {row[:200]}")
            check_files(path, "full disk", {"out.msh": [old]}, may_miss=False)
        finally:
            # The CAD process ends a moment after the program, and stands in the folder until then.
            subprocess.run(["umount", "--lazy", str(path)], check=True)


def full_output():
    for words in ("print(('x'):rep(100))", "io.write 'x'", "for i = 1, 1e5 do print(i) end"):
        with folder("full_output", words) as path, open("/dev/full", "w") as full:
            code, _, err = run(path, "/dev/full", stdout=full)
            check_sentence(f"/dev/full as output of {words}", code, err)
    with folder("full_help", "") as path, open("/dev/full", "w") as full:
        for word in ("--help", "--version"):
            code = subprocess.run([LACUNA, word], stdout=full, stderr=subprocess.DEVNULL).returncode
            if code != 1:
                fail(f"{word} to /dev/full: exit {code}, not 1")


def unwritable():
    rights = {"user": NOBODY, "group": NOBODY, "extra_groups": []} if os.geteuid() == 0 else {}
    try:
        subprocess.run([LACUNA, "--version"], stdout=subprocess.DEVNULL, check=True, cwd="/", **rights)
        subprocess.run(["test", "-r", str(SCRATCH)], check=True, cwd="/", **rights)
    except (OSError, subprocess.CalledProcessError):
        print("left out: unwritable: nobody may not run the program or reach the folder", flush=True)
        return
    for name, line in OUTPUTS.items():
        with folder("unwritable", MESH + line) as path:
            os.chmod(path, 0o555)
            code, _, err = run(path, name, **rights)
            check_sentence(f"{name} into an unwritable folder", code, err, (name,))
            check_files(path, f"{name} into an unwritable folder", {})
            os.chmod(path, 0o755)


def vanishing():
    for name, line in OUTPUTS.items():
        line = line.replace("out.", "below/out.")
        with folder("vanishing", MESH + 'print "READY" io.read "l"\n' + line) as path:
            (path / "below").mkdir()
            process = start(path)
            process.stdout.readline()
            shutil.rmtree(path / "below")
            code, _, err = finish(process, name, "go\n")
            check_sentence(f"{name} into a folder that is gone", code, err, (name,))
            check_files(path, f"{name} into a folder that is gone", {})


def no_memory():
    ended = []
    facets = MESH.replace("layers = 8, size = 0.3", "layers = 60, size = 0.05") + OUTPUTS["out.msh"]
    cad = MESH + OUTPUTS["out.step"] + ' lacuna.load "out.step"'
    for kind, lines, megabytes in (("facets", facets, (12, 16, 20, 24, 32, 48, 64, 128, 256, 512)),
                                   ("CAD", cad, (16, 32, 64, 96, 128, 192, 256, 384, 768, 1536))):
        with folder("no_memory", lines) as path:
            must_work(path, "no_memory")
            name = next(path.iterdir()).name
            whole = (path / name).read_bytes().count(b"\n")
            for limit in megabytes[:: often(3, 1)]:
                (path / name).unlink(missing_ok=True)
                what = f"{kind} with ulimit -v of {limit} MB"
                size = limit << 20
                barely = lambda: resource.setrlimit(resource.RLIMIT_AS, (size, size))
                bare = subprocess.run([LACUNA, "--help"], preexec_fn=barely, capture_output=True)
                if bare.returncode != 0:  # the system's loader finds no room for the program itself
                    ended.append(f"{limit}: not loaded")
                    continue
                code, _, err = run(path, what, preexec_fn=barely)
                if code != 0:
                    check_sentence(what, code, err)
                ended.append(f"{limit}: {code}")
                for entry in path.iterdir():
                    if entry.name != name or entry.read_bytes().count(b"\n") != whole:
                        fail(f"{what}: {entry.name} is left or half a file")
        print(f"no_memory: {kind}: MB and exit code: {', '.join(ended)}", flush=True)
        ended.clear()


# --- interrupted ---

PREPARE = """
local m = lacuna.synthetic.prism { sides = 8, holes = 3, twist = 30, facets = 24,
  drop = { "wall_1", "wall_3" } }
local function open() return m:open_volume { source = "source", target = "target", walls = "auto" } end
local v = open()
"""
# What is made ready, and what is interrupted; the second is done over and over until it is stopped.
STAGES = {
    "synthetic": ("", "lacuna.synthetic.prism { sides = 8, holes = 3, twist = 30, facets = 100 }"),
    "match": (PREPARE, "open():match()"),
    "roles": (PREPARE, "m:open_volume()"),
    "close": (PREPARE, "open():close()"),
    "sweep": (PREPARE + "v:close()", "v:sweep { layers = 40, size = 0.02 }"),
    "load of facets": (PREPARE + 'v:close() v:write_facets "big.stl"', 'lacuna.load "big.stl"'),
    "load of CAD": ('local p = lacuna.synthetic.prism { sides = 14, holes = 3 } '
                    'p:open_volume { source = "source", target = "target", walls = "auto" }'
                    ':write_cad "big.step"',
                    'lacuna.load "big.step"'),
}


def interrupted():
    worst = {}
    for name, (ready, line) in STAGES.items():
        with folder("interrupted", f'{ready}\nprint "READY"\nwhile true do {line} end\n') as path:
            for trial in range(often(1, 20)):
                what = f"Ctrl-C during {name}, trial {trial}"
                process = start(path)
                if process.stdout.readline() != "READY\n":
                    code, _, err = finish(process, what)
                    fail(f"{what}: never got there: exit {code}: {err.strip()[:200]}")
                    break
                time.sleep(dice.uniform(0, 0.8))
                begin = time.monotonic()
                process.send_signal(signal.SIGINT)
                code, _, err = finish(process, what)
                taken = time.monotonic() - begin
                worst[name] = max(worst.get(name, 0), taken)
                if code != 130:
                    fail(f"{what}: exit {code}, not 130: {err.strip()[:200]}")
                if taken > INTERRUPT_SECONDS * busy():
                    fail(f"{what}: {taken:.2f} s, allowed {INTERRUPT_SECONDS} s × {busy():.1f}, the load")
    rows = ", ".join(f"{name} {taken:.2f} s" for name, taken in worst.items())
    print(f"interrupted: worst {rows}", flush=True)


SCRATCH.mkdir(parents=True, exist_ok=True)
PARTS = (killed, killed_in_cad, worker_killed, no_room, full_output, unwritable, vanishing, no_memory,
         interrupted)
for part in PARTS:
    if arguments.only in part.__name__:
        begin = time.monotonic()
        part()
        print(f"{part.__name__}: {time.monotonic() - begin:.1f} s", flush=True)
print(f"{len(failures)} failures" if failures else "all parts hold")
sys.exit(1 if failures else 0)
