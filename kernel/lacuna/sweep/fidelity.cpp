// SPDX-License-Identifier: MIT
#include <lacuna/sweep/fidelity.h>

#include <lacuna/core/edge_key.h>
#include <lacuna/core/error.h>
#include <lacuna/core/parallel.h>
#include <lacuna/geometry/facet_tree.h>
#include <lacuna/geometry/tips.h>
#include <lacuna/surface/face_shape.h>
#include <lacuna/sweep/detail/words.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <unordered_set>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// Distance allowed over the side of a quad, where no length is given; see FidelityOptions.
constexpr double kShareOfSide = 0.25;
/// The same on void faces: their facets were made as the mesh's walls are, and neither is given.
/// Bent, twisted
/// and ruled ones were off by up to 0.46.
constexpr double kShareOnVoid = 1;
/// A quad whose diagonals miss each other by less than this share of its longest side is flat: two triangles
/// stand for it, else four. A choice, not a measurement.
constexpr double kFlat = 1e-3;
/// Samples of a range that one thread takes: a choice, not a measurement.
constexpr std::size_t kGrain = 1024;

/// Points this near a plane lie in it, as a share of the face's extent: rounding is a thousand times less.
constexpr double kInPlane = 1e-12;

/// Tells the nodes on the border of a patch of polygons from those inside: inside, every neighbour comes
/// once before the node and once after it.
class BorderNodes {
public:
    explicit BorderNodes(std::size_t nodes) : turn_(nodes, 0) {}

    template <class Polygons>
    void set(const Polygons& polygons)
    {
        clear();
        for (const auto& polygon : polygons) {
            const std::size_t n = polygon.size();
            for (std::size_t k = 0; k < n; ++k) {
                turn_[index(polygon[k])] += polygon[(k + 1) % n] - std::int64_t{polygon[(k + n - 1) % n]};
                touched_.push_back(polygon[k]);
            }
        }
    }
    [[nodiscard]] bool has(Index node) const { return turn_[index(node)] != 0; }

private:
    void clear()
    {
        for (const Index node : touched_) turn_[index(node)] = 0;
        touched_.clear();
    }

    std::vector<std::int64_t> turn_;
    std::vector<Index> touched_;
};

/// How far a face and its quads may be apart.
struct Limit {
    double length = 0; ///< for all; 0: a share of the side
    double share = kShareOfSide;
    /// Whether quads that face the other way are folds: on sharply twisted void walls, where neither skin is
    /// given, the facet nearest to a quad may face any way.
    bool folds = true;

    [[nodiscard]] double at(double side) const { return length > 0 ? length : share * side; }
};

/// A point of one skin and how far the other is from it.
struct Sample {
    Vec3 point;
    double area = 0;            ///< that it stands for
    double side = 0;            ///< of the quads there: what is allowed goes with it
    Index quad = -1;            ///< of the patch
    Vec3 normal = Vec3::Zero(); ///< where it is to face the same way
    double distance = 0;
    bool turned = false; ///< faces the other way
};

/// The quads of one patch.
struct Patch {
    FaceId face;
    std::vector<Quad> quads;
};

double longest_side(const mesh::HexMesh& mesh, const Quad& quad)
{
    double longest = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        const Vec3 side = mesh.nodes[index(quad[(k + 1) % 4])] - mesh.nodes[index(quad[k])];
        longest = std::max(longest, side.squaredNorm());
    }
    return std::sqrt(longest);
}

/// One face and the quads on it.
class Comparison {
public:
    /// @param border  for the nodes of the mesh; its contents are overwritten.
    Comparison(const mesh::HexMesh& mesh, const Patch& patch, surface::FaceShape shape, double sign,
               const Limit& limit, BorderNodes& border)
        : mesh_(mesh),
          patch_(patch),
          shape_(std::move(shape)),
          face_tree_(shape_.points, shape_.triangles),
          flat_(find_plane()),
          sign_(sign),
          limit_(limit)
    {
        if (flat_)
            sample_flat_quads(border);
        else
            sample_quads();
        if (!flat_) {
            for (const Index p : geometry::find_tips(shape_.points, shape_.triangles))
                tips_.push_back(shape_.points[index(p)]);
        }
        build_quads(border);
    }

