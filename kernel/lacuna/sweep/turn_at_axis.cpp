// SPDX-License-Identifier: MIT
#include <lacuna/sweep/shared/turn_at_axis.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/number_text.h>
#include <lacuna/core/shared/progress.h>
#include <lacuna/core/shared/same_corners.h>
#include <lacuna/mesh/quad_mesh.h>
#include <lacuna/surface/shared/default_size.h>
#include <lacuna/sweep/detail/assembly_nodes.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// Angle of a layer [radian] at which a polygon with such chords has 1 % less area than the circle.
const double kOnePercent = std::sqrt(0.06);

class Turner {
public:
    Turner(const AxisTurn& turn, const OpenVolume& flat, const Swept& base, const SweepOptions& options,
           const RunContext& context)
        : turn_(turn), flat_(flat), base_(base), options_(options), context_(context)
    {
    }

    SweptAssembly run()
    {
        take_source();
        orient();
        choose_layers();
        std::vector<std::pair<int, int>> ranges{{0, layers_}};
        if (turn_.is_full) ranges = {{0, layers_ / 2}, {layers_ / 2, layers_}};
        split();
        for (const auto& [from, to] : ranges)
            if (!rest_.empty()) add_rest(from, to);
        for (const std::vector<Strip>& chain : chains()) add_core(chain);
        for (std::size_t a = 0; a < result_.parts.size(); ++a) {
            result_.member.push_back(0);
            for (std::size_t b = 0; b < a; ++b)
                result_.shared.push_back({.a = b, .b = a, .face_a = between(), .face_b = between()});
        }
        number_nodes(result_);
        measure();
        return std::move(result_);
    }

private:
    /// A quad with a side on the axis: the ends of the side, and the corners above them.
    struct Strip {
        Index a, b, above_b, above_a;
        std::size_t quad;
    };

    /// The id of an imaginary face between two parts.
    [[nodiscard]] FaceId between() const { return FaceId(flat_.model.faces.size()); }

    /// Take the quads of the source from the mesh of the flat volume. This mesh may start at either end.
    void take_source()
    {
        const mesh::HexMesh& mesh = base_.mesh;
        const FaceId first = base_.faces[index(mesh.source_patch.front())];
        const bool turned = flat_.role[first.index()] != Role::source;
        const auto row = static_cast<std::ptrdiff_t>(mesh.nodes_per_layer);
        nodes_.assign(mesh.nodes.begin() + (turned ? row : 0), mesh.nodes.begin() + (turned ? 2 * row : row));
        quads_ = mesh.quads;
        start_ = turned ? mesh.target_patch : mesh.source_patch;
        end_ = turned ? mesh.source_patch : mesh.target_patch;
        for (std::size_t r = 0; r < mesh.rim.size(); ++r) wall_[rising(mesh.rim[r])] = mesh.wall_patch[r];
        for (const Vec3& node : nodes_) {
            const double far = (node - turn_.point).cross(turn_.axis).norm();
            on_axis_.push_back(far <= kSamePlace * flat_.model.diagonal ? 1 : 0);
            radius_ = std::max(radius_, far);
        }
    }

    /// Orient the quads so that their normals point in the direction of the turn.
    void orient()
    {
        const double sense = turn_.angle < 0 ? -1 : 1;
        int forward = 0;
        for (const Quad& quad : quads_) {
            const auto at = [&](std::size_t k) { return nodes_[index(quad[k])]; };
            const Vec3 centre = (at(0) + at(1) + at(2) + at(3)) / 4;
            const Vec3 normal = (at(2) - at(0)).cross(at(3) - at(1));
            const int own = sense * normal.dot(turn_.axis.cross(centre - turn_.point)) > 0 ? 1 : -1;
            if (forward == 0) forward = own;
            if (own == forward) continue;
            throw NotClosed(Message("closure.along_folds",
                                    "the source lies on both sides of its axis, or does not advance at {}",
                                    place_with_digits(centre, 4))
                                .remedy("use a source on one side of the axis"));
        }
        for (Quad& quad : quads_)
            if (forward < 0) quad = mesh::turned_over(quad);
    }

