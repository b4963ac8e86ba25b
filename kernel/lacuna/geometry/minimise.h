// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <functional>

namespace lacuna::geometry {

struct MinimiseOptions {
    int iterations = 60;
    double least_gain = 1e-7;     ///< stop when a step wins less of the value than this [-]
    std::size_t memory = 10;      ///< steps remembered
    bool start_anew = true;       ///< where no step is found: forget, and go straight down once more
    std::function<bool()> stop{}; ///< asked before each step
    int visit_every = 15;         ///< steps between calls of `visit`
    std::function<bool(const Eigen::VectorXd& x)> visit{}; ///< shown where it got to; true: that is enough
};

/// Value of a function and its gradient at `x`.
using Function = std::function<double(const Eigen::VectorXd& x, Eigen::VectorXd& gradient)>;

/// Limited-memory BFGS with backtracking (Nocedal and Wright, Algorithm 7.5). Steps stay in the span of the
/// gradients, so a function whose gradients lie in a subspace is minimised along it.
/// @return the value at the end.
double minimise(const Function& function, Eigen::VectorXd& x, const MinimiseOptions& options = {});

} // namespace lacuna::geometry
