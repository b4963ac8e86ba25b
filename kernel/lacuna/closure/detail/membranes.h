// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

#include <vector>

namespace lacuna::closure {

/// Those of some void faces that span a rim which lies in no plane as a membrane does: the rim leaves open
/// how their inside bends. Not those between four sides, which lead from side to side, and not those that lie
/// on a quadric that their rim tells, or on one quadratic height over their plane, as the mouth of a keyway
/// does on its shaft.
std::vector<FaceId> membranes(const topology::Model& model, const std::vector<FaceId>& void_faces);
bool is_membrane(const topology::Model& model, FaceId face);

/// Whether a face over its rim's plane lies on no quadratic height, be it bent ever so little.
bool bends_off_quadratic(const topology::Model& model, FaceId face);

/// Whether a face's rim lies on one quadric, or on a ball, a round cylinder, a cone or two planes among many,
/// and its inside near it: then the rim tells how the face bends.
bool bends_as_rim(const topology::Model& model, FaceId face);

/// Whether no point of a face is further off its plane than a small share of its extent.
bool is_about_flat(const topology::Model& model, FaceId face);

} // namespace lacuna::closure
