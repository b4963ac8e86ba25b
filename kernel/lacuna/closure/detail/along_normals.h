// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/shared/along.h>
#include <lacuna/core/run_context.h>
#include <lacuna/geometry/shared/motion.h>
#include <lacuna/topology/open_volume.h>

namespace lacuna::closure {

/// Unit vector of a direction.
/// @param name  the option that gives the direction.
/// @throw InvalidInput "closure.along_direction"  the direction has no length.
Vec3 unit(const Vec3& direction, const char* name);

/// The motion along the normals of a source. If the thickness lies on both sides, the source is moved to the
/// inner side first.
geometry::Motion motion_along_normals(topology::OpenVolume& source, const Along::Normals& normals,
                                      const RunContext& context);

/// The motion of a source up to another face. Facets of the source are split where their images would deviate
/// visibly from that face.
geometry::Motion motion_to_face(topology::OpenVolume& source, const Along::ToFace& to,
                                const RunContext& context);

} // namespace lacuna::closure
