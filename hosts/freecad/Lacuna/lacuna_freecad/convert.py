# SPDX-License-Identifier: MIT
"""Between FreeCAD's objects and the files of a job."""
import hashlib
import json
import re

import Fem
import Part

ROLES = "Faces", "Source", "Target", "Walls"


def face_numbers(link):
    """The numbers of the faces of a link to sub-elements."""
    return [int(name[4:]) for name in (link[1] if link else ()) if re.fullmatch(r"Face\d+", name)]


def face_names(numbers):
    return [f"Face{number}" for number in numbers]


def request_for(action, shape, roles, close=None, sweep=None, solid=False):
    """The data of request.json. `roles`, `close` and `sweep` are Lacuna's options, with FreeCAD's numbers."""
    faces = [{"area": face.Area, "centre": list(face.CenterOfMass)} for face in shape.Faces]
    return {"action": action, "faces": faces, "roles": roles, "close": close or {}, "sweep": sweep or {},
            "solid": solid}


def fingerprint(shape, request):
    """The same for the same part and request."""
    text = shape.exportBrepToString() + json.dumps(request, sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()


def read_mesh(path, names=None):
    """A FEM mesh of a UNV file; `names` are names of its groups and what they are to be called.

    UNV has no pyramids: they are bricks whose upper nodes are one, which CalculiX solves, while FreeCAD leaves its own pyramids out of CalculiX's input.
    """
    mesh = Fem.read(path)
    for group in mesh.Groups:
        name = mesh.getGroupName(group)
        new_name = (names or {}).get(name, name)
        if new_name != name:
            kind, elements = mesh.getGroupElementType(group), mesh.getGroupElements(group)
            mesh.removeGroup(group)
            mesh.addGroupElements(mesh.addGroup(new_name, kind), list(elements))
    return mesh


def read_shape(path):
    shape = Part.Shape()
    shape.read(path)
    return shape


def free_edges(shape, numbers):
    """Edges that one of these faces has alone; of all faces where no number is given."""
    faces = [shape.Faces[number - 1] for number in numbers] if numbers else shape.Faces
    count, edges = {}, {}
    for face in faces:
        for edge in face.Edges:  # a seam is in it once
            edges[edge.hashCode()] = edge
            count[edge.hashCode()] = count.get(edge.hashCode(), 0) + 1
    return [edges[code] for code in count if count[code] == 1 and not is_seam(edges[code], faces)]


def is_seam(edge, faces):
    return any(edge.isSeam(face) for face in faces if any(edge.isSame(other) for other in face.Edges))
