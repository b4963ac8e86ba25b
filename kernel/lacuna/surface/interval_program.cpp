// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/interval_program.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/dense_solve.h>
#include <lacuna/geometry/shared/union_find.h>
#include <lacuna/quads/shared/measure_plane.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>

namespace lacuna::surface {

namespace {

/// Cost of violating a floor by one side: larger than any term of the objective. Heuristic.
constexpr double kBelowFloor = 1e6;
/// Limit of free variables up to which pairs of vectors are tried too: a board of 32 × 32 faces has as many.
/// Decides the quality of the counts against the time. Heuristic.
constexpr std::size_t kByTwos = 64;
/// Additional cost of sides whose length is outside the accepted range, for each wanted side and by the
/// relative excess. Heuristic.
constexpr double kOutOfSize = 2;
/// Larger coefficients do not occur in interval assignment; the bound keeps products within range.
constexpr std::int64_t kMostCoefficient = 1 << 20;
/// Limit of the work for one set of equations, about 0.1 s; larger sets are not solved. Heuristic.
constexpr double kMostWork = 1e8;

double wish_cost(double n, double wanted, double weight)
{
    n = std::max(n, 0.5);
    const double longer = wanted / n; // length over wanted length
    const double out = std::max(
        {0.0, quads::kShortestOfSize / longer - 1, longer / quads::kLongestOfSize - 1});
    return weight * ((n - wanted) * (n - wanted) / n + kOutOfSize * wanted * out);
}

/// Equations with common variables, renumbered.
class IntervalSet {
public:
    IntervalSet(const IntervalProgram& program, std::vector<std::size_t> own,
                const std::vector<std::size_t>& equations, const std::vector<std::size_t>& wishes,
                const std::vector<std::size_t>& floors)
        : program_(program), own_(std::move(own))
    {
        for (std::size_t i = 0; i < own_.size(); ++i) local_[own_[i]] = i;
        for (const std::size_t e : equations) add_row(program.equations[e]);
        terms_of_.resize(own_.size());
        for (const std::size_t w : wishes) {
            const IntervalWish& wish = program.wishes[w];
            add_term(wish.variables, wish.wanted, wish.weight);
        }
        for (const std::size_t f : floors) add_term(program.floors[f].variables, program.floors[f].least, 0);
    }

    std::optional<std::vector<int>> solve()
    {
        const auto size = static_cast<double>(rows_.size());
        if (size * size * static_cast<double>(own_.size()) > kMostWork) return std::nullopt;
        if (!reduce() || !find_vectors()) return std::nullopt;
        std::optional<std::vector<int>> best = solve_from(rounded_wishes());
        const double cost = cost_;
        if (free_.size() > kByTwos) return best;
        auto other = solve_from(relaxed());
        return best && (!other || cost <= cost_) ? best : other;
    }

private:
    /// Start at values of the free variables and descend. @return nothing if the result violates a floor
    std::optional<std::vector<int>> solve_from(const std::vector<std::int64_t>& start)
    {
        if (!start_from(start)) return std::nullopt;
        sums_.clear();
        for (const Term& term : terms_) sums_.push_back(sum_of(term));
        cost_ = whole_cost();
        while (step()) {}
        for (std::size_t i = 0; i < own_.size(); ++i) {
            if (count_[i] < variable(i).least) return std::nullopt;
        }
        for (std::size_t t = 0; t < terms_.size(); ++t) {
            if (terms_[t].weight == 0 && static_cast<double>(sums_[t]) < terms_[t].wanted)
                return std::nullopt;
        }
        return std::vector<int>(count_.begin(), count_.end());
    }

    using Row = std::vector<std::int64_t>; ///< coefficients of the set's variables, then the right-hand side

    /// A term of the objective, or a floor if its weight is zero.
    struct Term {
        std::vector<std::pair<std::size_t, int>> variables;
        std::int64_t given = 0; ///< sum over fixed variables
        double wanted = 1, weight = 1;
    };

    [[nodiscard]] const IntervalVariable& variable(std::size_t i) const
    {
        return program_.variables[own_[i]];
    }

    void add_row(const IntervalEquation& equation)
    {
        Row row(own_.size() + 1, 0);
        const auto add = [&](const std::vector<std::size_t>& side, int sign) {
            for (const std::size_t v : side) {
                if (program_.variables[v].fixed)
                    row.back() -= sign * program_.variables[v].given;
                else
                    row[local_.at(v)] += sign;
            }
        };
        add(equation.one, 1);
        add(equation.other, -1);
        rows_.push_back(std::move(row));
    }

