// SPDX-License-Identifier: MIT
#include <lacuna/geometry/shared/motion.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>

#include <algorithm>
#include <cmath>

namespace lacuna::geometry {

namespace {

} // namespace

MotionPointer part_of_motion(const MotionPointer& whole, double from, double to)
{
    if (!whole || whole->reach) return nullptr;
    auto part = std::make_shared<Motion>();
    const Eigen::Affine3d back = whole->at(from).inverse();
    part->at = [whole, back, from, to](double height) {
        if (height == 0) return Eigen::Affine3d(Eigen::Affine3d::Identity());
        return Eigen::Affine3d(whole->at((1 - height) * from + height * to) * back);
    };
    const auto cut = [&](const std::vector<double>& heights) {
        std::vector<double> own;
        for (const double height : heights) {
            const double at = (height - from) / (to - from);
            if (at > 0 && at < 1) own.push_back(at);
        }
        own.push_back(0);
        own.push_back(1);
        std::ranges::sort(own);
        return own;
    };
    part->levels = cut(whole->levels);
    part->rows = cut(whole->rows);
    return part;
}

Motion translation(const Vec3& vector)
{
    Motion motion;
    motion.at = [vector](double height) { return Eigen::Affine3d(Eigen::Translation3d(height * vector)); };
    return motion;
}

Motion screw(const Vec3& point, const Vec3& direction, double angle, double pitch)
{
    Motion motion;
    motion.at = [=](double height) {
        const double turned = height * angle;
        return Eigen::Affine3d(Eigen::Translation3d(point + turned / kFullTurn * pitch * direction) *
                               Eigen::AngleAxisd(turned, direction) * Eigen::Translation3d(-point));
    };
    divide_turns(motion, {std::abs(angle)});
    return motion;
}

Motion distorted(Motion motion, const Vec3& centre, const Vec3& direction, const Distortion& by)
{
    if (!by.twist && !by.scale) return motion;
    motion.at = [base = std::move(motion.at), by, centre, direction](double height) {
        const double twist = by.twist ? by.twist(height) : 0, scale = by.scale ? by.scale(height) : 1;
        return Eigen::Affine3d(base(height) * Eigen::Translation3d(centre) *
                               Eigen::AngleAxisd(twist, direction) * Eigen::Scaling(scale) *
                               Eigen::Translation3d(-centre));
    };
    const bool curved = motion.rows.size() > 2;
    std::vector<double> turn;
    for (std::size_t i = 1; i < motion.levels.size(); ++i) {
        double part = by.most_twist * (motion.levels[i] - motion.levels[i - 1]);
        // Rows are needed where points do not move along straight lines. This is so if the section is scaled
        // along a curve or after a corner, or if twist or scale are not linear in the height. As many rows as
        // for a full turn are enough: the chords of a twist that is one wave of a sine deviate by 0.1 % of
        // its height.
        if (!by.even || (by.scale && curved)) part = std::max(part, kFullTurn);
        turn.push_back(part);
    }
    divide_turns(motion, turn);
    return motion;
}

void divide_turns(Motion& motion, const std::vector<double>& turn)
{
    std::vector<double> rows{0};
    for (std::size_t i = 0; i + 1 < motion.levels.size(); ++i) {
        const double low = motion.levels[i], high = motion.levels[i + 1];
        const auto known = std::ranges::count_if(motion.rows,
                                                 [&](double row) { return row > low && row <= high; });
        const auto wanted = static_cast<long>(std::ceil(turn[i] * kFineChords / kFullTurn - kFileAccuracy));
        const long count = std::max({1L, wanted, static_cast<long>(known)});
        for (long k = 1; k < count; ++k)
            rows.push_back(low + (high - low) * static_cast<double>(k) / static_cast<double>(count));
        rows.push_back(high);
    }
    motion.rows = std::move(rows);
}

} // namespace lacuna::geometry