    void choose_layers()
    {
        const LayerSpec& spec = options_.layers;
        if (!spec.heights.empty() || spec.bias != 1)
            throw InvalidInput(
                Message("sweep.axis_layers", "if wedges meet at the axis, all layers have equal angles")
                    .remedy("give only their number"));
        const double turn = std::abs(turn_.angle);
        const int least = static_cast<int>(std::ceil(kLeastPerTurn * turn / kFullTurn - kSamePlace));
        layers_ = spec.count;
        if (layers_ == 0) {
            double size = surface::default_size(flat_).length;
            const auto far = std::ranges::max_element(
                nodes_, {}, [&](const Vec3& node) { return (node - turn_.point).cross(turn_.axis).norm(); });
            if (options_.size) size = options_.size(*far);
            layers_ = static_cast<int>(std::ceil(std::max(radius_ / size, 1 / kOnePercent) * turn));
        }
        if (layers_ >= least) return;
        throw InvalidInput(Message("sweep.axis_layers", "a turn of {:.3g} degrees needs {} layers, found {}",
                                   turn / kDegree, needed(least), found(layers_))
                               .remedy("use more 'layers'"));
    }

    /// Divide the quads into those on the axis and the others.
    void split()
    {
        for (std::size_t q = 0; q < quads_.size(); ++q) {
            const Quad& quad = quads_[q];
            const auto touching = std::ranges::count_if(quad,
                                                        [&](Index n) { return on_axis_[index(n)] != 0; });
            std::optional<std::size_t> side;
            for (std::size_t k = 0; k < 4; ++k)
                if (on_axis_[index(quad[k])] != 0 && on_axis_[index(quad[(k + 1) % 4])] != 0) side = k;
            if (touching == 0) {
                rest_.push_back(q);
            } else if (side && touching == 2 && !mesh::is_triangle(quad)) {
                const auto corner = [&](std::size_t k) { return quad[(*side + k) % 4]; };
                strips_.push_back({corner(0), corner(1), corner(2), corner(3), q});
            } else {
                refuse_corner(quad);
            }
        }
    }

    [[noreturn]] void refuse_corner(const Quad& quad) const
    {
        Vec3 centre = Vec3::Zero();
        for (const Index n : quad) centre += nodes_[index(n)] / 4;
        throw NotSweepable(
            Message("sweep.axis_corner",
                    "a quad of the source, at {}, touches the axis with one corner only, which "
                    "gives no valid cell",
                    place_with_digits(centre, 4))
                .remedy("use another 'size', or quads = \"paved\""));
    }

    /// The strips along each segment of the axis, sorted in its direction.
    [[nodiscard]] std::vector<std::vector<Strip>> chains() const
    {
        std::map<Index, const Strip*> from;
        std::map<Index, bool> is_end;
        for (const Strip& strip : strips_) {
            from[strip.a] = &strip;
            is_end[strip.b] = true;
        }
        std::vector<std::vector<Strip>> all;
        for (const auto& [node, first] : from) {
            if (is_end.contains(node)) continue;
            std::vector<Strip>& chain = all.emplace_back();
            for (auto at = from.find(node); at != from.end(); at = from.find(at->second->b)) {
                if (!chain.empty() && chain.back().above_b != at->second->above_a)
                    refuse_corner(quads_[at->second->quad]);
                chain.push_back(*at->second);
            }
        }
        return all;
    }

    /// The position of a source node in a layer. Nodes on the axis do not move.
    [[nodiscard]] Vec3 place(Index node, int layer) const
    {
        const Vec3& at = nodes_[index(node)];
        if (turn_.is_full) layer %= layers_;
        if (layer == 0 || on_axis_[index(node)] != 0) return at;
        const Eigen::AngleAxisd map(turn_.angle * layer / layers_, turn_.axis);
        return turn_.point + map * (at - turn_.point);
    }