    void add_term(const std::vector<std::size_t>& variables, double wanted, double weight)
    {
        Term term{{}, 0, wanted, weight};
        std::map<std::size_t, int> own;
        for (const std::size_t v : variables) {
            if (program_.variables[v].fixed)
                term.given += program_.variables[v].given;
            else
                ++own[local_.at(v)];
        }
        term.variables.assign(own.begin(), own.end());
        for (const auto& [v, times] : term.variables) terms_of_[v].push_back({terms_.size(), times});
        terms_.push_back(std::move(term));
    }

    /// Gauss-Jordan elimination in integers. @return false if equations contradict each other
    bool reduce()
    {
        const std::size_t n = own_.size();
        std::size_t done = 0;
        std::vector<char> is_pivot(n, 0);
        while (done < rows_.size()) {
            // A pivot of one keeps the other coefficients integral; take the first of them.
            std::size_t best_row = done, best = n;
            for (std::size_t r = done; r < rows_.size(); ++r) {
                for (std::size_t v = 0; v < n; ++v) {
                    if (rows_[r][v] == 0) continue;
                    if (best < n && std::abs(rows_[r][v]) >= std::abs(rows_[best_row][best])) continue;
                    best_row = r;
                    best = v;
                }
            }
            if (best == n) break; // the remaining rows have no variables
            std::swap(rows_[done], rows_[best_row]);
            if (rows_[done][best] < 0) {
                for (std::int64_t& x : rows_[done]) x = -x;
            }
            for (std::size_t r = 0; r < rows_.size(); ++r) {
                if (r != done && rows_[r][best] != 0 && !eliminate(rows_[r], rows_[done], best)) return false;
            }
            pivot_.push_back(best);
            is_pivot[best] = 1;
            ++done;
        }
        for (std::size_t r = done; r < rows_.size(); ++r) {
            if (rows_[r].back() != 0) return false;
        }
        rows_.resize(done);
        for (std::size_t v = 0; v < n; ++v) {
            if (is_pivot[v] == 0) free_.push_back(v);
        }
        return true;
    }

    static bool eliminate(Row& row, const Row& by, std::size_t pivot)
    {
        const std::int64_t a = row[pivot], b = by[pivot], g = std::gcd(a, b);
        std::int64_t common = 0;
        for (std::size_t k = 0; k < row.size(); ++k) {
            row[k] = row[k] * (b / g) - by[k] * (a / g);
            common = std::gcd(common, row[k]);
        }
        if (common > 1) {
            for (std::int64_t& x : row) x /= common;
        }
        return std::ranges::all_of(row, [](std::int64_t x) { return std::abs(x) < kMostCoefficient; });
    }

    [[nodiscard]] std::vector<std::int64_t> rounded_wishes() const
    {
        std::vector<std::int64_t> counts;
        for (const std::size_t v : free_) {
            double wanted = 0, weight = 0;
            for (const auto& [t, times] : terms_of_[v]) {
                if (terms_[t].variables.size() > 1 || terms_[t].weight == 0) continue;
                wanted += terms_[t].weight * terms_[t].wanted;
                weight += terms_[t].weight;
            }
            counts.push_back(weight > 0 ? std::llround(wanted / weight) : 1);
        }
        return counts;
    }

    /// Starting point that accounts for coupled variables: the real minimizer of Σ weight (n − wanted)² /
    /// wanted over the free variables, rounded.
    [[nodiscard]] std::vector<std::int64_t> relaxed() const
    {
        const auto free = static_cast<Eigen::Index>(free_.size());
        // Each variable as a combination of the free ones; the last column is its constant.
        Eigen::MatrixXd of = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(own_.size()), free + 1);
        for (std::size_t k = 0; k < free_.size(); ++k)
            of(static_cast<Eigen::Index>(free_[k]), static_cast<Eigen::Index>(k)) = 1;
        for (std::size_t r = 0; r < rows_.size(); ++r) {
            const auto p = static_cast<Eigen::Index>(pivot_[r]);
            const auto by = static_cast<double>(rows_[r][pivot_[r]]);
            for (std::size_t k = 0; k < free_.size(); ++k)
                of(p, static_cast<Eigen::Index>(k)) = -static_cast<double>(rows_[r][free_[k]]) / by;
            of(p, free) = static_cast<double>(rows_[r].back()) / by;
        }
        constexpr double kNoWish = 1e-9; // regularizes variables without a term of their own
        Eigen::MatrixXd normal = kNoWish * Eigen::MatrixXd::Identity(free, free);
        Eigen::VectorXd right = Eigen::VectorXd::Constant(free, kNoWish);
        for (const Term& term : terms_) {
            if (term.weight == 0) continue;
            Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(free + 1);
            for (const auto& [v, times] : term.variables) sum += times * of.row(static_cast<Eigen::Index>(v));
            const double rest = term.wanted - static_cast<double>(term.given) - sum[free];
            const double weight = term.weight / term.wanted;
            normal += weight * sum.head(free).transpose() * sum.head(free);
            right += weight * rest * sum.head(free).transpose();
        }
        const Eigen::VectorXd x = geometry::solve_symmetric(normal, right);
        std::vector<std::int64_t> counts;
        for (Eigen::Index k = 0; k < free; ++k)
            counts.push_back(std::llround(std::clamp(x[k], 1.0, double(kMostCoefficient))));
        return counts;
    }

