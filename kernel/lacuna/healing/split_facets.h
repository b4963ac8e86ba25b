// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/model.h>

#include <string>
#include <vector>

namespace lacuna::healing {

/// Options of `split_facets()`.
struct SplitOptions {
    double feature_angle = 40; ///< facets that meet at a sharper turn belong to two faces [degrees]
    double tolerance = 0;      ///< points closer than this are one [model length]; 0: 1e-6 × the diagonal
    bool whole_labels =
        false; ///< a label's facets stay one face however they turn; the angle is for vertices alone
};

/// Facets as a file holds them.
struct FacetSoup {
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
    std::vector<Quad> quads;         ///< given quads, kept; each also counts as two facets
    std::vector<int> triangle_label; ///< part each belongs to (element set, STL solid); empty: all 0
    std::vector<int> quad_label;
    std::vector<std::string> label_name; ///< name of each label; may be shorter than the labels used
    /// Whether each label's triangles are a mesh whose nodes stay, too; may be shorter than the labels used.
    /// Quads always are.
    std::vector<char> label_keeps_nodes;
};

/// Cut facets into faces: by label first, then wherever they turn by more than the feature angle. Edges are
/// the chains between two faces or along a border; vertices are where three faces meet, where a border
/// turns by more than the feature angle, or, on a closed chain that has none, its first point. Tags count
/// from 1 in the order faces are met, each kind of entity by itself. First, facets are cut at points on the
/// inside of their free sides (T-junctions), and of facets listed twice in a label one stays, with a note.
/// @throw InvalidInput  no facets; an edge of three or more facets inside one label; a diagonal whose fourth
///                      power is no number. Cancelled.
topology::Model split_facets(const FacetSoup& soup, const SplitOptions& options = {},
                             const RunContext& context = {});

} // namespace lacuna::healing
