// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/seeds.h>

#include <map>
#include <set>
#include <span>
#include <vector>

/// Inputs of interval assignment. Internal to this folder.
namespace lacuna::surface {

/// The source, and the requests that apply to the whole source; see `seed_source()`.
struct SeedTask {
    SeedTask(const topology::OpenVolume& volume, std::span<const LinkingSurface> links, const SizeField& size,
             QuadStyle style, const ShapeSizing& sizing, bool wedges);

    const topology::OpenVolume& volume;
    const topology::Model& model;
    const SizeField& size;
    QuadStyle style;
    ShapeSizing sizing;
    bool wedges;
    std::vector<FaceId> faces; ///< faces of the source
    /// For each edge of these faces or of the rim, the source faces that have it.
    std::map<EdgeId, std::set<FaceId>> users;
    std::set<EdgeId> rim; ///< edges with walls
};

/// The edges of a face, in the order of its loops; a seam occurs twice.
std::vector<EdgeId> edges_of(const topology::Model& model, FaceId face);

/// Total number of sides on some edges.
int total(const Seeds& seeds, const std::vector<EdgeId>& edges);

/// Number of sides on the loops of a face.
int sides_of(const topology::Model& model, const Seeds& seeds, FaceId face);

/// Sum of the wanted numbers of sides of some edges.
double sides_asked(const Seeds& seeds, const std::vector<EdgeId>& edges);

/// Number of quads that the wanted sides around a face imply.
double quads_asked(const topology::Model& model, const Seeds& seeds, FaceId face);

/// Whether all pieces of an edge are fixed.
bool is_fixed(const Seeds& seeds, EdgeId edge);

/// Add `by` sides, one at a time, each on the edge that has the longest sides. @return  false if all edges
/// are fixed
bool raise(Seeds& seeds, const std::vector<EdgeId>& edges, int by);

} // namespace lacuna::surface
