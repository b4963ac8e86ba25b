// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <functional>

namespace lacuna::geometry {

struct MinimiseOptions {
    int iterations = 60;
    double least_gain = 1e-7;     ///< stop when a step reduces the value by less than this share [-]
    std::size_t memory = 10;      ///< number of stored steps
    bool start_anew = true;       ///< if no step is found, restart once with steepest descent
    std::function<bool()> stop{}; ///< called before each step; true stops
    int visit_every = 15;         ///< steps between calls of `visit`
    std::function<bool(const Eigen::VectorXd& x)> visit{}; ///< called with the current point; true stops
};

/// Value of a function; sets its gradient at `x`.
using Function = std::function<double(const Eigen::VectorXd& x, Eigen::VectorXd& gradient)>;

/// Minimise a function by limited-memory BFGS with backtracking (Nocedal and Wright, Algorithm 7.5). Every
/// step is a linear combination of gradients. If all gradients lie in a subspace, so do the steps: components
/// of the gradient that are set to zero keep their variables fixed.
/// @return  the last point.
Eigen::VectorXd minimise(const Function& function, Eigen::VectorXd x, const MinimiseOptions& options = {});

} // namespace lacuna::geometry
