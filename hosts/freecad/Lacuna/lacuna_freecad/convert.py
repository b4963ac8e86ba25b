# SPDX-License-Identifier: MIT
"""Between FreeCAD's objects and the files of a job."""
import hashlib
import json
import re

import Fem
import Part

kProjected = 500  # nodes of a group that are projected, about: a choice, tens of milliseconds
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

    UNV has no pyramids: they are bricks whose upper nodes are one, which CalculiX solves.
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


def with_pyramids(mesh):
    """A copy in which bricks whose upper nodes are one are pyramids. FreeCAD leaves these out of CalculiX's input."""
    made = Fem.FemMesh()
    for number, point in mesh.Nodes.items():
        made.addNode(*point, number)
    for number in mesh.Faces:
        made.addFace(list(mesh.getElementNodes(number)), number)
    for number in mesh.Volumes:
        nodes = list(mesh.getElementNodes(number))
        is_pyramid = len(nodes) == 8 and len(set(nodes[4:])) == 1
        made.addVolume(nodes[:5] if is_pyramid else nodes, number)
    for group in mesh.Groups:
        made.addGroupElements(made.addGroup(mesh.getGroupName(group), mesh.getGroupElementType(group)),
                              list(mesh.getGroupElements(group)))
    return made


def read_shape(path):
    shape = Part.Shape()
    shape.read(path)
    return shape


def groups_of_faces(mesh):
    """Names of the groups of quads and triangles, with their nodes."""
    return {mesh.getGroupName(group): {node for element in mesh.getGroupElements(group)
                                       for node in mesh.getElementNodes(element)}
            for group in mesh.Groups if mesh.getGroupElementType(group) == "Face"}


def widen_fitted_faces(solid, mesh):
    """Give faces of a sealed solid that were fitted to a missing face a tolerance that reaches the mesh's nodes.

    FreeCAD takes the nodes of a constraint by their distance from its face, within the face's tolerance. Nodes
    lie on given faces, but between the facets of a missing one, to which its surface in the solid is fitted.
    """
    for name, nodes in groups_of_faces(mesh).items():
        if not name.startswith("void:"):
            continue
        found = [set(mesh.getNodesByFace(face)) for face in solid.Faces]
        if nodes <= set().union(*(some for some in found if some <= nodes)):
            continue
        points = [mesh.getNodeById(node) for node in sorted(nodes)[::1 + len(nodes) // kProjected]]

        def distance(face):
            return max(point.distanceToPoint(face.Surface.projectPoint(point)) for point in points)
        others = [face for face, some in zip(solid.Faces, found) if not some - nodes]  # none of other groups
        if others:
            face = min(others, key=distance)
            face.fixTolerance(2 * distance(face), Part.Face)  # twice: not every node was projected


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
