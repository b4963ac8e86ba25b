// SPDX-License-Identifier: MIT
#include <lacuna/cad/detail/exact_geometry.h>

#include <algorithm>

namespace lacuna::cad {

using namespace cad_protocol;

namespace {

/// Points of one request: large enough that asking costs nothing beside the answer, small enough that other
/// threads need not wait long. Measured on a million points: no slower than in one.
constexpr std::size_t kAtOnce = 100'000;

void require_same(std::size_t asked, std::size_t came, const CadSource& source)
{
    if (asked != came)
        throw BackendError("cad.protocol",
                           source.path + ": the CAD process answered for another number of points");
}

} // namespace

void CadSurface::project(std::span<Vec3> points, std::span<Vec2> uv) const
{
    for (std::size_t from = 0; from < points.size(); from += kAtOnce) {
        const std::size_t count = std::min(kAtOnce, points.size() - from);
        const std::span<Vec3> some = points.subspan(from, count);
        const std::span<Vec2> places = uv.subspan(from, count);
        Task task{source_->path, "projecting points onto face " + std::to_string(tag_)};
        task.points = count;
        const auto reply = source_->worker->ask<ProjectReply>(
            Opcode::project,
            ProjectRequest{source_->handle, tag_, {some.begin(), some.end()}, {places.begin(), places.end()}},
            task);
        require_same(count, reply.points.size(), *source_);
        std::copy(reply.points.begin(), reply.points.end(), some.begin());
        std::copy(reply.uv.begin(), reply.uv.end(), places.begin());
    }
}

void CadCurve::evaluate(std::span<const double> params, std::span<Vec3> points) const
{
    if (points.empty()) return;
    Task task{source_->path, "evaluating curve " + std::to_string(tag_)};
    task.points = params.size();
    const auto reply = source_->worker->ask<EvaluateReply>(
        Opcode::evaluate, EvaluateRequest{source_->handle, tag_, {params.begin(), params.end()}}, task);
    require_same(points.size(), reply.points.size(), *source_);
    std::copy(reply.points.begin(), reply.points.end(), points.begin());
}

} // namespace lacuna::cad
