// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/model.h>

#include <string>
#include <vector>

namespace lacuna::healing {

/// Options of `split_facets()`.
struct SplitOptions {
    double feature_angle = 40; ///< faces end where facets turn by more than this [degrees]
    double tolerance = 0;      ///< points closer than this are merged [model length]; 0: 1e-6 × the diagonal
    bool whole_labels =
        false; ///< each label becomes one face at any angle; only vertices depend on `feature_angle`
    bool keep_noise = false; ///< leave the points of noisy facets where they are
};

/// Facets as read from a file.
struct FacetSoup {
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
    std::vector<Quad> quads;         ///< given quads, kept in the mesh; each also counts as two facets
    std::vector<int> triangle_label; ///< part of each triangle (element set, STL solid); empty: all 0
    std::vector<int> quad_label;
    std::vector<std::string> label_name; ///< name of each label; may be shorter than the labels used
    /// Whether the triangles of each label are a mesh whose nodes must be kept; may be shorter than the
    /// labels used. Nodes of quads are always kept.
    std::vector<char> label_keeps_nodes;
};

/// Split facets into faces: by label, then wherever they turn by more than the feature angle. Edges are the
/// chains of sides between two faces or along a border. Vertices are where three faces meet and where a
/// border turns by more than the feature angle; a closed chain without a vertex gets one at its first point.
/// Tags count from 1 for each kind of entity, in the order of the facets.
///
/// T-junctions on free sides are cut first. If a label lists a facet twice, one copy is kept, with a note.
/// The facets of a noisy surface, such as a scan, are separated by the normals of patches and then smoothed
/// within faces and along edges, with a note. Nodes that must be kept do not move.
/// @throw InvalidInput  there are no facets; a face is one-sided; an option is out of range; the model is so
///         large or small that the fourth power of its diagonal cannot be represented.
/// @throw Cancelled
topology::Model split_facets(const FacetSoup& soup, const SplitOptions& options = {},
                             const RunContext& context = {});

} // namespace lacuna::healing