    /// Set the free variables to these values and compute the dependent ones.
    bool start_from(const std::vector<std::int64_t>& free)
    {
        count_.assign(own_.size(), 0);
        for (std::size_t k = 0; k < free_.size(); ++k)
            count_[free_[k]] = std::max<std::int64_t>(variable(free_[k]).least, free[k]);
        for (std::size_t r = 0; r < rows_.size(); ++r) {
            if (!make_whole(r)) return false;
        }
        return true;
    }

    [[nodiscard]] double whole_cost() const
    {
        double cost = 0;
        for (std::size_t v = 0; v < own_.size(); ++v) cost += below(v, count_[v]);
        for (std::size_t t = 0; t < terms_.size(); ++t) cost += term_cost(terms_[t], sums_[t]);
        return cost;
    }

    /// The search vectors.
    bool find_vectors()
    {
        for (const std::size_t v : free_) {
            std::int64_t stride = 1;
            for (std::size_t r = 0; r < rows_.size(); ++r) {
                const std::int64_t p = rows_[r][pivot_[r]];
                stride = std::lcm(stride, p / std::gcd(p, std::abs(rows_[r][v])));
            }
            if (stride >= kMostCoefficient) return false;
            std::vector<std::pair<std::size_t, std::int64_t>> vector{{v, stride}};
            for (std::size_t r = 0; r < rows_.size(); ++r) {
                if (rows_[r][v] != 0)
                    vector.push_back({pivot_[r], -rows_[r][v] * stride / rows_[r][pivot_[r]]});
            }
            vectors_.push_back(std::move(vector));
        }
        if (vectors_.size() <= kByTwos) add_pairs();
        return true;
    }

    /// Solve a row for its pivot. If that is not an integer, a free variable that occurs in no other row
    /// absorbs the remainder.
    bool make_whole(std::size_t r)
    {
        const std::int64_t p = rows_[r][pivot_[r]];
        const auto rest = [&] {
            std::int64_t sum = rows_[r].back();
            for (const std::size_t v : free_) sum -= rows_[r][v] * count_[v];
            return sum;
        };
        for (std::size_t k = 0; k <= free_.size(); ++k) {
            if (rest() % p == 0) {
                count_[pivot_[r]] = rest() / p;
                return true;
            }
            if (k == free_.size()) break;
            const std::size_t v = free_[k];
            if (rows_[r][v] == 0 || in_rows(v) > 1) continue;
            const std::int64_t before = count_[v];
            for (std::int64_t by = 1; by < p && rest() % p != 0; ++by) count_[v] = before + by;
            if (rest() % p != 0) count_[v] = before;
        }
        return false;
    }

    [[nodiscard]] std::size_t in_rows(std::size_t v) const
    {
        return static_cast<std::size_t>(
            std::ranges::count_if(rows_, [&](const Row& row) { return row[v] != 0; }));
    }

    /// Sums and differences of vectors that share a variable.
    void add_pairs()
    {
        const std::size_t alone = vectors_.size();
        for (std::size_t a = 0; a < alone; ++a) {
            for (std::size_t b = a + 1; b < alone; ++b) {
                for (const int sign : {1, -1}) {
                    std::map<std::size_t, std::int64_t> sum(vectors_[a].begin(), vectors_[a].end());
                    for (const auto& [v, by] : vectors_[b]) sum[v] += sign * by;
                    std::erase_if(sum, [](const auto& part) { return part.second == 0; });
                    if (sum.size() < vectors_[a].size() + vectors_[b].size())
                        vectors_.emplace_back(sum.begin(), sum.end());
                }
            }
        }
    }

    [[nodiscard]] std::int64_t sum_of(const Term& term) const
    {
        std::int64_t sum = term.given;
        for (const auto& [v, times] : term.variables) sum += times * count_[v];
        return sum;
    }

    static double term_cost(const Term& term, std::int64_t sum)
    {
        const auto n = static_cast<double>(sum);
        if (term.weight == 0) return kBelowFloor * std::max(0.0, term.wanted - n);
        return wish_cost(n, term.wanted, term.weight);
    }

    [[nodiscard]] double below(std::size_t v, std::int64_t count) const
    {
        return kBelowFloor * static_cast<double>(std::max<std::int64_t>(0, variable(v).least - count));
    }

