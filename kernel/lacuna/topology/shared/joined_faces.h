// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/geometry/shared/union_find.h>
#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::topology {

/// Join faces that share edges, which are dropped.
/// @param parts  for each face of the result, its parts; every face of the model is listed once. The joined
///               face has the tag, the name and the groups of the first part. Each part keeps its exact
///               surface if all have one.
/// @note  O(facets).
Model join_faces(const Model& model, const std::vector<std::vector<FaceId>>& parts,
                 const RunContext& context = {});

/// Join faces of a volume, as above.
/// @param joined  sets of faces of the same role
void join_faces(OpenVolume& volume, geometry::UnionFind joined, const RunContext& context = {});

/// Whether neither a name nor a group or region of the input distinguishes two faces.
bool are_named_alike(const Face& a, const Face& b);

/// Which faces continue each other: parts of one plane, cylinder, cone or sphere, or bent faces that meet
/// without a crease.
enum class Continued { on_one_shape, smoothly };

/// The faces of a model, each with the faces that continue it on the same plane, cylinder, cone or sphere,
/// such as the narrow faces of a shell's cylinder that a CAD system leaves round the mouth of a nozzle; the
/// largest part first. A face continues another one if both have exact surfaces, the same kind, name, groups
/// and regions, and the corners of its facets lie on the shape that is fitted to the larger one, within the
/// tolerance. With `Continued::smoothly`, kind and shape of faces that are not flat may differ: a cell then
/// lies across their edge.
/// @param apart  for each face, its class: faces of different classes stay apart. Faces that were given as a
///               mesh, and void faces, stay apart as well.
/// @note  O(facets log facets).
std::vector<std::vector<FaceId>> continued_faces(const Model& model, const std::vector<int>& apart,
                                                 Continued how, const RunContext& context = {});

} // namespace lacuna::topology