    FaceFidelity run(const RunContext& context)
    {
        result_.face = patch_.face;
        result_.quads = patch_.quads.size();
        take(in_plane_);
        parallel_for(context, samples_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) compare_with_face(samples_[i]);
        });
        take(samples_);
        samples_ = facet_samples();
        parallel_for(context, samples_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) compare_with_quads(samples_[i]);
        });
        take(samples_);
        if (result_.misfit == Misfit::cut) tell_straight_from_cut();
        return result_;
    }

private:
    [[nodiscard]] const Vec3& node(Index n) const { return mesh_.nodes[index(n)]; }

    /// Centres and nodes of the quads, and middles of their sides: each once, those of the patch's rim in one
    /// of the two patches there.
    void sample_quads()
    {
        std::vector<Index> nodes;
        for (std::size_t q = 0; q < patch_.quads.size(); ++q) {
            const Quad& quad = patch_.quads[q];
            const std::array<Vec3, 4> c{node(quad[0]), node(quad[1]), node(quad[2]), node(quad[3])};
            const Vec3 across = (c[2] - c[0]).cross(c[3] - c[1]) / 2;
            const double area = across.norm();
            const auto own = static_cast<Index>(q);
            double longest = 0;
            for (std::size_t k = 0; k < 4; ++k) {
                const Vec3 &a = c[k], &b = c[(k + 1) % 4];
                const double side = (b - a).norm();
                longest = std::max(longest, side);
                nodes.push_back(quad[k]);
                if (quad[k] < quad[(k + 1) % 4]) samples_.push_back({(a + b) / 2, area / 4, side, own});
            }
            const Vec3 centre = mesh::is_triangle(quad) ? Vec3((c[0] + c[1] + c[2]) / 3)
                                                        : Vec3((c[0] + c[1] + c[2] + c[3]) / 4);
            samples_.push_back({centre, area / 2, longest, own, across});
        }
        // A node by its first quad.
        std::vector<std::size_t> order(nodes.size());
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
        std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            return nodes[a] != nodes[b] ? nodes[a] < nodes[b] : a < b;
        });
        for (std::size_t i = 0; i < order.size(); ++i) {
            if (i > 0 && nodes[order[i]] == nodes[order[i - 1]]) continue;
            const std::size_t q = order[i] / 4;
            samples_.push_back(
                {node(nodes[order[i]]), 0, longest_side(mesh_, patch_.quads[q]), static_cast<Index>(q)});
        }
    }

    /// Whether the exact face lies in a plane.
    bool find_plane()
    {
        if (shape_.triangles.empty()) return false;
        Vec3 area = Vec3::Zero(), low = shape_.points.front(), high = low;
        for (const Triangle& t : shape_.triangles) {
            const Vec3& a = shape_.points[index(t[0])];
            area += (shape_.points[index(t[1])] - a).cross(shape_.points[index(t[2])] - a);
        }
        for (const Vec3& p : shape_.points) {
            low = low.cwiseMin(p);
            high = high.cwiseMax(p);
        }
        origin_ = (low + high) / 2;
        normal_ = area.stableNormalized();
        const double slack = kInPlane * ((high - low).norm() + origin_.cwiseAbs().maxCoeff());
        const auto off = [&](const Vec3& p) { return std::abs(normal_.dot(p - origin_)) > slack; };
        origin_ = shape_.points[index(shape_.triangles.front()[0])];
        if (std::any_of(shape_.points.begin(), shape_.points.end(), off)) return false;
        for (const std::array<Vec3, 3>& bulges : shape_.bulge) {
            for (const Vec3& bulge : bulges) {
                if (std::abs(normal_.dot(bulge)) > slack) return false;
            }
        }
        return true;
    }

    /// On a plane no quad that is in it and faces its way is off inside, so that only borders are compared.
    void sample_flat_quads(BorderNodes& border)
    {
        border.set(patch_.quads);
        in_plane_.reserve(patch_.quads.size());
        for (std::size_t q = 0; q < patch_.quads.size(); ++q) {
            const Quad& quad = patch_.quads[q];
            const std::array<Vec3, 4> c{node(quad[0]), node(quad[1]), node(quad[2]), node(quad[3])};
            const Vec3 across = (c[2] - c[0]).cross(c[3] - c[1]) / 2;
            const auto own = static_cast<Index>(q);
            Sample sample{c[0], across.norm(), 0, own, across};
            sample.turned = limit_.folds && sign_ * across.dot(normal_) < 0;
            for (std::size_t k = 0; k < 4; ++k) {
                const double off = std::abs(normal_.dot(c[k] - origin_));
                sample.side = std::max(sample.side, (c[(k + 1) % 4] - c[k]).squaredNorm());
                if (off <= sample.distance) continue;
                sample.distance = off;
                sample.point = c[k];
            }
            sample.side = std::sqrt(sample.side);
            in_plane_.push_back(sample);
            for (std::size_t k = 0; k < 4; ++k) {
                const Index next = quad[(k + 1) % 4];
                if (!mesh::is_side(quad, k)) continue;
                if (!border.has(quad[k])) continue;
                samples_.push_back({c[k], 0, sample.side, own});
                if (!border.has(next)) continue;
                samples_.push_back({(c[k] + c[(k + 1) % 4]) / 2, 0, (c[(k + 1) % 4] - c[k]).norm(), own});
            }
        }
    }

    void build_quads(const BorderNodes& border)
    {
        std::vector<Vec3> points;
        std::vector<Triangle> triangles;
        const auto inside = [&](const Quad& quad) {
            return std::none_of(quad.begin(), quad.end(), [&](Index n) { return border.has(n); });
        };
        for (std::size_t q = 0; q < patch_.quads.size(); ++q) {
            if (flat_ && inside(patch_.quads[q])) continue;
            const auto first = static_cast<Index>(points.size());
            for (const Index n : patch_.quads[q]) points.push_back(node(n));
            const Vec3* c = &points[index(first)];
            const Vec3 one = (c[0] + c[2]) / 2, other = (c[1] + c[3]) / 2;
            if (mesh::is_triangle(patch_.quads[q])) {
                triangles.push_back({first, first + 1, first + 2});
            } else if ((one - other).norm() < kFlat * (c[2] - c[0]).norm()) {
                triangles.push_back({first, first + 1, first + 2});
                triangles.push_back({first, first + 2, first + 3});
            } else {
                points.push_back((one + other) / 2);
                for (Index k = 0; k < 4; ++k)
                    triangles.push_back({first + k, first + (k + 1) % 4, first + 4});
            }
            quad_of_.resize(triangles.size(), static_cast<Index>(q));
        }
        quad_tree_ = geometry::FacetTree(points, triangles);
    }

    /// Corners of the facets, and middles of sides and centres on the exact face.
    [[nodiscard]] std::vector<Sample> facet_samples() const
    {
        std::vector<Sample> samples;
        if (flat_) return border_samples();
        for (const Vec3& p : shape_.points) samples.push_back({p});
        for (std::size_t i = 0; i < shape_.triangles.size(); ++i) {
            const Triangle& t = shape_.triangles[i];
            const std::array<Vec3, 3> c{shape_.points[index(t[0])], shape_.points[index(t[1])],
                                        shape_.points[index(t[2])]};
            const double area = (c[1] - c[0]).cross(c[2] - c[0]).norm() / 2;
            for (const Vec3& w :
                 {Vec3(1. / 3, 1. / 3, 1. / 3), Vec3(.5, .5, 0), Vec3(0, .5, .5), Vec3(.5, 0, .5)}) {
                const Vec3 flat = w[0] * c[0] + w[1] * c[1] + w[2] * c[2];
                samples.push_back({flat + shape_.bulge_at(i, w), area / 4});
            }
        }
        return samples;
    }

    /// Points on the border of the face, and middles of sides there, on the exact face.
    [[nodiscard]] std::vector<Sample> border_samples() const
    {
        std::unordered_set<std::uint64_t> sides;
        for (const Triangle& t : shape_.triangles) {
            for (std::size_t k = 0; k < 3; ++k) sides.insert(directed_key(t[k], t[(k + 1) % 3]));
        }
        std::vector<Sample> samples;
        for (std::size_t i = 0; i < shape_.triangles.size(); ++i) {
            const Triangle& t = shape_.triangles[i];
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t next = (k + 1) % 3;
                if (sides.contains(directed_key(t[next], t[k]))) continue;
                Vec3 w = Vec3::Zero();
                w[static_cast<Eigen::Index>(k)] = w[static_cast<Eigen::Index>(next)] = 0.5;
                const Vec3 &from = shape_.points[index(t[k])], &to = shape_.points[index(t[next])];
                samples.push_back({from});
                samples.push_back({(from + to) / 2 + shape_.bulge_at(i, w)});
            }
        }
        return samples;
    }

    /// How far a place is from the face; `facet` gets the one it is nearest to.
    [[nodiscard]] double distance_to_face(const Vec3& point, std::size_t& facet) const
    {
        const auto hit = face_tree_.closest(point);
        facet = index(hit.triangle);
        Vec3 bulge = shape_.bulge_at(facet, hit.barycentric);
        // Beside the face its exact edge counts; over it only how high it bulges.
        if (hit.barycentric.minCoeff() > 0) {
            const Vec3 normal = shape_.normal(facet);
            bulge = bulge.dot(normal) * normal;
        }
        return (point - hit.point - bulge).norm();
    }

    void compare_with_face(Sample& sample) const
    {
        std::size_t facet = 0;
        sample.distance = distance_to_face(sample.point, facet);
        // Far off, as the middle of a long quad on a bend is, the nearest facet may be one across the face.
        constexpr double kNear = 0.1; // of the quad's width; a choice, not a measurement
        sample.turned = limit_.folds && sample.distance * sample.side < kNear * sample.normal.norm() &&
                        sign_ * sample.normal.dot(shape_.normal(facet)) < 0;
    }

    void compare_with_quads(Sample& sample) const
    {
        const auto hit = quad_tree_.closest(sample.point);
        sample.quad = quad_of_[index(hit.triangle)];
        sample.side = longest_side(mesh_, patch_.quads[index(sample.quad)]);
        sample.distance = std::sqrt(hit.distance2);
    }

    /// Round a tip four quads are as many as can be, however small: there a side is allowed.
    [[nodiscard]] double allowed(const Sample& sample) const
    {
        constexpr double kReach = 2; // sides from the tip; a choice, not a measurement
        const bool at_tip = limit_.length == 0 &&
                            std::any_of(tips_.begin(), tips_.end(), [&](const Vec3& tip) {
                                return (sample.point - tip).norm() < kReach * sample.side;
                            });
        return (at_tip ? kShareOnVoid * sample.side : limit_.at(sample.side)) + shape_.slack;
    }

    void take(const std::vector<Sample>& samples)
    {
        double area = 0, sum = 0;
        for (const Sample& sample : samples) {
            area += sample.area;
            sum += sample.area * sample.distance;
            if (sample.distance > result_.max_distance) {
                result_.max_distance = sample.distance;
                result_.place = sample.point;
            }
            const double most = allowed(sample);
            const bool worse = sample.distance * result_.allowed > result_.found * most;
            if (result_.misfit != Misfit::folded && (worse || result_.allowed == 0)) {
                set_found(sample, most);
                if (sample.distance > most) result_.misfit = Misfit::cut;
            }
            if (sample.turned && result_.misfit != Misfit::folded) {
                set_found(sample, most);
                result_.misfit = Misfit::folded;
            }
        }
        if (area > 0) result_.mean_distance = std::max(result_.mean_distance, sum / area);
    }

    void set_found(const Sample& sample, double most)
    {
        result_.found = sample.distance;
        result_.allowed = most;
        result_.found_at = sample.point;
        result_.side = sample.side;
        worst_ = sample.quad;
    }

    /// Where a quad's nodes are on the face, the face bends away between them.
    void tell_straight_from_cut()
    {
        constexpr double kOnFace = 0.25; // of the distance found; a choice, not a measurement
        const Quad& quad = patch_.quads[index(worst_)];
        std::size_t facet = 0;
        double most = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            const Vec3 &a = node(quad[k]), &b = node(quad[(k + 1) % 4]);
            if (distance_to_face(a, facet) > kOnFace * result_.found) return;
            const double sag = distance_to_face((a + b) / 2, facet);
            if (sag <= most) continue;
            most = sag;
            result_.side = (b - a).norm();
            result_.source_side = (node(quad[(k + 1) % 4] % mesh_.nodes_per_layer) -
                                   node(quad[k] % mesh_.nodes_per_layer))
                                      .norm();
            result_.along_layers = quad[k] / mesh_.nodes_per_layer !=
                                   quad[(k + 1) % 4] / mesh_.nodes_per_layer;
        }
        if (2 * most >= result_.found) result_.misfit = Misfit::straight;
    }

    const mesh::HexMesh& mesh_;
    const Patch& patch_;
    surface::FaceShape shape_;
    geometry::FacetTree face_tree_, quad_tree_;
    std::vector<Index> quad_of_; ///< of each triangle in `quad_tree_`
    std::vector<Vec3> tips_;
    std::vector<Sample> samples_;
    std::vector<Sample> in_plane_; ///< of a flat face: a quad each, compared with the plane
    Vec3 origin_ = Vec3::Zero(), normal_ = Vec3::Zero(); ///< of that plane
    bool flat_ = false;
    double sign_;
    Limit limit_;
    FaceFidelity result_;
    Index worst_ = -1;
};

