#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Skins of swept meshes against the CAD faces they stand for, by Gmsh's own evaluation of the file.

usage: skin_on_faces.py LACUNA SHARED [--only REGEX]    Exit 77 where there is no SHARED/cases.json or no Gmsh.

Nothing of the kernel is used but the mesh it writes and the distances it reports. Nodes, middles of sides and
centres of a face's quads are projected onto the face and, where they fall outside its trimming, onto the curves
of its border. Nodes of Gmsh's own mesh of the face, which lie on it, are compared with the quads.

For every face: the two are at most a quarter of the longest quad's side apart; the project's report of that
face says no less than a hundredth below what is found here, and no more than half above it. A mesh that fails
nothing proves little, so one node of every mesh is then moved off its face by half a side, and that has to be
found.

One case of each file is judged, or all with LACUNA_WHOLE_FAMILIES.
"""
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

SHARE_OF_SIDE = 0.25  # what a sweep allows where nothing is said
# Of what is found here: what the report may say. It compares nodes, middles of sides and middles of quads, and
# slanted quads on a bend were up to 1.2 % further off between these.
LESS, MORE = 0.98, 1.5
ROUNDING = 1e-6  # of the face's extent: how well Open CASCADE finds the nearest point

RECIPE = """
local lacuna = require "lacuna"
local part = lacuna.load "{file}"
local void = part:open_volume {{ {roles} }}
void:close()
local mesh = void:sweep {{ layers = 8, size = {size:.6g} }}
mesh:write("{mesh}", {{ groups = "all" }})
for tag, face in pairs(mesh.fidelity.faces) do
  print("FACE", tag, ("%.17g"):format(face.max_distance))
end
"""


def size_of(case):
    """An eighth of the source, or of the volume, or a tenth of the middle extent of the walls."""
    kept = case["kept"]
    area = sum(kept[str(tag)]["area"] for tag in case["source"])
    volume = case.get("reference_volume") or case.get("solid_volume")
    if area > 0:
        return math.sqrt(area) / 8
    if volume:
        return abs(volume) ** (1 / 3) / 8
    boxes = [face["bbox"] for face in kept.values()]
    extents = [max(b[i + 3] for b in boxes) - min(b[i] for b in boxes) for i in range(3)]
    return sorted(extents)[1] / 10


def sweep(lacuna, case, data, folder):
    """The mesh's path, and the largest distance the project reports of each face."""
    roles = ", ".join("%s = { %s }" % (role, ", ".join(map(str, case[role])))
                      for role in ("source", "target", "walls") if case[role])
    mesh = folder / "case.msh"
    script = folder / "case.lua"
    script.write_text(RECIPE.format(file=data / case["file"], roles=roles, size=size_of(case), mesh=mesh))
    run = subprocess.run([lacuna, str(script)], capture_output=True, text=True, timeout=600)
    if run.returncode != 0:
        raise RuntimeError((run.stderr.strip().splitlines() or ["ended without a word"])[0])
    words = [line.split() for line in run.stdout.splitlines() if line.startswith("FACE")]
    return mesh, {word[1]: float(word[2]) for word in words}


def read_skin(path):
    """Quads of each patch as corner points, with the names of its groups."""
    gmsh.model.add("mesh")
    gmsh.merge(str(path))
    tags, points, _ = gmsh.model.mesh.getNodes()
    order = np.argsort(tags)
    tags, points = np.asarray(tags)[order], np.asarray(points).reshape(-1, 3)[order]
    patches = []
    for _, entity in gmsh.model.getEntities(2):
        groups = [gmsh.model.getPhysicalName(2, g) for g in gmsh.model.getPhysicalGroupsForEntity(2, entity)]
        types, _, nodes = gmsh.model.mesh.getElements(2, entity)
        for kind, list_of_nodes in zip(types, nodes):
            assert kind == 3, "the skin is to be quads"
            quads = np.searchsorted(tags, np.asarray(list_of_nodes).reshape(-1, 4))
            patches.append((groups, points[quads]))
    gmsh.model.remove()
    return patches


