// SPDX-License-Identifier: MIT
#include <lacuna/geometry/shared/minimise.h>

#include <lacuna/core/shared/criteria.h>

#include <cmath>
#include <deque>
#include <utility>
#include <vector>

namespace lacuna::geometry {

namespace {

/// Required fraction of the predicted decrease (Armijo condition); the usual value.
constexpr double kEnough = 1e-4;

struct Pair {
    Eigen::VectorXd step, change;
    double inverse;
};

/// The two-loop recursion of L-BFGS.
Eigen::VectorXd direction_of(const std::deque<Pair>& memory, const Eigen::VectorXd& gradient)
{
    Eigen::VectorXd direction = -gradient;
    std::vector<double> alpha(memory.size());
    for (std::size_t i = memory.size(); i-- > 0;) {
        alpha[i] = memory[i].inverse * memory[i].step.dot(direction);
        direction -= alpha[i] * memory[i].change;
    }
    if (!memory.empty())
        direction *= memory.back().step.dot(memory.back().change) / memory.back().change.squaredNorm();
    for (std::size_t i = 0; i < memory.size(); ++i)
        direction += (alpha[i] - memory[i].inverse * memory[i].change.dot(direction)) * memory[i].step;
    return direction;
}

} // namespace

Eigen::VectorXd minimise(const Function& function, Eigen::VectorXd x, const MinimiseOptions& options)
{
    std::deque<Pair> memory;
    Eigen::VectorXd gradient(x.size()), next_gradient(x.size()), tried(x.size());
    double value = function(x, gradient);
    for (int step = 0; step < options.iterations; ++step) {
        if (options.stop && options.stop()) break;
        Eigen::VectorXd direction = direction_of(memory, gradient);
        double slope = gradient.dot(direction);
        if (!(slope < 0)) {
            memory.clear();
            direction = -gradient;
            slope = -gradient.squaredNorm();
        }
        if (!(slope < 0)) break;
        double length = memory.empty() ? 0.1 * std::abs(value) / -slope : 1;
        double found = value;
        bool won = false;
        for (const double least = kSamePlace * length; length > least && !won;) {
            tried = x + length * direction;
            found = function(tried, next_gradient);
            won = std::isfinite(found) && found <= value + kEnough * length * slope;
            if (!won) length /= 2;
        }
        if (!won) {
            if (memory.empty() || !options.start_anew) break;
            memory.clear(); // stored steps may mislead here: restart with steepest descent
            continue;
        }
        Pair pair{tried - x, next_gradient - gradient, 0};
        const double curvature = pair.step.dot(pair.change);
        if (curvature > kRoundoff * pair.step.norm() * pair.change.norm()) {
            pair.inverse = 1 / curvature;
            memory.push_back(std::move(pair));
            if (memory.size() > options.memory) memory.pop_front();
        }
        const double won_by = value - found;
        std::swap(x, tried);
        std::swap(gradient, next_gradient);
        value = found;
        if (options.visit && (step + 1) % options.visit_every == 0 && options.visit(x)) break;
        if (won_by < options.least_gain * std::abs(value)) break;
    }
    return x;
}

} // namespace lacuna::geometry
