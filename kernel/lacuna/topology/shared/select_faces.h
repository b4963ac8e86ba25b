// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace lacuna::topology {

/// Conditions that select faces; all that are set must hold.
struct FaceSelector {
    std::optional<std::vector<int>> tags; ///< of given faces; of void faces where no given face has the tag
    std::string name, kind, region;
    std::optional<Vec3> facing, near; ///< `facing` of length 1
    double normal_within = 30;        ///< of `facing` [degrees]
    /// If set, all faces within this distance of `near` are selected, not only the closest [model length].
    std::optional<double> within;
    std::array<double, 2> area{0, std::numeric_limits<double>::infinity()};
    std::optional<std::array<double, 2>> radius;
    std::optional<Eigen::AlignedBox3d> box;
    std::optional<bool> free;
    /// The selected faces share an edge with this face, given by its id in a model, its tag or a name.
    const Model* touching_model = nullptr;
    FaceId touching;
    std::optional<int> touching_tag;
    std::string touching_name;
};

/// The selected faces, in the model's order. A tag of a face that the file lists twice selects the face that
/// was kept.
/// @throw InvalidInput "lua.other_model", "lua.no_face"  `touching` names no face of the model.
std::vector<FaceId> select(const Model& model, FaceSelector selector);

/// Whether a face or one of its groups has a name.
bool is_called(const Face& face, const std::string& name);

/// Unit mean normal of the facets; zero if they cancel, as around a whole tube.
Vec3 mean_normal(const Model& model, FaceId face);

} // namespace lacuna::topology