/// The quads of every face, by its number in the model.
std::vector<Patch> patches_of(const Model& model, const mesh::HexMesh& mesh, const std::vector<FaceId>& faces)
{
    std::vector<Patch> patches(model.faces.size());
    for (std::size_t f = 0; f < patches.size(); ++f) patches[f].face = FaceId(f);
    for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
        const mesh::SkinQuad quad = mesh::skin_quad(mesh, i);
        patches[faces[index(quad.patch)].index()].quads.push_back(quad.nodes);
    }
    return patches;
}

/// A size for the facets of a face: the mean side of its quads.
double mean_side(const mesh::HexMesh& mesh, const Patch& patch)
{
    double sum = 0;
    for (const Quad& quad : patch.quads) sum += longest_side(mesh, quad);
    return sum / static_cast<double>(patch.quads.size());
}

/// A face the skin leaves out.
FaceFidelity left_out(const Model& model, const mesh::HexMesh& mesh, FaceId face, const Limit& limit)
{
    FaceFidelity result;
    result.face = face;
    result.place = result.found_at = face_centroid(model, face);
    double rim = 0;
    for (const Loop& loop : model[face].loops) {
        for (const EdgeUse& use : loop.uses) rim += edge_length(model, use.edge);
    }
    const double width = rim > 0 ? 2 * face_area(model, face) / rim : 0;
    result.max_distance = result.mean_distance = result.found = width;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
        const Quad quad = mesh::skin_quad(mesh, i).nodes;
        const double distance = (mesh.nodes[index(quad[0])] - result.place).squaredNorm();
        if (distance >= nearest) continue;
        nearest = distance;
        result.side = longest_side(mesh, quad);
    }
    result.allowed = limit.at(result.side);
    if (width > result.allowed) result.misfit = Misfit::no_quads;
    return result;
}

