// SPDX-License-Identifier: GPL-2.0-or-later
#include <lacuna/cad_worker/exact_geometry.h>

#include <lacuna/cad_worker/detail/gmsh_api.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/core/shared/number_text.h>
#include <lacuna/geometry/shared/plain_curve.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lacuna::cad_worker {

namespace {

/// State of the projection of one point, in file lengths.
struct Iterate {
    Vec3 target;
    Vec2 uv;
    Vec3 at;
    double damping = 0; ///< Levenberg-Marquardt damping, relative to the derivatives
    bool done = false;
};

/// Which parameters a step may change: a parameter at the border of the box must not leave the box.
std::array<bool, 2> free_parameters(const ParameterBox& box, const Vec2& uv, const Vec2& descent)
{
    std::array<bool, 2> open{true, true};
    for (int k = 0; k < 2; ++k) {
        if (box.closed[static_cast<std::size_t>(k)]) continue;
        if ((uv[k] <= box.low[k] && descent[k] < 0) || (uv[k] >= box.high[k] && descent[k] > 0)) {
            open[static_cast<std::size_t>(k)] = false;
        }
    }
    return open;
}

/// The parameter step towards the target, and its length in space.
std::pair<Vec2, double> step_of(const Iterate& it, const SurfaceFrame& frame, const SecondDerivatives* second,
                                const ParameterBox& box)
{
    const Vec3 miss = it.target - it.at;
    const Vec2 descent(frame.du.dot(miss), frame.dv.dot(miss));
    Eigen::Matrix2d normal;
    normal << frame.du.squaredNorm(), frame.du.dot(frame.dv), frame.du.dot(frame.dv), frame.dv.squaredNorm();
    if (second != nullptr) {
        Eigen::Matrix2d full = normal;
        full(0, 0) -= miss.dot(second->uu);
        full(1, 1) -= miss.dot(second->vv);
        full(0, 1) -= miss.dot(second->uv);
        full(1, 0) = full(0, 1);
        if (full.determinant() > 1e-3 * normal.determinant() && full.trace() > 0) normal = full;
    }
    const std::array<bool, 2> open = free_parameters(box, it.uv, descent);
    Vec2 step = Vec2::Zero();
    if (open[0] && open[1]) {
        // At a pole one derivative vanishes. A minimal damping keeps the matrix regular.
        const double least = 1e-14 * normal.trace();
        normal(0, 0) += it.damping * normal(0, 0) + least;
        normal(1, 1) += it.damping * normal(1, 1) + least;
        step = normal.inverse() * descent;
    } else {
        const int k = open[0] ? 0 : 1;
        if (open[static_cast<std::size_t>(k)] && normal(k, k) > 0)
            step[k] = descent[k] / (normal(k, k) * (1 + it.damping));
    }
    return {step, (frame.du * step.x() + frame.dv * step.y()).norm()};
}

/// One step of all active iterates. @return how many remain.
std::size_t advance(std::vector<Iterate>& all, std::vector<std::size_t>& active, int tag,
                    const ParameterBox& box, double precision, bool with_second)
{
    std::vector<Vec2> uv;
    for (const std::size_t i : active) uv.push_back(all[i].uv);
    const std::vector<SurfaceFrame> frames = surface_frames(tag, uv);
    const std::vector<SecondDerivatives> second = with_second ? surface_second(tag, uv)
                                                              : std::vector<SecondDerivatives>{};
    for (std::size_t k = 0; k < active.size(); ++k) {
        Iterate& it = all[active[k]];
        const auto [step, length] = step_of(it, frames[k], with_second ? &second[k] : nullptr, box);
        const Vec2 next = box.bring_in(it.uv + step);
        it.done = length <= precision || next == it.uv;
        uv[k] = next;
    }
    const std::vector<Vec3> at = surface_points(tag, uv);
    for (std::size_t k = 0; k < active.size(); ++k) {
        Iterate& it = all[active[k]];
        const double before = (it.target - it.at).norm();
        const double after = (it.target - at[k]).norm();
        if (after <= before + precision) {
            it.uv = uv[k];
            it.at = at[k];
            it.damping = it.damping < 1e-3 ? 0 : it.damping / 10;
        } else {
            it.done = false;
            it.damping = it.damping == 0 ? 0.1 : it.damping * 10;
            // With such damping, a step is zero up to rounding.
            if (it.damping > 1e12) it.done = true;
        }
    }
    std::erase_if(active, [&](std::size_t i) { return all[i].done; });
    return active.size();
}

/// If an iterate starts at a pole, where one parameter is undefined, move it to the best of a few points
/// around the pole.
void leave_pole(Iterate& it, const SurfaceFrame& frame, int tag, const ParameterBox& box, double precision)
{
    const Vec2 side = box.high - box.low;
    const double across[2] = {frame.du.norm() * side.x(), frame.dv.norm() * side.y()};
    for (int k = 0; k < 2; ++k) {
        const int other = 1 - k;
        if (across[k] > 1e-6 * across[other] || (it.target - it.at).norm() <= precision) continue;
        const double inward = side[other] / kFineChords;
        std::vector<Vec2> ring(kChords);
        const bool at_low = it.uv[other] - box.low[other] < side[other] / 2;
        for (int i = 0; i < kChords; ++i) {
            Vec2& uv = ring[static_cast<std::size_t>(i)];
            uv[k] = box.low[k] + side[k] * (i + 0.5) / kChords;
            uv[other] = it.uv[other] + (at_low ? inward : -inward);
        }
        const std::vector<Vec3> at = surface_points(tag, ring);
        const auto nearest = std::min_element(at.begin(), at.end(), [&](const Vec3& a, const Vec3& b) {
            return (a - it.target).squaredNorm() < (b - it.target).squaredNorm();
        });
        it.at = *nearest;
        it.uv = ring[static_cast<std::size_t>(nearest - at.begin())];
        return;
    }
}

/// Vectors that Gmsh computes at parameters of a curve or surface.
std::vector<Vec3> evaluated(void (*compute)(int, int, const std::vector<double>&, std::vector<double>&),
                            int dim, int tag, const std::vector<double>& params)
{
    std::vector<double> values;
    compute(dim, tag, params, values);
    return unflat<3>(values);
}

[[noreturn]] void fail_projection(const CadSource& source, int tag, const Vec3& point)
{
    throw BackendError(Message("cad.projection", "{}: the point {} could not be projected onto {}",
                               source.path, place_with_digits(point, 6), NamedEntity{"face", tag})
                           .remedy("check the face in the CAD system"));
}

} // namespace