class CadFace:
    """A face of the CAD model at hand, as Gmsh evaluates it."""

    def __init__(self, tag):
        self.tag = tag
        self.curves = [abs(curve) for _, curve in gmsh.model.getBoundary([(2, tag)], oriented=False)]
        box = gmsh.model.getBoundingBox(2, tag)
        self.extent = math.dist(box[:3], box[3:])
        tags, points, _ = gmsh.model.mesh.getNodes(2, tag, includeBoundary=True)
        order = np.argsort(tags)
        self.points = np.asarray(points).reshape(-1, 3)[order]
        corners = gmsh.model.mesh.getElementsByType(2, tag)[1]
        corners = np.searchsorted(np.asarray(tags)[order], corners).reshape(-1, 3)
        self.triangles = self.points[corners]
        # How far Gmsh's triangles are off the face they stand for.
        centres = self.triangles.mean(axis=1)
        on_surface = np.asarray(gmsh.model.getClosestPoint(2, tag, centres.reshape(-1))[0]).reshape(-1, 3)
        self.sag = 1.5 * np.linalg.norm(centres - on_surface, axis=1).max() + ROUNDING * self.extent

    def distances(self, points):
        """From each point to the nearest one of the trimmed face."""
        on_surface = np.asarray(gmsh.model.getClosestPoint(2, self.tag, points.reshape(-1))[0]).reshape(-1, 3)
        found = np.linalg.norm(points - on_surface, axis=1)
        # Gmsh's isInside() asks for the range of the parameters alone: whether a place is within the trimming
        # is known by Gmsh's triangles.
        outside = np.flatnonzero(distances_to_triangles(on_surface, self.triangles) > self.sag)
        if len(outside) > 0:
            found[outside] = self.distances_to_border(points[outside])
        return found

    def distances_to_border(self, points):
        found = np.full(len(points), np.inf)
        for curve in self.curves:
            low, high = (bound[0] for bound in gmsh.model.getParametrizationBounds(1, curve))
            nearest = gmsh.model.getClosestPoint(1, curve, points.reshape(-1))[0]
            place = np.clip(gmsh.model.getParametrization(1, curve, nearest), low, high)
            for at in (place, np.full(len(points), low), np.full(len(points), high)):
                on_curve = np.asarray(gmsh.model.getValue(1, curve, at)).reshape(-1, 3)
                found = np.minimum(found, np.linalg.norm(points - on_curve, axis=1))
        return found


def distances_to_triangles(points, triangles):
    """From each point to the nearest of the triangles with the nearest centres."""
    found = np.full(len(points), np.inf)
    centre = triangles.mean(axis=1)
    most = min(48, len(triangles))
    for start in range(0, len(points), 256):
        p = points[start:start + 256]
        away = ((p[:, None] - centre) ** 2).sum(axis=2)
        near = triangles[np.argpartition(away, most - 1, axis=1)[:, :most]]
        found[start:start + 256] = distances_to_own(p[:, None], near)
    return found


def distances_to_own(p, near):
    """From each point to its nearest triangle, by the regions of each (Ericson 2005, 5.1.5)."""
    a, b, c = near[..., 0, :], near[..., 1, :], near[..., 2, :]
    best = np.full(a.shape[:2], np.inf)
    for q, r in ((a, b), (b, c), (c, a)):
        side = r - q
        length2 = np.maximum((side * side).sum(axis=-1), 1e-300)
        t = np.clip(((p - q) * side).sum(axis=-1) / length2, 0, 1)
        best = np.minimum(best, np.linalg.norm(p - q - t[..., None] * side, axis=-1))
    ab, ac, ap = b - a, c - a, p - a
    normal = np.cross(ab, ac)
    area2 = np.maximum((normal * normal).sum(axis=-1), 1e-300)
    v = (np.cross(ap, ac) * normal).sum(axis=-1) / area2
    w = (np.cross(ab, ap) * normal).sum(axis=-1) / area2
    height = np.abs((ap * normal).sum(axis=-1)) / np.sqrt(area2)
    over = (v >= 0) & (w >= 0) & (v + w <= 1)
    return np.where(over, np.minimum(best, height), best).min(axis=1)


def longest_side(quads):
    return np.linalg.norm(np.roll(quads, -1, axis=1) - quads, axis=2).max()


def quads_from_face(face, quads):
    """Largest and mean distance from the quads to the face."""
    sides = (quads + np.roll(quads, -1, axis=1)) / 2
    points = np.vstack([quads.reshape(-1, 3), sides.reshape(-1, 3), quads.mean(axis=1)])
    found = face.distances(np.unique(points, axis=0))
    return found.max(), found.mean()


def face_from_quads(face, quads):
    """Largest distance from the face to the quads."""
    centre = quads.mean(axis=1)
    corners = np.roll(quads, -1, axis=1)
    triangles = np.stack([quads, corners, np.broadcast_to(centre[:, None], quads.shape)], axis=2).reshape(-1, 3, 3)
    return distances_to_triangles(face.points, triangles).max()


def tags_of(groups, case):
    """Tags of the CAD faces a patch may stand for; none for void faces."""
    for group in groups:
        if re.fullmatch(r"wall:\d+", group):
            return [int(group[5:])]
        if group in ("source", "target") and case[group] and not any(g.startswith("void") for g in groups):
            return case[group]
    return []


