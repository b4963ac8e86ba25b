// SPDX-License-Identifier: MIT
#include <lacuna/matching/detail/assignment.h>

#include <lacuna/core/shared/constants.h>

#include <cmath>

namespace lacuna::matching {

std::vector<int> assign(const Eigen::MatrixXd& cost)
{
    const auto n = static_cast<int>(cost.rows());
    double finite_sum = 1;
    for (Eigen::Index i = 0; i < cost.size(); ++i) {
        if (std::isfinite(cost(i))) finite_sum += std::abs(cost(i));
    }
    // A forbidden pair costs more than all the others together.
    const auto price = [&](int row, int column) {
        const double c = cost(row, column);
        return std::isfinite(c) ? c : finite_sum;
    };
    std::vector<double> row_potential(n + 1, 0), column_potential(n + 1, 0);
    std::vector<int> row_of(n + 1, 0), way(n + 1, 0);
    for (int row = 1; row <= n; ++row) {
        row_of[0] = row;
        int column = 0;
        std::vector<double> least(n + 1, kInfinity);
        std::vector<bool> used(n + 1, false);
        do {
            used[column] = true;
            const int from = row_of[column];
            double delta = kInfinity;
            int next = 0;
            for (int j = 1; j <= n; ++j) {
                if (used[j]) continue;
                const double reduced = price(from - 1, j - 1) - row_potential[from] - column_potential[j];
                if (reduced < least[j]) {
                    least[j] = reduced;
                    way[j] = column;
                }
                if (least[j] < delta) {
                    delta = least[j];
                    next = j;
                }
            }
            for (int j = 0; j <= n; ++j) {
                if (used[j]) {
                    row_potential[row_of[j]] += delta;
                    column_potential[j] -= delta;
                } else {
                    least[j] -= delta;
                }
            }
            column = next;
        } while (row_of[column] != 0);
        while (column != 0) {
            row_of[column] = row_of[way[column]];
            column = way[column];
        }
    }
    std::vector<int> result(static_cast<std::size_t>(n), -1);
    for (int j = 1; j <= n; ++j) {
        const int row = row_of[j] - 1;
        if (std::isfinite(cost(row, j - 1))) result[static_cast<std::size_t>(row)] = j - 1;
    }
    return result;
}

} // namespace lacuna::matching