    /// The patches of a part; a patch is added when it is first used.
    struct Patches {
        const Swept& base;
        FaceId between;
        Swept& part;
        std::map<Index, Index> known;

        /// @param patch  number of a patch of `base`; -1: the face is shared with another part
        Index operator()(Index patch)
        {
            const auto [at, fresh] = known.try_emplace(patch, static_cast<Index>(part.faces.size()));
            if (!fresh) return at->second;
            mesh::SkinPatch own;
            if (patch >= 0) own = base.mesh.patches[index(patch)];
            own.tag = static_cast<int>(part.faces.size()) + 1;
            part.mesh.patches.push_back(std::move(own));
            part.faces.push_back(patch >= 0 ? base.faces[index(patch)] : between);
            return at->second;
        }
    };

    [[nodiscard]] Index wall_of(Index a, Index b) const
    {
        const auto found = wall_.find(rising(Segment{a, b}));
        return found == wall_.end() ? -1 : found->second;
    }

    void add_rest(int from, int to)
    {
        Swept& part = result_.parts.emplace_back();
        mesh::HexMesh& mesh = part.mesh;
        Patches patches{base_, between(), part, {}};
        std::vector<Index> own(nodes_.size(), -1), used;
        for (const std::size_t q : rest_) {
            Quad& quad = mesh.quads.emplace_back(quads_[q]);
            for (Index& n : quad) {
                if (own[index(n)] < 0) {
                    own[index(n)] = static_cast<Index>(used.size());
                    used.push_back(n);
                }
                n = own[index(n)];
            }
            mesh.source_patch.push_back(patches(from == 0 && !turn_.is_full ? start_[q] : -1));
            mesh.target_patch.push_back(patches(to == layers_ && !turn_.is_full ? end_[q] : -1));
        }
        mesh.layers = to - from;
        mesh.nodes_per_layer = static_cast<Index>(used.size());
        for (int layer = from; layer <= to; ++layer) {
            check_cancelled(context_);
            for (const Index n : used) mesh.nodes.push_back(place(n, layer));
        }
        for (const mesh::BoundarySide& side : mesh::boundary_sides(mesh.quads))
            mesh.rim.push_back({side.from, side.to});
        for (int layer = from; layer < to; ++layer)
            for (const Segment& side : mesh.rim)
                mesh.wall_patch.push_back(patches(wall_of(used[index(side[0])], used[index(side[1])])));
        mesh.volume_groups = base_.mesh.volume_groups;
    }

    /// Make the wedges along one segment of the axis. Their triangles form a mesh around the axis, which is
    /// swept along it.
    void add_core(const std::vector<Strip>& chain)
    {
        Swept& part = result_.parts.emplace_back();
        mesh::HexMesh& mesh = part.mesh;
        Patches patches{base_, between(), part, {}};
        const Index around = turn_.is_full ? layers_ : layers_ + 1;
        const Index low = wall_of(chain.front().a, chain.front().above_a);
        const Index high = wall_of(chain.back().b, chain.back().above_b);
        if (low < 0) refuse_corner(quads_[chain.front().quad]);
        if (high < 0) refuse_corner(quads_[chain.back().quad]);
        for (Index k = 0; k < layers_; ++k) {
            const Index next = 1 + (k + 1) % around;
            mesh.quads.push_back({0, 1 + k, next, next});
            mesh.source_patch.push_back(patches(low));
            mesh.target_patch.push_back(patches(high));
        }
        mesh.layers = static_cast<int>(chain.size());
        mesh.nodes_per_layer = 1 + around;
        for (std::size_t j = 0; j <= chain.size(); ++j) {
            const bool last = j == chain.size();
            const Strip& strip = chain[last ? j - 1 : j];
            mesh.nodes.push_back(nodes_[index(last ? strip.b : strip.a)]);
            for (Index k = 0; k < around; ++k)
                mesh.nodes.push_back(place(last ? strip.above_b : strip.above_a, k));
        }
        for (const mesh::BoundarySide& side : mesh::boundary_sides(mesh.quads))
            mesh.rim.push_back({side.from, side.to});
        for (const Strip& strip : chain)
            for (const Segment& side : mesh.rim)
                mesh.wall_patch.push_back(patches(side[0] == 0   ? start_[strip.quad]
                                                  : side[1] == 0 ? end_[strip.quad]
                                                                 : wall_of(strip.above_a, strip.above_b)));
        mesh.volume_groups = base_.mesh.volume_groups;
    }

