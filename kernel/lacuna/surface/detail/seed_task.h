// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/seeds.h>

#include <map>
#include <set>
#include <span>
#include <vector>

/// What numbers of sides are chosen by. Internal to this folder.
namespace lacuna::surface {

/// The source and what is asked of all of it; as for `seed_source()`.
struct SeedTask {
    SeedTask(const topology::OpenVolume& volume, std::span<const LinkingSurface> links, const SizeField& size,
             QuadStyle style, const ShapeSizing& sizing, bool wedges);

    const topology::OpenVolume& volume;
    const topology::Model& model;
    const SizeField& size;
    QuadStyle style;
    ShapeSizing sizing;
    bool wedges;
    std::vector<FaceId> faces;                ///< of the source
    std::map<EdgeId, std::set<FaceId>> users; ///< those of each edge of theirs or of the rim
    std::set<EdgeId> rim;                     ///< edges that walls stand on
};

/// The edges of a face, in the order of its loops; one that has the face on both sides twice.
std::vector<EdgeId> edges_of(const topology::Model& model, FaceId face);

/// Sides on some edges together.
int total(const Seeds& seeds, const std::vector<EdgeId>& edges);

/// Sides on the loops of a face.
int sides_of(const topology::Model& model, const Seeds& seeds, FaceId face);

/// Quads that the sides wanted round a face ask for.
double quads_asked(const topology::Model& model, const Seeds& seeds, FaceId face);

/// Whether an edge has no piece whose number of sides may change.
bool is_fixed(const Seeds& seeds, EdgeId edge);

/// More sides, one at a time, where the sides are longest. @return false where all are fixed
bool raise(Seeds& seeds, const std::vector<EdgeId>& edges, int by);

} // namespace lacuna::surface
