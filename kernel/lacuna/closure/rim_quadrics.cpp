// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/rim_quadrics.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/shared/dense_solve.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/geometry/shared/spread.h>
#include <lacuna/topology/shared/cone_shape.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/use_places.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>
#include <span>

namespace lacuna::closure {

using namespace topology;

namespace {

using Powers = Eigen::Vector<double, 10>;

/// Tolerance for points on a quadric, in a frame in which the rim extends equally in all directions
/// (`EvenFrame`). Mesh points on a quadric are off by rounding only; with a higher value, quadrics are found
/// that the rim only approximates.
constexpr double kOnQuadric = 1e-4;
/// Least number of points of the rim beyond nine. Nine points always lie on a quadric; further points show
/// that the rim does. A higher number would exclude rims of few points.
constexpr Eigen::Index kSpare = 4;
/// A quadric is perpendicular to the rim's plane at a point of the rim if the cosine of the angle between the
/// quadric's gradient and the plane's normal is below `kStandsUp`. There it continues a wall and cannot be
/// the missing end. It may be perpendicular on at most a share `kStanding` of the points: a shaft on which a
/// tube of the same diameter ends is perpendicular at two points of the tube's rim.
constexpr double kStandsUp = 0.05, kStanding = 0.1;

Powers powers_at(const Vec3& p)
{
    Powers powers;
    powers << p.x() * p.x(), p.y() * p.y(), p.z() * p.z(), p.x() * p.y(), p.y() * p.z(), p.z() * p.x(), p, 1;
    return powers;
}

Eigen::Matrix4d form_of(const Powers& q)
{
    Eigen::Matrix4d form;
    form << 2 * q[0], q[3], q[5], q[6], //
        q[3], 2 * q[1], q[4], q[7],     //
        q[5], q[4], 2 * q[2], q[8],     //
        q[6], q[7], q[8], 2 * q[9];
    return form;
}

/// Homogeneous coordinates of a point in a quadric's frame.
Eigen::Vector4d in_frame(const Quadric& quadric, const Vec3& place)
{
    Eigen::Vector4d at;
    at << (place - quadric.centre) / quadric.unit, 1;
    return at;
}

/// A frame in which points spread equally in all directions.
struct EvenFrame {
    Vec3 centre = Vec3::Zero();
    double unit = 0; ///< the largest spread [model length]
    Eigen::Matrix3d stretch = Eigen::Matrix3d::Identity();
};

std::optional<EvenFrame> even_frame(std::span<const Vec3> points)
{
    const geometry::Spread spread = geometry::spread_of(points);
    if (!(spread.square(0) > kRoundoff * spread.square(2))) return std::nullopt;
    const Vec3 stretches = spread.square.cwiseSqrt().cwiseInverse();
    return EvenFrame{spread.centre, std::sqrt(spread.square(2)),
                     spread.axis * stretches.asDiagonal() * spread.axis.transpose()};
}

/// A basis of the quadratic forms that vanish at some points, for coordinates (p − frame.centre) /
/// frame.unit. Empty if there are too few points to decide, or more than two independent forms.
std::vector<Eigen::Matrix4d> forms_through(std::span<const Vec3> points, const EvenFrame& frame)
{
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(10, 10);
    for (const Vec3& p : points) {
        const Powers powers = powers_at(frame.stretch * (p - frame.centre));
        sum += powers * powers.transpose();
    }
    const geometry::SymmetricEigen fit = geometry::symmetric_eigen(sum);
    const auto count = static_cast<Eigen::Index>(points.size());
    Eigen::Index forms = 0;
    while (forms < 10 && fit.values(forms) <= kOnQuadric * kOnQuadric * static_cast<double>(count)) ++forms;
    if (forms > 2 || forms * (count - 10 + forms) < kSpare) return {};
    Eigen::Matrix4d back = Eigen::Matrix4d::Identity();
    back.topLeftCorner<3, 3>() = frame.unit * frame.stretch;
    std::vector<Eigen::Matrix4d> result;
    for (Eigen::Index i = 0; i < forms; ++i) {
        const Eigen::Matrix4d form = back.transpose() * form_of(fit.vectors.col(i)) * back;
        result.push_back(form / form.norm());
    }
    return result;
}

// --- deviation of a form from a special one --------------------------------------------------------

/// Eigenvalues of the quadratic part of a form, ascending.
Vec3 bends_of(const Eigen::Matrix4d& form)
{
    return geometry::symmetric_eigenvalues(form.topLeftCorner<3, 3>());
}

double off_ball(const Eigen::Matrix4d& form)
{
    const Vec3 bends = bends_of(form);
    return (bends(2) - bends(0)) / bends.cwiseAbs().maxCoeff();
}

Eigen::Vector4d singular_values(const Eigen::Matrix4d& form)
{
    Eigen::Vector4d values = geometry::symmetric_eigen(form).values.cwiseAbs();
    std::ranges::sort(values, std::greater{});
    return values / values(0);
}

double off_plane_pair(const Eigen::Matrix4d& form) { return singular_values(form)(2); }

/// Deviation from a circular cylinder or cone.
double off_round_cone(const Eigen::Matrix4d& form)
{
    const Vec3 bends = bends_of(form);
    double unlike = 1;
    for (const Eigen::Index i : {0, 1}) {
        const double more = std::max(std::abs(bends(i)), std::abs(bends(i + 1)));
        if (more > kAlikeSizes * bends.cwiseAbs().maxCoeff())
            unlike = std::min(unlike, (bends(i + 1) - bends(i)) / more);
    }
    return unlike + singular_values(form)(3);
}

/// Deviation from a cylinder of any section.
double off_cylinder(const Eigen::Matrix4d& form)
{
    const Eigen::Matrix<double, 4, 3> gradients = form.leftCols<3>();
    const Vec3 squares = geometry::symmetric_eigenvalues(gradients.transpose() * gradients);
    return std::sqrt(std::max(squares(0), 0.0) / squares(2));
}

/// The forms cos t · a + sin t · b at which `off` has a minimum of at most `kAlikeSizes`.
std::vector<Eigen::Matrix4d> special_forms(const Eigen::Matrix4d& a, const Eigen::Matrix4d& b,
                                           const std::function<double(const Eigen::Matrix4d&)>& off)
{
    const auto at = [&](double t) -> Eigen::Matrix4d { return std::cos(t) * a + std::sin(t) * b; };
    const double step = std::numbers::pi / kDegreesPerTurn;
    std::array<double, kDegreesPerTurn> values{};
    for (int k = 0; k < kDegreesPerTurn; ++k) values[static_cast<std::size_t>(k)] = off(at(k * step));
    std::vector<Eigen::Matrix4d> found;
    for (int k = 0; k < kDegreesPerTurn; ++k) {
        const auto value = [&](int i) {
            return values[static_cast<std::size_t>((i + kDegreesPerTurn) % kDegreesPerTurn)];
        };
        if (value(k) > value(k - 1) || value(k) >= value(k + 1)) continue;
        double t = k * step, width = step, least = value(k);
        while (width > kFileAccuracy * step) {
            width *= 0.7;
            for (const double other : {t - width, t + width}) {
                const double there = off(at(other));
                if (there >= least) continue;
                least = there;
                t = other;
                break;
            }
        }
        if (least <= kAlikeSizes) found.push_back(at(t));
    }
    return found;
}

/// Interpretation of a rim's points.
enum class RimIs {
    straight, ///< straight segments between all points
    curved,   ///< a curve, except between points that are far apart
};

std::vector<Vec3> rim_places(const Model& model, const std::vector<Loop>& loops, RimIs rim)
{
    constexpr double kFar = 0.25; // of the rim's extent: points of a circle of twelve facets are closer to
                                  // each other
    std::vector<std::vector<Vec3>> chains;
    Eigen::AlignedBox3d box;
    for (const Loop& loop : loops)
        for (const Vec3& p : chains.emplace_back(use_places(model, loop.uses))) box.extend(p);
    const double far = kFar * box.diagonal().norm();
    std::vector<Vec3> places;
    for (const std::vector<Vec3>& chain : chains) {
        for (std::size_t i = 1; i < chain.size(); ++i) {
            const bool parted = rim == RimIs::straight || (chain[i] - chain[i - 1]).norm() > far;
            const std::vector<Vec3> along = geometry::even_places(std::span(chain).subspan(i - 1, 2),
                                                                  parted ? kSamplesPerSide : 1);
            places.insert(places.end(), along.begin() + 1, along.end());
        }
    }
    return places;
}

/// The sheet of a quadric that contains the whole rim; empty if there is none, or if the quadric is
/// perpendicular to the plane at too many points (`kStanding`).
std::optional<QuadricSheet> sheet_through(std::span<const Vec3> rim, const Quadric& quadric,
                                          const geometry::Plane& plane)
{
    std::vector<Vec3> slopes;
    double steepest = 0;
    for (const Vec3& p : rim) {
        slopes.emplace_back((quadric.form * in_frame(quadric, p)).head<3>());
        steepest = std::max(steepest, slopes.back().norm());
    }
    std::size_t rising = 0, falling = 0;
    for (const Vec3& slope : slopes) {
        const double rise = slope.dot(plane.normal);
        const double enough = std::max(kStandsUp * slope.norm(), kFileAccuracy * steepest);
        rising += rise > enough ? 1 : 0;
        falling += -rise > enough ? 1 : 0;
    }
    const auto most = (1 - kStanding) * static_cast<double>(rim.size());
    if (std::min(rising, falling) > 0 || static_cast<double>(rising + falling) < most) return std::nullopt;
    return QuadricSheet{quadric, plane, rising > 0 ? 1.0 : -1.0};
}

RimShapes shapes_through(std::span<const Vec3> rim, const geometry::Plane& plane)
{
    RimShapes result;
    const std::optional<EvenFrame> frame = even_frame(rim);
    if (!frame) return result;
    const std::vector<Eigen::Matrix4d> forms = forms_through(rim, *frame);
    const auto add = [&](std::vector<QuadricSheet>& to, const Eigen::Matrix4d& form) {
        if (auto sheet = sheet_through(rim, {frame->centre, frame->unit, form}, plane))
            to.push_back(std::move(*sheet));
    };
    if (forms.size() == 1) add(result.told, forms.front());
    if (forms.size() != 2) return result;
    for (const auto& off : {off_ball, off_round_cone, off_plane_pair})
        for (const Eigen::Matrix4d& form : special_forms(forms[0], forms[1], off)) add(result.told, form);
    for (const Eigen::Matrix4d& form : special_forms(forms[0], forms[1], off_cylinder))
        add(result.possible, form);
    return result;
}

/// Whether a given face at the edges of some loops lies on a quadric. If the quadric is a pair of planes, the
/// missing face is not one of them: it would continue the given face.
bool holds_given_face(const Model& model, const std::vector<Loop>& loops, const Quadric& quadric)
{
    std::set<EdgeId> rim;
    for (const Loop& loop : loops)
        for (const EdgeUse& use : loop.uses) rim.insert(use.edge);
    const auto is_on_it = [&](Index point) {
        const Eigen::Vector4d at = in_frame(quadric, model.at(point));
        return std::abs(at.dot(quadric.form * at)) <= kOnQuadric * at.squaredNorm();
    };
    return std::ranges::any_of(model.faces, [&](const Face& face) {
        return face.origin == Origin::given &&
               std::ranges::any_of(uses_of(face), [&](const EdgeUse& u) { return rim.contains(u.edge); }) &&
               std::ranges::all_of(corners_of(face), is_on_it);
    });
}

} // namespace

std::optional<double> QuadricSheet::height(const Vec2& place) const
{
    const Eigen::Vector4d foot = in_frame(quadric, geometry::from_plane(plane, place));
    Eigen::Vector4d way;
    way << plane.normal, 0;
    const double a = way.dot(quadric.form * way), b = way.dot(quadric.form * foot);
    const double c = foot.dot(quadric.form * foot);
    const double inside = b * b - a * c;
    if (inside < -kFileAccuracy * (b * b + std::abs(a * c))) return std::nullopt;
    const double root = side * std::sqrt(std::max(0.0, inside));
    const double off = b * side > 0 ? -c / (b + root) : (root - b) / a;
    if (!std::isfinite(off)) return std::nullopt;
    return off * quadric.unit;
}

bool is_bent(const Quadric& quadric) { return off_plane_pair(quadric.form) > kAlikeSizes; }

bool is_round(const Quadric& quadric)
{
    return is_bent(quadric) && std::min(off_ball(quadric.form), off_round_cone(quadric.form)) <= kAlikeSizes;
}

RimShapes shapes_of_rim(const Model& model, const std::vector<Loop>& loops, const geometry::Plane& plane)
{
    const auto shapes_as = [&](RimIs rim) {
        RimShapes shapes = shapes_through(rim_places(model, loops, rim), plane);
        std::erase_if(shapes.told, [&](const QuadricSheet& sheet) {
            return !is_bent(sheet.quadric) && holds_given_face(model, loops, sheet.quadric);
        });
        return shapes;
    };
    RimShapes curved = shapes_as(RimIs::curved);
    if (!curved.told.empty()) return curved;
    RimShapes straight = shapes_as(RimIs::straight);
    return straight.told.empty() ? curved : straight;
}

} // namespace lacuna::closure