std::string at_place(const Vec3& p)
{
    std::array<char, 96> words{};
    std::snprintf(words.data(), words.size(), "(%.4g, %.4g, %.4g)", p.x(), p.y(), p.z());
    return words.data();
}

/// A length a little below `value`, in two digits.
std::string rounded_down(double value)
{
    const double step = std::pow(10, std::floor(std::log10(value)) - 1);
    return in_short(std::floor(value / step) * step);
}

std::string more_of_it(const FaceFidelity& face, int layers, bool length_given)
{
    // The sag of a straight side grows with the square of its length, its share of the side with the length.
    // What is named is a tenth below that: sides differ a little.
    constexpr double kBelow = 0.9;
    const double share = kBelow * face.allowed / face.found;
    const double by = length_given ? std::sqrt(share) : share;
    if (face.along_layers) {
        return "The face bends there from layer to layer: by the sag of straight sides " +
               std::to_string(static_cast<int>(std::ceil(layers / by))) + " layers would do instead of " +
               std::to_string(layers);
    }
    return "The face bends there and a side of " + in_short(face.side) +
           " cannot follow: by the sag of straight sides a size of " + rounded_down(face.source_side * by) +
           " would do";
}

} // namespace

Fidelity compare(const OpenVolume& volume, const mesh::HexMesh& mesh, const std::vector<FaceId>& faces,
                 const std::set<FaceId>& kept, double volume_of_mesh, const FidelityOptions& options,
                 const RunContext& context)
{
    const Model& model = volume.model;
    Fidelity result;
    result.volume = volume_of_mesh;
    const std::vector<Patch> patches = patches_of(model, mesh, faces);
    const Vec3 origin = mesh.nodes.front();
    std::vector<surface::FaceShape> shapes;
    for (const Patch& patch : patches) {
        check_cancelled(context);
        const double side = patch.quads.empty() ? std::numeric_limits<double>::infinity()
                                                : mean_side(mesh, patch);
        shapes.push_back(surface::face_shape(model, patch.face, [side](const Vec3&) { return side; }));
        result.sealed_volume += shapes.back().volume_integral(origin);
    }
    const double sign = result.sealed_volume < 0 ? -1 : 1;
    result.sealed_volume *= sign;
    double area = 0;
    BorderNodes border(mesh.nodes.size());
    for (const Patch& patch : patches) {
        FaceFidelity face;
        face.face = patch.face;
        face.quads = patch.quads.size();
        const bool made_void = model[patch.face].origin == Origin::made_void;
        const Limit limit{options.max_deviation, made_void ? kShareOnVoid : kShareOfSide, !made_void};
        if (patch.quads.empty()) {
            face = left_out(model, mesh, patch.face, limit);
        } else if (!kept.contains(patch.face)) {
            face = Comparison(mesh, patch, std::move(shapes[patch.face.index()]), sign, limit, border)
                       .run(context);
        }
        face.name = name_of(model, patch.face);
        face.tag = model[patch.face].tag;
        face.made_void = made_void;
        const double own = face_area(model, patch.face);
        result.max_distance = std::max(result.max_distance, face.max_distance);
        result.mean_distance += own * face.mean_distance;
        area += own;
        result.faces.push_back(face);
    }
    if (area > 0) result.mean_distance /= area;
    return result;
}

