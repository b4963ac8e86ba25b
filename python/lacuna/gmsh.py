# SPDX-License-Identifier: MIT
"""Hexahedra for a model of Gmsh.

    lacuna.gmsh.fill(source=1, target=2, walls=[3, 4, 5, 6], layers=8)

takes meshed surfaces of Gmsh's current model and adds a discrete volume of hexahedra with physical groups.

    python3 -m lacuna.gmsh model.geo [out.msh] [source=1 target=2 walls=3,4,5,6] [layers=8 size=0.5 ...]

does so with a file. Needs Gmsh's module for Python (python3-gmsh), which is under the GPL.
"""
from __future__ import annotations

import operator
import os
import sys
import tempfile

from . import _api
from ._library import Error
from ._objects import _module
from ._wire import plain

_CORNERS = {2: 3, 3: 4, 9: 3, 10: 4, 16: 4}  # of Gmsh's types of triangles and quads
_ROLES = "source", "target", "walls", "faces"


def fill(*, source=None, target=None, walls=None, faces=None, name="volume", keep_mesh=True, **options):
    """Fill the volume that meshed surfaces of Gmsh's current model bound, and add it as a discrete volume.

    source, target, walls: tags of surfaces, or lists of tags; walls="auto": all others that are connected to
        the source
    faces: instead of roles: tags of the surfaces, whose roles are found; without any of these, all surfaces
    name: of the volume's physical group
    keep_mesh: tags of the surfaces whose quads stay as they are, with their nodes; True: all; False: none
    options: of Volume.sweep

    Returns the tag of the new volume. Its skin is discrete surfaces in the groups `source`, `target`,
    `wall:<surface>`, `face:<surface>` of an end, and `void:<n>`. Nodes of quads that stay are those of the surfaces.
    """
    gmsh = _module("gmsh", "python3-gmsh")
    roles = {role: _tags(role, tags) for role, tags in zip(_ROLES, (source, target, walls, faces))
             if tags is not None}
    if not isinstance(plain(keep_mesh), bool):
        keep_mesh = _tags("keep_mesh", keep_mesh)
    model, face_of, nodes = _model_of(gmsh, _surfaces(gmsh, roles), keep_mesh)

    void = model.open_volume(name=name, **{
        role: tags if tags == "auto" else [face_of[tag] for tag in tags] for role, tags in roles.items()})
    mesh = void.sweep(**options)
    surface_of = {face.tag: tag for tag, face in face_of.items()}
    return _add(gmsh, mesh, nodes, surface_of)


def _tags(role, tags):
    """A list of tags of surfaces, of numbers of any kind; or "auto"."""
    if role == "walls" and isinstance(tags, str) and tags == "auto":
        return tags
    try:
        return [operator.index(tags)]
    except TypeError:
        pass
    try:
        return [operator.index(tag) for tag in tags]
    except TypeError:
        raise TypeError(f"{role} takes tags of Gmsh's surfaces, found {tags!r}") from None


def _surfaces(gmsh, roles):
    """Tags of the surfaces that are taken: those named, and all with "auto" or without roles."""
    if not roles or "auto" in roles.values():
        return [tag for _, tag in gmsh.model.getEntities(2)]
    return sorted({tag for tags in roles.values() for tag in tags})


def _model_of(gmsh, surfaces, keep_mesh):
    """A Model of the surfaces' meshes, its Face by surface, and the tag of each node by place."""
    model, face_of, nodes = _api.model(), {}, {}
    for surface in surfaces:
        tags, places, _ = gmsh.model.mesh.getNodes(2, surface, includeBoundary=True)
        number, points = {}, []
        for i, tag in enumerate(tags):
            place = tuple(places[3 * i:3 * i + 3])
            nodes.setdefault(place, int(tag))
            if tag not in number:  # those of seams come twice
                points.append(place)
                number[tag] = len(points)
        cells = []
        for kind, _, corners in zip(*gmsh.model.mesh.getElements(2, surface)):
            size = gmsh.model.mesh.getElementProperties(kind)[3]
            cells += [[number[tag] for tag in corners[at:at + _CORNERS[kind]]]
                      for at in range(0, len(corners), size)]
        if not cells:
            remedy = "mesh the surfaces first: gmsh.model.mesh.generate(2)"
            raise Error(f"surface {surface} has no mesh; {remedy}", "gmsh.no_mesh", remedy=remedy)
        keep = surface in keep_mesh if isinstance(keep_mesh, list) else bool(keep_mesh)
        face_of[surface] = model.add_face(points, cells, name=gmsh.model.getEntityName(2, surface) or None,
                                          keep_mesh=keep and all(len(cell) == 4 for cell in cells))
    return model, face_of, nodes


