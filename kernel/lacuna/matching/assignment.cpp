// SPDX-License-Identifier: MIT
#include <lacuna/matching/detail/assignment.h>

#include <lacuna/core/shared/constants.h>

#include <algorithm>
#include <cmath>

namespace lacuna::matching {

namespace {

class Assigner {
public:
    Assigner(const PairCost& cost, const std::vector<std::size_t>& cheapest)
        : cost_(cost),
          n_(cheapest.size()),
          column_of_(n_, -1),
          row_of_(n_, -1),
          row_price_(n_, 0),
          column_price_(n_, 0)
    {
        for (std::size_t row = 0; row < n_; ++row) {
            const double least = row_price_[row] = cost(row, cheapest[row]);
            if (row_of_[cheapest[row]] < 0 && std::isfinite(least)) pair(row, cheapest[row]);
        }
    }

    std::vector<int> run()
    {
        if (std::ranges::find(column_of_, -1) == column_of_.end()) return std::move(column_of_);
        for (std::size_t row = 0; row < n_; ++row)
            for (std::size_t column = 0; column < n_; ++column)
                if (const double c = cost_(row, column); std::isfinite(c)) forbidden_ += std::abs(c);
        for (double& price : row_price_) price = std::min(price, forbidden_);
        for (std::size_t row = 0; row < n_; ++row)
            if (column_of_[row] < 0) augment(row);
        for (std::size_t row = 0; row < n_; ++row)
            if (!std::isfinite(cost_(row, static_cast<std::size_t>(column_of_[row])))) column_of_[row] = -1;
        return std::move(column_of_);
    }

private:
    void pair(std::size_t row, std::size_t column)
    {
        column_of_[row] = static_cast<int>(column);
        row_of_[column] = static_cast<int>(row);
    }

    /// Find the shortest augmenting path, by reduced costs, from a row to a free column, and change the pairs
    /// along the path.
    void augment(const std::size_t start)
    {
        std::vector<double> least(n_, kInfinity);
        std::vector<std::size_t> from(n_, start), reached; ///< `from`: row before each column; `reached`:
                                                           ///< columns in the order in which they were
                                                           ///< reached
        std::vector<bool> done(n_, false);
        std::size_t row = start, column = 0;
        double length = 0;
        do {
            std::size_t next = n_;
            for (std::size_t j = 0; j < n_; ++j) {
                if (done[j]) continue;
                const double reduced = length + std::min(cost_(row, j), forbidden_) - row_price_[row] -
                                       column_price_[j];
                if (reduced < least[j]) {
                    least[j] = reduced;
                    from[j] = row;
                }
                if (next == n_ || least[j] < least[next]) next = j;
            }
            column = next;
            done[column] = true;
            length = least[column];
            reached.push_back(column);
            if (row_of_[column] >= 0) row = static_cast<std::size_t>(row_of_[column]);
        } while (row_of_[column] >= 0);
        row_price_[start] += length;
        for (const std::size_t j : reached) {
            if (row_of_[j] >= 0) row_price_[static_cast<std::size_t>(row_of_[j])] += length - least[j];
            column_price_[j] -= length - least[j];
        }
        for (bool more = true; more;) {
            row = from[column];
            const int before = column_of_[row];
            pair(row, column);
            more = row != start;
            if (more) column = static_cast<std::size_t>(before);
        }
    }

    const PairCost& cost_;
    std::size_t n_;
    std::vector<int> column_of_, row_of_; ///< -1: not paired
    std::vector<double> row_price_, column_price_;
    double forbidden_ = 1; ///< cost of a forbidden pair: more than all other pairs together
};

} // namespace

std::vector<int> assign(const PairCost& cost, const std::vector<std::size_t>& cheapest)
{
    return Assigner(cost, cheapest).run();
}

} // namespace lacuna::matching
