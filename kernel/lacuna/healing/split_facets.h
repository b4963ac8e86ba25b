// SPDX-License-Identifier: MIT
#pragma once

// In: facets as read from a file, or a model whose faces do not share edges; out: a model whose faces share
// edges.
//
// Where to change things:
//   steps of split_facets()           split_facets.cpp
//   checks and repairs of the facets  soup_facets.cpp, weld.cpp, t_junctions.cpp
//   normals, by which faces end       facet_normals.cpp
//   points of noisy scans             smooth_noise.cpp
//   junctions of tubes                divide_arms.cpp
//   growing one face from a point     grow_face.cpp
//   steps of stitch()                 stitch.cpp, stitch_edges.cpp; changes to the model: loose_model.cpp
//   distance to an edge               edge_track.cpp
//   thin and repeated faces           surplus_faces.cpp, coincident_faces.cpp
//   orientation of faces              orient_groups.cpp
//   faces that a recipe makes         added_faces.cpp

#include <lacuna/core/run_context.h>
#include <lacuna/topology/model.h>

#include <string>
#include <vector>

namespace lacuna::healing {

/// Options of `split_facets()`.
struct SplitOptions {
    double feature_angle = 40; ///< faces end at sides where adjacent facets turn by more than this [degrees]
    double tolerance = 0; ///< points closer than this are merged [model length]; 0: 1e-6 × the diagonal,
                          ///< or `FacetSoup::least_tolerance` if that is larger
    bool whole_labels =
        false; ///< whether a label stays one face at any angle; then only vertices depend on `feature_angle`
    bool keep_noise = false; ///< whether the points of noisy facets stay where they are
};

/// Facets as read from a file.
struct FacetSoup {
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
    std::vector<Quad> quads;         ///< given quads; each also counts as two facets
    std::vector<int> triangle_label; ///< number of the part that contains each triangle, such as an element
                                     ///< set or an STL solid; empty: all 0
    std::vector<int> quad_label;
    std::vector<std::string> label_name; ///< name of each label; labels beyond the end of the list have no
                                         ///< name
    /// By label: whether its facets are a mesh whose nodes must be kept. For labels beyond the end of the
    /// list, those of quads are.
    std::vector<char> label_keeps_nodes;
    double least_tolerance = 0; ///< the default tolerance is at least this [model length]
};

/// Split facets into faces: by label, then at sides where adjacent facets turn by more than the feature
/// angle. An edge is a chain of facet sides between two faces or along the border of one face. A vertex is a
/// point where three faces meet, or where such a chain turns by more than the feature angle; a closed chain
/// without a vertex gets one at its first point. Tags count from 1 for each kind of entity, in the order of
/// the facets.
///
/// Facets are first cut at T-junctions of free sides. If a label lists a facet twice, one copy is kept, with
/// a note. On a noisy surface, such as a scan, faces are separated by the mean normals of patches
/// (`patch_normals()`), and points are then smoothed within faces and along edges, with a note. Nodes that
/// must be kept do not move.
/// @throw InvalidInput  there are no facets; a face is one-sided like a Möbius band; an option is out of
///         range; the coordinates are so large or small that squared areas overflow or underflow.
/// @throw Cancelled
topology::Model split_facets(const FacetSoup& soup, const SplitOptions& options = {},
                             const RunContext& context = {});

} // namespace lacuna::healing