Vec2 ParameterBox::bring_in(Vec2 uv) const
{
    for (int k = 0; k < 2; ++k) {
        const double period = high[k] - low[k];
        if (closed[static_cast<std::size_t>(k)] && period > 0) {
            if (uv[k] < low[k] || uv[k] > high[k]) uv[k] -= period * std::floor((uv[k] - low[k]) / period);
        } else {
            uv[k] = std::clamp(uv[k], low[k], high[k]);
        }
    }
    return uv;
}

void project_on_face(const CadSource& source, int tag, std::span<Vec3> points, std::span<Vec2> uv)
{
    if (points.empty()) return;
    const ParameterBox& box = source.boxes.at(tag);
    Session session(source.path);
    source.model->activate(session);
    session.run([&] {
        std::vector<Vec2> start(uv.size());
        for (std::size_t i = 0; i < uv.size(); ++i) start[i] = box.bring_in(uv[i]);
        const std::vector<Vec3> at = surface_points(tag, start);
        std::vector<Iterate> all(points.size());
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (!points[i].allFinite() || !start[i].allFinite()) fail_projection(source, tag, points[i]);
            all[i] = {points[i] / source.scale, start[i], at[i], 0, false};
        }
        std::vector<std::size_t> active(all.size());
        std::iota(active.begin(), active.end(), std::size_t{0});
        const double precision = kSamePlace / 10 * source.diagonal; // see `kSamePlace`
        const std::vector<SurfaceFrame> frames = surface_frames(tag, start);
        for (std::size_t i = 0; i < all.size(); ++i) leave_pole(all[i], frames[i], tag, box, precision);
        // Near the surface, a step with first derivatives gains a digit or more. Points that have not
        // converged then are as far away as the radius of curvature, and need second derivatives too.
        for (int step = 0; step < kMostRounds; ++step) {
            if (advance(all, active, tag, box, precision, step >= kMostSteps) == 0) break;
        }
        for (const std::size_t i : active) {
            std::vector<double> closest, parameters;
            gmsh::model::getClosestPoint(2, tag, {all[i].target.x(), all[i].target.y(), all[i].target.z()},
                                         closest, parameters);
            if (closest.size() != 3 || parameters.size() != 2) fail_projection(source, tag, points[i]);
            all[i].at = {closest[0], closest[1], closest[2]};
            all[i].uv = {parameters[0], parameters[1]};
        }
        for (std::size_t i = 0; i < all.size(); ++i) {
            points[i] = all[i].at * source.scale;
            uv[i] = all[i].uv;
        }
    });
}

