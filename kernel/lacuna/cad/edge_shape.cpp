// SPDX-License-Identifier: MIT
#include <lacuna/cad/detail/edge_shape.h>

#include <lacuna/cad/detail/spline_patch.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/geometry/shared/segment.h>
#include <lacuna/geometry/shared/swept_surface.h>

#include <algorithm>

namespace lacuna::cad {

using namespace topology;

namespace {

bool collinear(std::span<const Vec3> points, double tolerance)
{
    return std::ranges::all_of(points, [&](const Vec3& p) {
        return geometry::distance_to_segment(p, points.front(), points.back()) <= tolerance;
    });
}

/// Whether a void edge is a copy of a polyline of the source, moved along a path with all its kinks.
bool is_moved_polyline(const Model& model, EdgeId edge)
{
    return std::ranges::any_of(model.uses_of_edge(edge), [&](const FaceUse& use) {
        const auto* swept = dynamic_cast<const geometry::SweptSurface*>(model[use.face].surface.get());
        return swept != nullptr && swept->has_kinks();
    });
}

void divide_by_last(std::vector<double>& lengths)
{
    const double total = lengths.back();
    for (std::size_t i = 0; i < lengths.size(); ++i)
        lengths[i] = total > 0 ? lengths[i] / total
                               : static_cast<double>(i) / static_cast<double>(lengths.size() - 1);
    lengths.back() = 1;
}

} // namespace

EdgeShape::EdgeShape(const Model& model, EdgeId id)
{
    const Edge& edge = model[id];
    for (const Index p : edge.points) points_.push_back(model.at(p));
    shares_ = geometry::arc_lengths(points_);
    length_ = shares_.back();
    divide_by_last(shares_);
    if (edge.curve && edge.params.size() == edge.points.size()) {
        kind_ = Kind::exact;
        curve_ = edge.curve;
        for (std::size_t i = 0; i + 1 < edge.params.size(); ++i) {
            for (std::size_t k = 0; k < kChords; ++k) {
                const double f = static_cast<double>(k) / kChords;
                fine_params_.push_back((1 - f) * edge.params[i] + f * edge.params[i + 1]);
            }
        }
        fine_params_.push_back(edge.params.back());
        std::vector<Vec3> fine(fine_params_.size());
        curve_->evaluate(fine_params_, fine);
        fine_shares_ = geometry::arc_lengths(fine);
        length_ = fine_shares_.back();
        divide_by_last(fine_shares_);
        for (std::size_t i = 0; i < shares_.size(); ++i) shares_[i] = fine_shares_[kChords * i];
    } else if (collinear(points_, model.tolerance)) {
        kind_ = Kind::straight;
    } else if (edge.origin == Origin::made_void && !is_moved_polyline(model, id)) {
        kind_ = Kind::smooth; // its points were placed at equidistant shares
        for (std::size_t i = 0; i < shares_.size(); ++i)
            shares_[i] = static_cast<double>(i) / static_cast<double>(shares_.size() - 1);
    } else {
        kind_ = Kind::polyline;
    }
}

/// The curve parameter at a share, by cubic interpolation through the four nearest samples. The error of the
/// arc length is far below any tolerance.
double EdgeShape::parameter(double share) const
{
    const std::size_t n = fine_shares_.size();
    const auto above = std::upper_bound(fine_shares_.begin(), fine_shares_.end(), share);
    const auto place = static_cast<std::size_t>(above - fine_shares_.begin());
    const std::size_t first = std::min(place < 2 ? 0 : place - 2, n - 4);
    double value = 0;
    for (std::size_t i = first; i < first + 4; ++i) {
        double weight = 1;
        for (std::size_t k = first; k < first + 4; ++k)
            if (k != i) weight *= (share - fine_shares_[k]) / (fine_shares_[i] - fine_shares_[k]);
        value += weight * fine_params_[i];
    }
    return value;
}

std::vector<Vec3> EdgeShape::at(std::span<const double> shares) const
{
    std::vector<Vec3> places(shares.size());
    switch (kind_) {
    case Kind::exact: {
        std::vector<double> params;
        for (const double s : shares)
            params.push_back(s <= 0 ? fine_params_.front() : s >= 1 ? fine_params_.back() : parameter(s));
        curve_->evaluate(params, places);
        break;
    }
    case Kind::straight:
        for (std::size_t i = 0; i < shares.size(); ++i)
            places[i] = (1 - shares[i]) * points_.front() + shares[i] * points_.back();
        break;
    case Kind::smooth: {
        const SplineCurveData spline = interpolate(points_);
        for (std::size_t i = 0; i < shares.size(); ++i) places[i] = point_at(spline, shares[i]);
        break;
    }
    case Kind::polyline:
        for (std::size_t i = 0; i < shares.size(); ++i)
            places[i] = geometry::point_at(points_, shares_, shares[i]);
        break;
    }
    return places;
}

double EdgeShape::sagitta() const
{
    std::vector<double> middles;
    for (std::size_t i = 0; i + 1 < shares_.size(); ++i) middles.push_back((shares_[i] + shares_[i + 1]) / 2);
    const std::vector<Vec3> places = at(middles);
    double greatest = 0;
    for (std::size_t i = 0; i < places.size(); ++i)
        greatest = std::max(greatest, (places[i] - (points_[i] + points_[i + 1]) / 2).norm());
    return greatest;
}

PatchSide::PatchSide(const Model& model, const std::vector<EdgeUse>& uses)
{
    std::vector<double> ends{0};
    for (const EdgeUse& use : uses) {
        pieces_.push_back({EdgeShape(model, use.edge), use.reversed, 0, 0});
        ends.push_back(ends.back() + pieces_.back().shape.length());
        sagitta_ = std::max(sagitta_, pieces_.back().shape.sagitta());
    }
    divide_by_last(ends);
    for (std::size_t i = 0; i < uses.size(); ++i) {
        Piece& piece = pieces_[i];
        piece.low = ends[i];
        piece.high = ends[i + 1];
        const std::vector<Index> chain = use_points(model, uses[i]);
        std::vector<double> own = piece.shape.shares();
        if (piece.reversed) {
            std::reverse(own.begin(), own.end());
            for (double& s : own) s = 1 - s;
        }
        for (std::size_t k = i == 0 ? 0 : 1; k < chain.size(); ++k) {
            points_.push_back(chain[k]);
            shares_.push_back(piece.low + own[k] * (piece.high - piece.low));
            const bool inner = k > 0 && k + 1 < chain.size();
            if (inner ? piece.shape.is_polyline() : (k > 0 && i + 1 < uses.size()))
                breaks_.push_back(shares_.back());
        }
    }
}

std::vector<Vec3> PatchSide::at(std::span<const double> shares) const
{
    std::vector<Vec3> places(shares.size());
    for (const Piece& piece : pieces_) {
        std::vector<double> own;
        std::vector<std::size_t> slots;
        for (std::size_t i = 0; i < shares.size(); ++i) {
            const bool last = &piece == &pieces_.back();
            if (shares[i] < piece.low && &piece != &pieces_.front()) continue;
            if (shares[i] >= piece.high && !last) continue;
            const double s = std::clamp((shares[i] - piece.low) / (piece.high - piece.low), 0.0, 1.0);
            own.push_back(piece.reversed ? 1 - s : s);
            slots.push_back(i);
        }
        const std::vector<Vec3> found = piece.shape.at(own);
        for (std::size_t k = 0; k < slots.size(); ++k) places[slots[k]] = found[k];
    }
    return places;
}

} // namespace lacuna::cad
