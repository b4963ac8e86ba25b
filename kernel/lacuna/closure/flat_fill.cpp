// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/flat_fill.h>

#include <lacuna/closure/detail/pieces.h>
#include <lacuna/closure/detail/sealing.h>
#include <lacuna/core/error.h>
#include <lacuna/geometry/newell.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lacuna::closure {

using namespace topology;

namespace {

/// A loop is flat where no point of it is further than this share of its length from its plane.
constexpr double kFlatLoop = 1e-6;
std::vector<Vec3> points_of(const Model& model, const std::vector<EdgeUse>& uses)
{
    std::vector<Vec3> points;
    for (const EdgeUse& use : uses) {
        const std::vector<Index> chain = use_points(model, use);
        for (std::size_t i = 0; i + 1 < chain.size(); ++i) points.push_back(model.at(chain[i]));
    }
    return points;
}

/// A loop in one plane.
struct FlatLoop {
    std::vector<EdgeUse> uses;
};

/// As many uses of a loop from `start` as lie in one plane.
std::size_t flat_run(const Model& model, const Rim& rim, std::size_t start)
{
    const std::size_t uses = rim.uses.size();
    std::vector<Vec3> points{model.at(model[use_from(model, rim.uses[start])].point)};
    std::optional<Vec3> normal;
    const double tolerance = model.tolerance;
    for (std::size_t n = 0; n < uses; ++n) {
        const std::vector<Index> chain = use_points(model, rim.uses[(start + n) % uses]);
        for (std::size_t i = 1; i < chain.size(); ++i) {
            const Vec3& p = model.at(chain[i]);
            if (normal) {
                if (std::abs((p - points.front()).dot(*normal)) > tolerance) return n;
                continue;
            }
            for (std::size_t k = 1; k < points.size() && !normal; ++k) {
                const Vec3 across = (points[k] - points.front()).cross(p - points.front());
                if (across.norm() > tolerance * (points[k] - points.front()).norm())
                    normal = across.normalized();
            }
            points.push_back(p);
        }
    }
    return uses;
}

/// A loop that lies in two planes as two flat ones, with a straight void edge between them.
std::optional<std::array<FlatLoop, 2>> split_in_two(Model& model, const Rim& rim)
{
    const std::size_t uses = rim.uses.size();
    std::vector<std::size_t> run;
    for (std::size_t i = 0; i < uses; ++i) run.push_back(flat_run(model, rim, i));
    for (std::size_t i = 0; i < uses; ++i) {
        const std::size_t first = run[i], j = (i + first) % uses;
        if (first < 2 || first >= uses || uses - first < 2 || run[j] < uses - first) continue;
        // Runs that go on past each other leave several places to part them: none is more right.
        if (run[j] > uses - first) continue;
        const VertexId a = use_from(model, rim.uses[i]), b = use_from(model, rim.uses[j]);
        const EdgeId edge = add_void_edge(model, a, b, {model[a].point, model[b].point});
        std::array<FlatLoop, 2> parts;
        for (std::size_t k = 0; k < uses; ++k)
            parts[k < first ? 0 : 1].uses.push_back(rim.uses[(i + k) % uses]);
        parts[0].uses.push_back({edge, true});
        parts[1].uses.push_back({edge, false});
        return parts;
    }
    return std::nullopt;
}

/// Loops that lie in one plane.
struct Coplanar {
    geometry::Plane plane;
    std::vector<std::size_t> loops;
};

std::vector<Coplanar> by_plane(const Model& model, const std::vector<FlatLoop>& loops)
{
    std::vector<Coplanar> planes;
    for (std::size_t i = 0; i < loops.size(); ++i) {
        const std::vector<std::vector<Vec3>> loop{points_of(model, loops[i].uses)};
        const std::vector<Vec3>& points = loop.front();
        const auto own = std::find_if(planes.begin(), planes.end(), [&](const Coplanar& other) {
            return std::all_of(points.begin(), points.end(), [&](const Vec3& p) {
                return std::abs(geometry::height(other.plane, p)) <= model.tolerance;
            });
        });
        if (own != planes.end())
            own->loops.push_back(i);
        else
            planes.push_back({geometry::newell_plane(loop), {i}});
    }
    return planes;
}

} // namespace

bool is_flat(const Model& model, const Rim& rim)
{
    Vec3 mean = Vec3::Zero(), area = Vec3::Zero();
    std::vector<Vec3> points;
    double length = 0;
    for (const EdgeUse& use : rim.uses) {
        const std::vector<Index> chain = use_points(model, use);
        for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
            points.push_back(model.at(chain[i]));
            length += (model.at(chain[i + 1]) - model.at(chain[i])).norm();
        }
    }
    for (const Vec3& p : points) mean += p / static_cast<double>(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        area += (points[i] - mean).cross(points[(i + 1) % points.size()] - mean);
    const Vec3 normal = area.stableNormalized();
    return std::all_of(points.begin(), points.end(),
                       [&](const Vec3& p) { return std::abs((p - mean).dot(normal)) <= kFlatLoop * length; });
}

std::optional<FlatFilling> fill_flat_loops(const Model& model, const std::vector<FaceId>& faces,
                                           const RunContext& context)
{
    FlatFilling result;
    OpenVolume& volume = result.volume;
    volume.model = extract(model, faces);
    orient_consistently(volume.model);
    volume.role.assign(faces.size(), Role::wall);
    std::vector<FlatLoop> loops;
    for (const Rim& rim : free_loops(volume)) {
        if (is_flat(volume.model, rim)) {
            loops.push_back({rim.uses});
            continue;
        }
        auto parts = split_in_two(volume.model, rim);
        if (!parts) return std::nullopt;
        result.closure.void_edges.emplace_back(volume.model.edges.size() - 1);
        loops.insert(loops.end(), parts->begin(), parts->end());
        result.each_alone = false;
    }
    for (const Coplanar& one : by_plane(volume.model, loops)) {
        check_cancelled(context);
        std::vector<std::vector<Vec2>> flat;
        for (const std::size_t loop : one.loops) {
            flat.emplace_back();
            for (const Vec3& p : points_of(volume.model, loops[loop].uses))
                flat.back().push_back(geometry::to_plane(one.plane, p));
        }
        for (const std::vector<std::size_t>& region : regions_of(flat)) {
            std::vector<std::vector<EdgeUse>> bounds;
            for (const std::size_t loop : region) bounds.push_back(loops[one.loops[loop]].uses);
            result.each_alone = result.each_alone && region.size() == 1;
            const FaceId face = add_partition(volume.model, bounds, one.plane, context);
            volume.model[face].name.clear();
            volume.role.push_back(Role::wall);
            result.closure.void_faces.push_back(face);
        }
    }
    build_loops(volume.model);
    orient_consistently(volume.model);
    if (!is_watertight(volume) || first_crossing(volume, context)) return std::nullopt;
    result.closure.watertight = true;
    return result;
}

} // namespace lacuna::closure