    /// Change of the objective along a vector.
    double change(const std::vector<std::pair<std::size_t, std::int64_t>>& vector, std::int64_t times)
    {
        touched_.clear();
        double cost = 0;
        for (const auto& [v, by] : vector) {
            cost += below(v, count_[v] + times * by) - below(v, count_[v]);
            for (const auto& [t, often] : terms_of_[v]) touched_.push_back({t, often * times * by});
        }
        std::ranges::sort(touched_);
        for (std::size_t i = 0; i < touched_.size();) {
            std::int64_t by = 0;
            const std::size_t t = touched_[i].first;
            for (; i < touched_.size() && touched_[i].first == t; ++i) by += touched_[i].second;
            cost += term_cost(terms_[t], sums_[t] + by) - term_cost(terms_[t], sums_[t]);
        }
        return cost;
    }

    /// Take the step with the largest gain. @return false if no step gains
    bool step()
    {
        constexpr int kMostStep = 1 << 16;
        double best = -kRoundoff * (1 + std::abs(cost_));
        const std::vector<std::pair<std::size_t, std::int64_t>>* along = nullptr;
        std::int64_t times = 0;
        for (const auto& vector : vectors_) {
            for (const int sign : {1, -1}) {
                double last = 0;
                for (std::int64_t size = 1; size <= kMostStep; size *= 2) {
                    const double cost = change(vector, sign * size);
                    if (cost < best) {
                        best = cost;
                        along = &vector;
                        times = sign * size;
                    }
                    if (cost >= last) break;
                    last = cost;
                }
            }
        }
        if (along == nullptr) return false;
        for (const auto& [v, by] : *along) {
            count_[v] += times * by;
            for (const auto& [t, often] : terms_of_[v]) sums_[t] += often * times * by;
        }
        cost_ += best;
        return true;
    }

    const IntervalProgram& program_;
    std::vector<std::size_t> own_; ///< numbers of the variables in the program
    std::map<std::size_t, std::size_t> local_;
    std::vector<Row> rows_;
    std::vector<Term> terms_;
    std::vector<std::vector<std::pair<std::size_t, int>>> terms_of_;
    std::vector<std::size_t> pivot_, free_;
    std::vector<std::vector<std::pair<std::size_t, std::int64_t>>> vectors_;
    std::vector<std::int64_t> count_, sums_;
    std::vector<std::pair<std::size_t, std::int64_t>> touched_;
    double cost_ = 0;
};

} // namespace

double cost_of_intervals(const IntervalProgram& program, std::span<const int> counts)
{
    double cost = 0;
    for (const IntervalWish& wish : program.wishes) {
        int sum = 0;
        for (const std::size_t v : wish.variables) sum += counts[v];
        cost += wish_cost(sum, wish.wanted, wish.weight);
    }
    return cost;
}

std::vector<int> solve_intervals(const IntervalProgram& program)
{
    const std::size_t n = program.variables.size();
    geometry::UnionFind sets(n);
    // Fixed variables do not connect equations.
    const auto first_of = [&](const std::vector<std::size_t>& variables, std::size_t first) {
        for (const std::size_t v : variables) {
            if (program.variables[v].fixed) continue;
            if (first == kNoIndex)
                first = v;
            else
                sets.unite_least(first, v);
        }
        return first;
    };
    for (const IntervalEquation& equation : program.equations)
        first_of(equation.other, first_of(equation.one, kNoIndex));
    for (const IntervalWish& wish : program.wishes) first_of(wish.variables, kNoIndex);
    for (const IntervalFloor& floor : program.floors) first_of(floor.variables, kNoIndex);

    struct Parts {
        std::vector<std::size_t> variables, equations, wishes, floors;
    };
    std::map<std::size_t, Parts> parts;
    for (std::size_t v = 0; v < n; ++v) {
        if (!program.variables[v].fixed) parts[sets.find(v)].variables.push_back(v);
    }

    const auto sort = [&](std::vector<std::size_t> Parts::*list, std::size_t count, const auto& first) {
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t variable = first(i);
            if (variable != kNoIndex) (parts[sets.find(variable)].*list).push_back(i);
        }
    };
    sort(&Parts::equations, program.equations.size(), [&](std::size_t e) {
        return first_of(program.equations[e].other, first_of(program.equations[e].one, kNoIndex));
    });
    sort(&Parts::wishes, program.wishes.size(),
         [&](std::size_t w) { return first_of(program.wishes[w].variables, kNoIndex); });
    sort(&Parts::floors, program.floors.size(),
         [&](std::size_t f) { return first_of(program.floors[f].variables, kNoIndex); });

    std::vector<int> counts(n);
    for (std::size_t v = 0; v < n; ++v) counts[v] = program.variables[v].given;
    for (const auto& [set, part] : parts) {
        const auto own =
            IntervalSet(program, part.variables, part.equations, part.wishes, part.floors).solve();
        for (std::size_t i = 0; i < part.variables.size(); ++i)
            counts[part.variables[i]] = own ? (*own)[i] : 0;
    }
    return counts;
}

} // namespace lacuna::surface