    /// Prove the parts. Compare their total volume with the exact volume that the source's facets sweep.
    void measure()
    {
        double exact = 0, all = 0;
        for (const FaceId face : flat_.faces(Role::source))
            for (const Triangle& t : flat_.model[face].triangles) {
                const Vec3 &a = flat_.model.at(t[0]), &b = flat_.model.at(t[1]), &c = flat_.model.at(t[2]);
                exact += (b - a).cross(c - a).dot(turn_.axis.cross((a + b + c) / 3 - turn_.point)) / 2;
            }
        exact = std::abs(exact * turn_.angle);
        for (Swept& part : result_.parts) {
            quality::Proof proof = quality::prove(part.mesh, options_.min_scaled_jacobian, context_);
            quality::require(proof);
            part.quality = std::move(proof.quality);
            part.min_scaled_jacobian = part.quality.min_scaled_jacobian;
            all += part.quality.volume;
        }
        const double half = std::abs(turn_.angle) / layers_ / 2;
        for (Swept& part : result_.parts) {
            Fidelity& shape = part.fidelity;
            shape.volume = part.quality.volume;
            shape.sealed_volume = exact * part.quality.volume / all;
            shape.max_distance = radius_ * (1 - std::cos(half));
            shape.mean_distance = shape.max_distance / 2;
        }
        std::vector<std::string>& report = result_.report;
        report.insert(report.end(), base_.report.begin(), base_.report.end());
        report.push_back(formatted("axis: {} quads of the source have a side on the axis and become wedges, "
                                   "in {} layers",
                                   strips_.size(), layers_));
        report.push_back(formatted("shape: volume {:.6g} of {:.6g} sealed, skin off by {:.2g} at most", all,
                                   exact, radius_ * (1 - std::cos(half))));
        if (std::abs(all / exact - 1) <= kVolumeNoted) return;
        report.push_back(formatted(
            "note: the mesh has {:.2g} % less volume than the sealed shape; layers = {} keep it within 1 %",
            100 * (1 - all / exact), static_cast<int>(std::ceil(std::abs(turn_.angle) / kOnePercent))));
        log_line(context_, report.back());
    }

    const AxisTurn& turn_;
    const OpenVolume& flat_;
    const Swept& base_;
    const SweepOptions& options_;
    const RunContext& context_;
    std::vector<Vec3> nodes_; ///< nodes of the source
    std::vector<Quad> quads_;
    std::vector<char> on_axis_;      ///< for each source node, whether it is on the axis
    std::vector<Index> start_, end_; ///< patch of each quad at both ends of the turn
    std::map<Segment, Index> wall_;  ///< for each side of the rim, the patch of its wall
    std::vector<std::size_t> rest_;  ///< quads away from the axis
    std::vector<Strip> strips_;
    double radius_ = 0;
    int layers_ = 0;
    SweptAssembly result_;
};

} // namespace

SweptAssembly turn_at_axis(const AxisTurn& turn, const OpenVolume& flat, const Swept& base,
                           const SweepOptions& options, const RunContext& context)
{
    return Turner(turn, flat, base, options, context).run();
}

} // namespace lacuna::sweep