def judge(case, mesh, reported):
    """Rows of one case and what is wrong with it."""
    rows, wrong, met = [], [], []
    for groups, quads in read_skin(mesh):
        tags = tags_of(groups, case)
        if not tags:
            continue
        gmsh.model.setCurrent("cad")
        near = {}
        for tag in tags:
            out, mean = quads_from_face(FACES[tag], quads)
            near[tag] = max(out, face_from_quads(FACES[tag], quads)), mean
        tag = min(near, key=lambda t: near[t][0])
        face, (most, mean) = FACES[tag], near[tag]
        side, slack = longest_side(quads), ROUNDING * face.extent
        said = reported.get(str(tag))
        if tag in met:
            wrong.append(f"two patches lie on face {tag}")
        met.append(tag)
        rows.append((tag, len(quads), most, mean, said))
        if most > SHARE_OF_SIDE * side + slack:
            wrong.append(f"face {tag} is {most:.3g} off its quads, whose sides are up to {side:.3g} long")
        if said is None:
            wrong.append(f"nothing is reported of face {tag}")
        elif said < LESS * most - slack:
            wrong.append(f"face {tag} is {most:.6g} off its quads, and {said:.6g} is reported")
        elif said > MORE * most + slack:
            wrong.append(f"face {tag} is {most:.6g} off its quads, and as much as {said:.6g} is reported")
        # A node moved off its face has to be found.
        moved = quads.copy()
        normal = np.cross(moved[0, 2] - moved[0, 0], moved[0, 3] - moved[0, 1])
        moved[0, 0] += 0.5 * side * normal / np.linalg.norm(normal)
        if quads_from_face(face, moved)[0] <= SHARE_OF_SIDE * side + slack:
            wrong.append(f"face {tag}: a node moved by half a side is not found")
    if not rows:
        wrong.append("no quad lies on a CAD face")
    return rows, wrong


def open_cad(path):
    """The file as the model "cad"."""
    gmsh.clear()
    gmsh.model.add("cad")
    gmsh.merge(str(path))
    FACES.clear()


def main():
    lacuna, data = sys.argv[1], pathlib.Path(sys.argv[2])
    only = sys.argv[4] if len(sys.argv) > 4 and sys.argv[3] == "--only" else ""
    if not (data / "cases.json").exists():
        print(f"left out: there is no {data / 'cases.json'}")
        return 77
    cases = [c for c in json.loads((data / "cases.json").read_text())["cad"]
             if not c.get("refuse") and re.search(only, c["file"] + " " + c["case"])]
    if not only and not os.environ.get("LACUNA_WHOLE_FAMILIES"):
        cases = list({c["file"]: c for c in cases}.values())
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    failed = faces = 0
    with tempfile.TemporaryDirectory() as folder:
        for case in cases:
            name = f"{pathlib.Path(case['file']).stem} {case['case']}"
            try:
                mesh, reported = sweep(lacuna, case, data, pathlib.Path(folder))
                open_cad(data / case["file"])
                given = sorted(map(int, case["kept"]))
                mesh_faces(given, size_of(case))
                rows, wrong = judge(case, mesh, reported)
            except (RuntimeError, subprocess.TimeoutExpired) as error:
                rows, wrong = [], [str(error)]
            faces += len(rows)
            failed += bool(wrong)
            most = max((row[2] for row in rows), default=0)
            print(f"{'FAIL' if wrong else 'ok  '} {name}: {len(rows)} faces, off by {most:.3g} at most", flush=True)
            for tag, quads, most, mean, said in rows:
                print(f"       face {tag}: {quads} quads, found {most:.4g} at most, {mean:.3g} on average; "
                      f"reported {said if said is None else format(said, '.4g')}")
            for what in wrong:
                print("       " + what)
    print(f"{len(cases) - failed} of {len(cases)} cases pass, {faces} faces")
    return 1 if failed else 0


def mesh_faces(tags, size):
    """Mesh the faces of a case and no others, and keep what is compared."""
    extent = max(math.dist(box[:3], box[3:]) for box in (gmsh.model.getBoundingBox(2, tag) for tag in tags))
    gmsh.option.setNumber("Mesh.MeshSizeMax", max(size / 2, extent / 60))
    gmsh.model.setVisibility(gmsh.model.getEntities(), 0)
    gmsh.model.setVisibility([(2, tag) for tag in tags], 1, recursive=True)
    gmsh.option.setNumber("Mesh.MeshOnlyVisible", 1)
    gmsh.model.mesh.generate(2)
    for tag in tags:
        FACES[tag] = CadFace(tag)


FACES = {}  # of the CAD model at hand, by their tags

try:
    import gmsh
    import numpy as np
except ImportError as missing:
    print(f"left out: {missing}")
    sys.exit(77)

if __name__ == "__main__":
    sys.exit(main())
