// SPDX-License-Identifier: MIT
#include <lacuna/geometry/shared/sparse_factor.h>

#include <lacuna/core/shared/constants.h>

#include <Eigen/OrderingMethods>

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

namespace lacuna::geometry {

namespace {

using Matrix = Eigen::SparseMatrix<double>;

/// For each row of L, the columns in which it has entries, found with the elimination tree.
class RowPattern {
public:
    explicit RowPattern(int size) : parent_(index(size), -1), met_(index(size), -1), row_(index(size)) {}

    /// The columns in which row k of L has entries. Each column comes after the columns that it depends on.
    /// The span is valid until the next call.
    /// @param tell  called with each entry of column k of the upper triangle.
    template <class Tell>
    std::span<const int> of(const Matrix& upper, int k, const Tell& tell)
    {
        met_[index(k)] = k;
        std::size_t top = row_.size();
        for (Matrix::InnerIterator entry(upper, k); entry; ++entry) {
            int i = static_cast<int>(entry.index());
            if (i > k) continue;
            tell(i, entry.value());
            path_.clear();
            for (; i >= 0 && met_[index(i)] != k; i = parent_[index(i)]) {
                path_.push_back(i);
                met_[index(i)] = k;
            }
            while (!path_.empty()) {
                row_[--top] = path_.back();
                path_.pop_back();
            }
        }
        return std::span(row_).subspan(top);
    }

    /// Add row k to the tree. In `count`, each column with an entry in row k is incremented.
    void grow(const Matrix& upper, int k, std::vector<int>& count)
    {
        met_[index(k)] = k;
        for (Matrix::InnerIterator entry(upper, k); entry; ++entry) {
            for (int i = static_cast<int>(entry.index()); i < k && met_[index(i)] != k;
                 i = parent_[index(i)]) {
                if (parent_[index(i)] < 0) parent_[index(i)] = k;
                ++count[index(i)];
                met_[index(i)] = k;
            }
        }
    }
    void forget() { std::fill(met_.begin(), met_.end(), -1); }

private:
    std::vector<int> parent_, met_, row_, path_;
};

} // namespace

SparseFactor::SparseFactor(const Matrix& lower, const RunContext& context)
{
    const auto size = static_cast<int>(lower.cols());
    check_cancelled(context);
    Eigen::PermutationMatrix<Eigen::Dynamic> back;
    {
        const Matrix whole = lower.selfadjointView<Eigen::Lower>();
        Eigen::AMDOrdering<int>()(whole, back);
    }
    order_ = back.inverse();
    Matrix upper(size, size);
    upper.selfadjointView<Eigen::Upper>() = lower.selfadjointView<Eigen::Lower>().twistedBy(order_);

    RowPattern pattern(size);
    std::vector<int> count(index(size), 0);
    check_cancelled(context);
    for (int k = 0; k < size; ++k) pattern.grow(upper, k, count);
    pattern.forget();

    lower_.resize(size, size);
    int* const begin = lower_.outerIndexPtr();
    begin[0] = 0;
    std::partial_sum(count.begin(), count.end(), begin + 1);
    lower_.resizeNonZeros(begin[size]);
    int* const inner = lower_.innerIndexPtr();
    double* const value = lower_.valuePtr();
    diagonal_.resize(size);

    std::vector<double> row(index(size), 0.0);
    std::vector<int> filled(begin, begin + size); // position of the next entry of each column
    long work = 0;
    for (int k = 0; k < size; ++k) {
        double pivot = 0;
        const auto columns = pattern.of(upper, k, [&](int i, double a) { row[index(i)] += a; });
        std::swap(pivot, row[index(k)]);
        for (const int i : columns) {
            double above = 0;
            std::swap(above, row[index(i)]);
            const double entry = above / diagonal_[i];
            int& end = filled[index(i)];
            for (int p = begin[i]; p < end; ++p) row[index(inner[p])] -= value[p] * above;
            pivot -= entry * above;
            work += end - begin[i] + 1;
            inner[end] = k;
            value[end++] = entry;
        }
        diagonal_[k] = pivot;
        if (pivot == 0) {
            good_ = false;
            return;
        }
        if (work < long{kBetweenPolls}) continue;
        check_cancelled(context);
        work = 0;
    }
}

Eigen::MatrixXd SparseFactor::solve(const Eigen::Ref<const Eigen::MatrixXd>& right) const
{
    Eigen::MatrixXd x = order_ * right;
    lower_.triangularView<Eigen::UnitLower>().solveInPlace(x);
    x = diagonal_.asDiagonal().inverse() * x;
    lower_.transpose().triangularView<Eigen::UnitUpper>().solveInPlace(x);
    return order_.inverse() * x;
}

} // namespace lacuna::geometry
