// SPDX-License-Identifier: MIT
#include <lacuna/mesh/shared/mesh_view.h>

namespace lacuna::mesh {

void Ranges::add(std::size_t begin, std::size_t end)
{
    if (begin >= end) return;
    const bool goes_on = !ranges_.empty() && ranges_.back().first + (count_ - ranges_.back().before) == begin;
    if (!goes_on) ranges_.push_back({begin, count_});
    count_ += end - begin;
}

std::size_t Ranges::range_at(std::size_t i) const
{
    const auto next = std::ranges::upper_bound(ranges_, i, {}, &Range::before);
    return static_cast<std::size_t>(next - ranges_.begin()) - 1;
}

std::size_t Ranges::range_with(std::size_t value) const
{
    const auto next = std::ranges::upper_bound(ranges_, value, {}, &Range::first);
    return static_cast<std::size_t>(next - ranges_.begin()) - 1;
}

bool Ranges::contains(std::size_t value) const
{
    const std::size_t r = range_with(value);
    const std::size_t end = r + 1 < ranges_.size() ? ranges_[r + 1].before : count_;
    return r < ranges_.size() && value - ranges_[r].first < end - ranges_[r].before;
}

std::pair<std::int64_t, std::int64_t> Numbers::bounds(std::size_t count) const
{
    std::pair<std::int64_t, std::int64_t> all{(*this)[0], (*this)[0]};
    const auto take = [&](std::int64_t first, std::int64_t last) {
        all = {std::min(all.first, first), std::max(all.second, last)};
    };
    for (const std::int64_t number : held_) take(number, number);
    if (!held_.empty()) return all;
    if (ranges_ == nullptr) return {all.first, all.first + static_cast<std::int64_t>(count) - 1};
    ranges_->each(0, count, [&](std::size_t first, std::size_t last) {
        take(static_cast<std::int64_t>(first), static_cast<std::int64_t>(last) - 1);
    });
    return all;
}

void add_run(Runs& runs, std::size_t end, Index of)
{
    if (end <= (runs.empty() ? 0 : runs.back().first)) return;
    if (!runs.empty() && runs.back().second == of)
        runs.back().first = end;
    else
        runs.emplace_back(end, of);
}

std::size_t MeshView::cells() const
{
    std::size_t sum = 0;
    for (const Block& block : blocks) sum += block.count;
    return sum;
}

} // namespace lacuna::mesh