std::vector<Vec3> evaluate_curve(const CadSource& source, int tag, const std::vector<double>& params)
{
    if (params.empty()) return {};
    Session session(source.path);
    source.model->activate(session);
    return session.run([&] {
        std::vector<Vec3> points = curve_points(tag, params);
        for (Vec3& p : points) p = Vec3(p * source.scale);
        return points;
    });
}

std::vector<Vec3> curve_points(int tag, const std::vector<double>& params)
{
    return evaluated(gmsh::model::getValue, 1, tag, params);
}

std::vector<Vec3> plain_form(int tag, double first, double last)
{
    const std::string kind = gmsh_type(1, tag);
    const bool line = kind == "Line";
    if (!line && kind != "Circle" && kind != "Ellipse") return {};
    // Gmsh's first derivatives are exact, while its second derivatives are finite differences. So only first
    // ones are used.
    const Vec3 start = curve_points(tag, {0.0}).front();
    const std::vector<Vec3> along = curve_tangents(tag, {0.0, kRightAngle});
    geometry::PlainCurve plain{{start, along[0]}};
    if (!line) {
        // The cosine of the rounded kRightAngle is 6e-17, so along[1] contains that share of along[0].
        const Vec3 out = std::cos(kRightAngle) * along[0] - along[1];
        plain.form = {start - out, out, along[0]};
    }
    std::vector<double> params;
    for (const double share : {0.0, 0.1, 0.3, 0.45, 0.6, 0.8, 1.0})
        params.push_back(first + share * (last - first));
    const std::vector<Vec3> points = curve_points(tag, params);
    double size = 0, off = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        size = std::max(size, points[i].cwiseAbs().maxCoeff());
        off = std::max(off, (plain.at(params[i]) - points[i]).norm());
    }
    return off <= kRoundoff * size ? std::move(plain.form) : std::vector<Vec3>();
}

std::vector<Vec3> curve_tangents(int tag, const std::vector<double>& params)
{
    return evaluated(gmsh::model::getDerivative, 1, tag, params);
}

std::vector<Vec3> surface_points(int tag, const std::vector<Vec2>& uv)
{
    return evaluated(gmsh::model::getValue, 2, tag, flat(uv));
}

std::vector<SurfaceFrame> surface_frames(int tag, const std::vector<Vec2>& uv)
{
    const std::vector<Vec3> d = evaluated(gmsh::model::getDerivative, 2, tag, flat(uv));
    std::vector<SurfaceFrame> frames;
    for (std::size_t i = 0; i < d.size(); i += 2) frames.push_back({d[i], d[i + 1]});
    return frames;
}

Vec3 surface_normal(int tag, const Vec2& uv)
{
    std::vector<double> normal;
    gmsh::model::getNormal(tag, {uv.x(), uv.y()}, normal);
    return unflat<3>(normal).front();
}

std::vector<SecondDerivatives> surface_second(int tag, const std::vector<Vec2>& uv)
{
    const std::vector<Vec3> d = evaluated(gmsh::model::getSecondDerivative, 2, tag, flat(uv));
    std::vector<SecondDerivatives> second;
    for (std::size_t i = 0; i < d.size(); i += 3) second.push_back({d[i], d[i + 1], d[i + 2]});
    return second;
}

} // namespace lacuna::cad_worker
