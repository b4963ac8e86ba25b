# SPDX-License-Identifier: MIT
"""worker.py FOLDER: do the job of FOLDER/request.json with the package `lacuna`, in a process of its own.

The answer is FOLDER/result.json, beside it mesh.unv and sealed.brep. A line of standard output is a step of
progress, as JSON: [stage, share of the job]. The process ends when its standard input does, so that none outlives FreeCAD.
"""
import json
import logging
import math
import os
import re
import shutil
import sys
import threading

try:
    import lacuna
except ImportError as error:
    lacuna, missing = None, error


class Notes(logging.Handler):
    """What Lacuna assumed."""

    def __init__(self):
        super().__init__(logging.WARNING)
        self.lines = []

    def emit(self, record):
        self.lines.append(record.getMessage())


def end_with_the_host(folder):
    """FreeCAD holds the other end of standard input: nothing is left when it crashes."""
    def wait():
        sys.stdin.buffer.read()
        shutil.rmtree(folder, ignore_errors=True)
        os._exit(1)
    threading.Thread(target=wait, daemon=True).start()


def face_tags(model, faces):
    """Lacuna's tag of each face of FreeCAD, by area and centre; a face that was not read has none.

    Facets of a bent face are a little smaller than the face, so the closest is taken and then judged.
    """
    free = {face.tag: (face.area, face.centroid) for face in model.faces()}
    tags = {}
    for number, face in enumerate(faces, 1):
        size = math.sqrt(face["area"])
        def difference(tag):
            area, centre = free[tag]
            return math.dist(centre, face["centre"]) / size + abs(area / face["area"] - 1)
        # Of two faces that are alike the one with the same number.
        best = min(free, key=lambda tag: (round(difference(tag), 6), tag != number), default=None)
        if best is not None and difference(best) < 0.2:  # 0.1 is a full circle of four facets
            tags[number] = best
            del free[best]
    return tags


class Progress:
    """Prints the stage and the share of the job. Each call of Lacuna tells its own shares, from 0 to 1."""

    def __init__(self):
        self.part(0, 0.1)  # the part is read

    def part(self, begin, end):
        """The next call of Lacuna is this part of the job."""
        self._begin, self._length = begin, end - begin

    def __call__(self, stage, share):
        print(json.dumps([stage, self._begin + share * self._length]), flush=True)


class Faces:
    """FreeCAD's numbers of faces as Lacuna's tags, and texts with tags as texts with FreeCAD's names."""

    def __init__(self, model, faces):
        self._tags = face_tags(model, faces)
        self._numbers = {tag: number for number, tag in self._tags.items()}

    def roles(self, roles):
        return {role: [self._tag(number) for number in value] if isinstance(value, list) else value
                for role, value in roles.items()}

    def numbers(self, tags):
        return sorted(self._numbers[tag] for tag in tags if tag in self._numbers)

    def named(self, text):
        """`face 3` and `faces 3, 4` are called Face3 and Face3, Face4, as FreeCAD calls them."""
        def name(tag):
            return f"Face{self._numbers.get(int(tag[0]), tag[0])}"
        return re.sub(r"(?<!void )\b[Ff]aces? (\d+(?:(?:, | and | or | to )\d+)*)\b",
                      lambda found: re.sub(r"\d+", name, found[1]), text)

    def named_wall(self, group):
        """`wall:3` or `face:3` with FreeCAD's number of the face."""
        return re.sub(r"^(wall|face):(\d+)$",
                      lambda found: f"{found[1]}:{self._numbers.get(int(found[2]), found[2])}", group)

    def _tag(self, number):
        if number not in self._tags:
            raise lacuna.Error(f"Face{number} is not in the part, or was not read because it is damaged or "
                               "no wider than the tolerance. Choose the faces again.", "freecad.no_face")
        return self._tags[number]


def find(model, faces, request):
    """The voids of the part, each with the numbers of its faces; no faces stand for all."""
    voids = []
    if not any(request["roles"].get(role) for role in ("source", "target", "walls", "faces")):
        voids = [{"kind": cavity.kind, "class": cavity.class_, "volume": cavity.volume,
                  "faces": faces.numbers(cavity.faces)}
                 for cavity in model.cavities()]
    if not voids:
        void = model.open_volume(faces.roles(request["roles"]))
        return {"voids": [], "report": void.describe().splitlines()}
    return {"voids": voids}


def write_solid(void, path):
    """The mesh is there: without a solid too it is worth to be handed over, with a note."""
    try:
        void.write_cad(path)
    except lacuna.Error as error:
        logging.getLogger("lacuna").warning("note: no sealed solid: %s", error)


def fill(model, faces, request, folder, progress):
    progress.part(0.1, 0.8)
    void = model.open_volume(faces.roles(request["roles"]))
    if request["close"]:
        void.close(request["close"])
    mesh = void.sweep(request["sweep"])
    progress.part(0.8, 0.9)
    mesh.write(os.path.join(folder, "mesh.unv"))
    if request["solid"]:
        progress.part(0.9, 1)
        write_solid(void, os.path.join(folder, "sealed.brep"))
    fidelity = mesh.fidelity
    return {"class": void.class_, "report": [*void.describe().splitlines(), *mesh.report],
            "nodes": mesh.nodes, "hexes": mesh.hexes, "wedges": mesh.wedges, "pyramids": mesh.pyramids,
            "tets": mesh.tets, "volume": fidelity.volume, "sealed_volume": fidelity.sealed_volume,
            "min_scaled_jacobian": mesh.quality().min_scaled_jacobian,
            "groups": {group["name"]: faces.named_wall(group["name"]) for group in mesh.groups()}}


def named_error(error, faces):
    named = faces.named if faces else str
    tags = [entity["tag"] for entity in error.entities if entity["kind"] == "face"]
    return {"message": named(error.message), "code": error.code, "faces": faces.numbers(tags) if faces else [],
            "attempts": [named(attempt["message"]) for attempt in error.attempts]}


def answer(folder, request, progress):
    faces = None
    try:
        model = lacuna.load(os.path.join(folder, "part.brep"))
        faces = Faces(model, request["faces"])
        result = find(model, faces, request) if request["action"] == "find" else \
            fill(model, faces, request, folder, progress)
    except lacuna.Error as error:
        result = {"error": named_error(error, faces)}
    named = faces.named if faces else str
    result["report"] = [named(line) for line in result.get("report", [])]
    return result, named


def main():
    folder = sys.argv[1]
    end_with_the_host(folder)
    with open(os.path.join(folder, "request.json")) as file:
        request = json.load(file)
    if lacuna is None:
        result = {"error": {
            "message": f"{sys.executable} has no package lacuna ({missing}). Install python3-lacuna, or run "
            "hosts/freecad/install --python with the path of a Python that has it.",
            "code": "freecad.no_package", "faces": [], "attempts": []}}
    else:
        notes = Notes()
        logging.getLogger("lacuna").addHandler(notes)
        progress = Progress()
        with lacuna.progress(progress):
            result, named = answer(folder, request, progress)
        result["notes"] = [named(note) for note in notes.lines]
    with open(os.path.join(folder, "result.json"), "w") as file:
        json.dump(result, file)


if __name__ == "__main__":
    main()