void require(const Fidelity& fidelity, int layers, const FidelityOptions& options)
{
    const FaceFidelity* worst = nullptr;
    for (const FaceFidelity& face : fidelity.faces) {
        if (face.misfit == Misfit::none) continue;
        if (worst == nullptr || face.found * worst->allowed > worst->found * face.allowed) worst = &face;
    }
    if (worst == nullptr) return;
    const bool given = options.max_deviation > 0;
    const std::string limit = in_short(worst->allowed) + (given ? " (max_deviation)"
                                                          : worst->made_void
                                                              ? ", a quad's side there"
                                                              : ", a quarter of a quad's side there");
    const std::string name = worst->name, place = at_place(worst->found_at);
    std::string message;
    switch (worst->misfit) {
    case Misfit::no_quads:
        message = "the mesh leaves out " + name + ", about " + in_short(worst->found) + " wide, at " + place +
                  ": no quad of its skin lies on it, and only faces up to " + limit +
                  ", may be left out. The sides of quads there are " + in_short(worst->side) + " long";
        break;
    case Misfit::folded:
        message = "the skin of the mesh folds over on " + name + ": a quad at " + place +
                  " faces into the volume";
        break;
    case Misfit::straight:
        message = name + ": the skin of the mesh is " + in_short(worst->found) + " off it at " + place +
                  ", more than " + limit + ". " + more_of_it(*worst, layers, given);
        break;
    case Misfit::cut:
    case Misfit::none:
        message = name + ": the skin of the mesh is " + in_short(worst->found) + " off it at " + place +
                  ", more than " + limit +
                  ". The quads there run across an edge of the face; the sides of the largest are " +
                  in_short(worst->side) + " long";
        break;
    }
    throw NotSweepable("sweep.deviation", message);
}

std::string in_words(const Fidelity& fidelity)
{
    std::array<char, 200> words{};
    std::snprintf(words.data(), words.size(),
                  "shape: volume %.6g of %.6g sealed (%+.2f %%), skin off by %.2g at most, %.2g on average",
                  fidelity.volume, fidelity.sealed_volume,
                  100 * (fidelity.volume / fidelity.sealed_volume - 1), fidelity.max_distance,
                  fidelity.mean_distance);
    const auto worst = std::max_element(
        fidelity.faces.begin(), fidelity.faces.end(),
        [](const FaceFidelity& a, const FaceFidelity& b) { return a.max_distance < b.max_distance; });
    std::string line = words.data();
    const double rounding = 1e-9 * std::cbrt(std::abs(fidelity.sealed_volume));
    if (worst != fidelity.faces.end() && worst->max_distance > rounding)
        line += "; most on " + worst->name + " at " + at_place(worst->place);
    return line;
}

} // namespace lacuna::sweep
