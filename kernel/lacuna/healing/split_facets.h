// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/model.h>

#include <string>
#include <vector>

namespace lacuna::healing {

/// Options of `split_facets()`.
struct SplitOptions {
    double feature_angle = 40; ///< facets at a sharper dihedral turn are split into two faces [degrees]
    double tolerance = 0;      ///< points closer than this are merged [model length]; 0: 1e-6 × the diagonal
    bool whole_labels =
        false; ///< keep each label one face at any angle; `feature_angle` then only places vertices
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
/// chains between two faces or along a border. Vertices are where three faces meet and where a border turns
/// by more than the feature angle; a closed chain without a vertex gets one at its first point. Tags count
/// from 1 by kind of entity, in the order of the facets. T-junctions on free sides are cut first; of facets
/// listed twice in a label one is kept, with a note. Facets of a noisy surface, as of a scan, are told apart
/// by normals over patches, and then smoothed within faces and along edges, with a note; nodes that are kept
/// do not move.
/// @throw InvalidInput  no facets; an edge with three or more facets of one label; a model so large or small
///         that the fourth power of its diagonal is no double. Cancelled.
topology::Model split_facets(const FacetSoup& soup, const SplitOptions& options = {},
                             const RunContext& context = {});

} // namespace lacuna::healing
