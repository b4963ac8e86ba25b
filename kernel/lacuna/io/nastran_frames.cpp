// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/nastran.h>

#include <lacuna/core/shared/criteria.h>

#include <cmath>

namespace lacuna::io {
namespace {

constexpr int kDeepest = 200; // limit on the nesting of frames, because each level is a recursive call; not
                              // measured

/// Components of a point along the axes of a frame of this kind.
Vec3 along_axes(char kind, const Vec3& p)
{
    if (kind == 'C') return {p.x() * std::cos(p.y() * kDegree), p.x() * std::sin(p.y() * kDegree), p.z()};
    if (kind == 'S') {
        const double across = p.x() * std::sin(p.y() * kDegree);
        return {across * std::cos(p.z() * kDegree), across * std::sin(p.z() * kDegree),
                p.x() * std::cos(p.y() * kDegree)};
    }
    return p;
}

} // namespace

void Frames::add(Index tag, const Definition& definition)
{
    if (tag == 0) definition.place.fail("expected a coordinate system's number above 0");
    const auto [found, fresh] = frames_.try_emplace(tag, Frame{.definition = definition});
    if (!fresh) definition.place.fail("{} is defined twice", numbered("coordinate system", tag));
}

Vec3 Frames::to_basic(Index tag, const Vec3& point, const DeckPlace& place)
{
    if (tag == 0) return point;
    const auto found = frames_.find(tag);
    if (found == frames_.end())
        place.fail(Message(kUnreadable, "the point is in {}, which does not exist",
                           numbered("coordinate system", tag))
                       .remedy("CORD1R, 1C, 1S, 2R, 2C and 2S are read"));
    if (!found->second.known) resolve(tag, found->second);
    const Frame& frame = found->second;
    return frame.origin + frame.axes * along_axes(frame.definition.kind, point);
}

void Frames::resolve(Index tag, Frame& frame)
{
    const Definition& given = frame.definition;
    if (++depth_ > kDeepest)
        given.place.fail("{} is defined by itself, or by others more than {} levels deep",
                         numbered("coordinate system", tag), kDeepest);
    std::array<Vec3, 3> at;
    for (std::size_t k = 0; k < 3; ++k)
        at[k] = given.by_nodes ? node_at_(given.node[k], given.place)
                               : to_basic(given.base, given.at[k], given.place);
    --depth_;
    const Vec3 z = (at[1] - at[0]).stableNormalized();
    const Vec3 y = z.cross((at[2] - at[0]).stableNormalized());
    if (!(y.norm() > kSamePlace))
        given.place.fail("the three points of {} are collinear", numbered("coordinate system", tag));
    frame.axes.col(2) = z;
    frame.axes.col(1) = y.normalized();
    frame.axes.col(0) = frame.axes.col(1).cross(z);
    frame.origin = at[0];
    frame.known = true;
}

} // namespace lacuna::io
