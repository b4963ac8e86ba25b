// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/shared/cavities.h>
#include <lacuna/core/run_context.h>
#include <lacuna/topology/shared/cone_shape.h>
#include <lacuna/topology/shared/face_facts.h>
#include <lacuna/topology/shared/face_radius.h>
#include <lacuna/topology/shared/gaps.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace lacuna::closure {

/// Facts for choosing faces of a model, shared by `model:info()` and the HTML page of a model.
struct ModelFacts {
    std::vector<topology::FaceFacts> faces;                 ///< for each face
    std::vector<std::optional<topology::RoundShape>> round; ///< for each face
    std::vector<std::optional<topology::ConeShape>> cone;   ///< for each face: empty for cylinders and
                                                            ///< spheres
    std::vector<bool> part_closed;                          ///< by connected part: whether the part has no
                                                            ///< free edge
    std::vector<topology::Gap> gaps;
    std::vector<Cavity> cavities;
    std::vector<std::size_t> cavity_of; ///< by face: index of the smallest cavity that it belongs to;
                                        ///< cavities.size() if there is none
};

/// @throw Cancelled
/// @note  Cost: that of `cavities()` and `topology::gaps()`.
ModelFacts model_facts(const topology::Model& model, const RunContext& context = {});

/// The place of a face: the kind of its cavity, "outer skin" or "open shell". The text is valid as long as
/// `facts` exists.
const char* use_of(const ModelFacts& facts, FaceId face);

} // namespace lacuna::closure