def _add(gmsh, mesh, nodes, surface_of):
    """Add a mesh to the current model. Gmsh first reads it into a model of its own, as it comes with groups.
    """
    here = gmsh.model.getCurrent()
    parts, places = [], {}
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "mesh.msh")
        mesh._write_bare(path)
        gmsh.model.add("lacuna")
        try:
            gmsh.merge(path)
            for dim, tag in gmsh.model.getEntities():
                groups = [gmsh.model.getPhysicalName(dim, group)
                          for group in gmsh.model.getPhysicalGroupsForEntity(dim, tag)]
                owned = gmsh.model.mesh.getNodes(dim, tag)
                places.update(zip(owned[0], owned[1].reshape(-1, 3)))
                if dim > 1:
                    parts.append((dim, groups, owned[0], gmsh.model.mesh.getElements(dim, tag)))
        finally:
            gmsh.model.remove()
            gmsh.model.setCurrent(here)

    highest = int(max(gmsh.model.mesh.getNodes()[0], default=0))
    renamed, added = {}, []
    for tag in sorted(places):
        kept = nodes.get(tuple(places[tag]))
        if kept is None:
            highest += 1
            added.append(tag)
        renamed[tag] = kept or highest
    volume, groups_of = None, {}
    element = int(max((max(tags) for tags in gmsh.model.mesh.getElements()[1]), default=0))
    for dim, groups, _, (kinds, tags, corners) in sorted(parts, key=lambda part: -part[0]):
        entity = gmsh.model.addDiscreteEntity(dim)
        if dim == 3:
            if volume is None:
                gmsh.model.mesh.addNodes(3, entity, [renamed[tag] for tag in added],
                                         [x for tag in added for x in places[tag]])
            volume = volume or entity
        for kind, of_kind, ends in zip(kinds, tags, corners):
            numbers = range(element + 1, element + 1 + len(of_kind))
            element += len(of_kind)
            gmsh.model.mesh.addElementsByType(entity, kind, list(numbers), [renamed[tag] for tag in ends])
        for group in groups:
            kind, _, tag = group.partition(":")
            if kind in ("wall", "face") and tag.isdigit():
                group = f"{kind}:{surface_of[int(tag)]}"
            groups_of.setdefault((dim, group), []).append(entity)
    for (dim, group), entities in groups_of.items():
        made = gmsh.model.addPhysicalGroup(dim, entities)
        gmsh.model.setPhysicalName(dim, made, group)
    return volume


def _value(text):
    """Of a word key=value: a number, a list of them, true or false, or a text."""
    if "," in text:
        return [_value(part) for part in text.split(",") if part]
    if text.lower() in ("true", "false"):
        return text.lower() == "true"
    for read in int, float:
        try:
            return read(text)
        except ValueError:
            pass
    return text


def main(words):
    """The command: python3 -m lacuna.gmsh model.geo [out.msh] [key=value ...]"""
    files = [word for word in words if "=" not in word]
    if not 1 <= len(files) <= 2 or words[0].startswith("-"):
        print(__doc__)
        return 2
    out = files[1] if len(files) == 2 else os.path.splitext(files[0])[0] + ".msh"
    if os.path.abspath(out) == os.path.abspath(files[0]):
        out = os.path.splitext(out)[0] + "_filled.msh"
    if not os.path.exists(files[0]):
        print(f"lacuna: {files[0]} is not there", file=sys.stderr)
        return 1
    gmsh = _module("gmsh", "python3-gmsh")
    gmsh.initialize()
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.open(files[0])
        if not len(gmsh.model.mesh.getElements(2)[0]):
            gmsh.model.mesh.generate(2)
        fill(**{key: _value(text) for key, _, text in (word.partition("=") for word in words if "=" in word)})
        gmsh.write(out)
    except (Error, TypeError) as error:
        print(f"lacuna: {error}", file=sys.stderr)
        return 1
    finally:
        gmsh.finalize()
    print(out)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
