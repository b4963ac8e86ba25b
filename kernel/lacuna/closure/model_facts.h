// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/cavities.h>
#include <lacuna/core/run_context.h>
#include <lacuna/topology/cone_shape.h>
#include <lacuna/topology/face_facts.h>
#include <lacuna/topology/face_radius.h>
#include <lacuna/topology/gaps.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace lacuna::closure {

/// What helps to choose faces of a model: read by `model:info()` and the page of a model alike.
struct ModelFacts {
    std::vector<topology::FaceFacts> faces;                 ///< of each face
    std::vector<std::optional<topology::RoundShape>> round; ///< of each face
    std::vector<std::optional<topology::ConeShape>> cone;   ///< of each face that is not round
    std::vector<bool> part_closed; ///< of each part that hangs together: no free edge
    std::vector<topology::Gap> gaps;
    std::vector<Cavity> cavities;
    std::vector<std::size_t> cavity_of; ///< of each face the smallest cavity, from 0; their count: none
};

/// @throw Cancelled
/// @note  As `cavities()` and `topology::gaps()`.
ModelFacts model_facts(const topology::Model& model, const RunContext& context = {});

/// What a face would be part of: the kind of its cavity, "outer skin" or "open shell". Lives with `facts`.
const char* use_of(const ModelFacts& facts, FaceId face);

} // namespace lacuna::closure
