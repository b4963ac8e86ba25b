// SPDX-License-Identifier: MIT
#include <lacuna/topology/auto_roles.h>

#include <lacuna/core/error.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>

namespace lacuna::topology {

namespace {

/// Faces that meet at less than this are one patch: a skin cut in pieces, not an end and a wall [degrees].
constexpr double kSmooth = 30;
/// A reading has to be better than the next by this much to be taken without asking.
constexpr double kClear = 0.15;
/// Costs of an end that is not flat, and of having fewer ends than faces could give.
constexpr double kBent = 1.0;
constexpr double kOneEnd = 0.1;
constexpr double kNoEnd = 0.2;

struct Patch {
    std::vector<FaceId> faces;
    std::vector<Rim> rims;
    std::set<VertexId> rim_vertices;
    Vec3 normal = Vec3::Zero(); ///< unit mean
    Vec3 centre = Vec3::Zero();
    double area = 0;
    double flatness = 0; ///< length of the summed area vector over the area: 1 for a plane
};

/// Mean angle between two faces along an edge they share [degrees]; 0 where they run on smoothly.
double angle_across(const Model& model, EdgeId edge, const std::vector<FaceUse>& uses)
{
    const std::vector<Index>& points = model[edge].points;
    double sum = 0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        std::vector<Vec3> normals;
        for (const FaceUse& use : uses) {
            for (const Triangle& t : model[use.face].triangles) {
                const bool a = std::find(t.begin(), t.end(), points[i]) != t.end();
                const bool b = std::find(t.begin(), t.end(), points[i + 1]) != t.end();
                if (!a || !b) continue;
                normals.push_back((model.at(t[1]) - model.at(t[0]))
                                      .cross(model.at(t[2]) - model.at(t[0]))
                                      .stableNormalized());
                break;
            }
        }
        if (normals.size() == 2)
            sum += std::atan2(normals[0].cross(normals[1]).norm(), normals[0].dot(normals[1]));
    }
    return sum / static_cast<double>(points.size() - 1) * 180 / std::numbers::pi;
}

std::vector<Patch> patches_of(const Model& model, const std::vector<std::vector<FaceUse>>& uses)
{
    std::vector<std::size_t> root(model.faces.size());
    std::iota(root.begin(), root.end(), std::size_t{0});
    const auto find = [&](std::size_t f) {
        while (root[f] != f) f = root[f];
        return f;
    };
    for (std::size_t e = 0; e < uses.size(); ++e) {
        if (uses[e].size() != 2 || uses[e][0].face == uses[e][1].face) continue;
        if (angle_across(model, EdgeId(e), uses[e]) < kSmooth) {
            const std::size_t a = find(uses[e][0].face.index()), b = find(uses[e][1].face.index());
            root[std::max(a, b)] = std::min(a, b);
        }
    }
    std::map<std::size_t, Patch> by_root;
    for (std::size_t f = 0; f < model.faces.size(); ++f) by_root[find(f)].faces.emplace_back(f);
    std::vector<Patch> patches;
    for (auto& [key, patch] : by_root) {
        Vec3 sum = Vec3::Zero();
        for (const FaceId face : patch.faces) {
            const double area = face_area(model, face);
            patch.area += area;
            patch.centre += area * face_centroid(model, face);
            sum += face_area_vector(model, face);
        }
        patch.centre /= patch.area;
        patch.flatness = sum.norm() / patch.area;
        patch.normal = sum.stableNormalized();
        patch.rims = rims(model, patch.faces);
        for (const Rim& rim : patch.rims) {
            for (const EdgeUse& use : rim.uses) patch.rim_vertices.insert(use_from(model, use));
        }
        patches.push_back(std::move(patch));
    }
    return patches;
}

/// Number of the patch's rim that holds an edge; -1 for none.
int rim_with(const Patch& patch, EdgeId edge)
{
    for (std::size_t r = 0; r < patch.rims.size(); ++r) {
        for (const EdgeUse& use : patch.rims[r].uses) {
            if (use.edge == edge) return static_cast<int>(r);
        }
    }
    return -1;
}

class Reader {
public:
    explicit Reader(const Model& model)
        : model_(model), uses_(edge_uses(model)), patches_(patches_of(model, uses_))
    {
    }

    std::vector<RoleCandidate> all()
    {
        std::vector<RoleCandidate> found;
        const auto keep = [&](std::optional<RoleCandidate> candidate) {
            if (candidate) found.push_back(std::move(*candidate));
        };
        keep(no_end());
        for (std::size_t a = 0; a < patches_.size(); ++a) {
            keep(one_end(a));
            for (std::size_t b = a + 1; b < patches_.size(); ++b) keep(two_ends(a, b));
        }
        std::stable_sort(found.begin(), found.end(),
                         [](const RoleCandidate& x, const RoleCandidate& y) { return x.cost < y.cost; });
        return found;
    }

private:
    [[nodiscard]] std::vector<FaceId> others(std::size_t a, std::size_t b) const
    {
        std::vector<FaceId> faces;
        for (std::size_t p = 0; p < patches_.size(); ++p) {
            if (p != a && p != b)
                faces.insert(faces.end(), patches_[p].faces.begin(), patches_[p].faces.end());
        }
        return faces;
    }

    [[nodiscard]] std::set<int> rims_touched(const Patch& patch, const std::vector<FaceId>& part) const
    {
        std::set<int> touched;
        for (const FaceId face : part) {
            for (const Loop& loop : model_[face].loops) {
                for (const EdgeUse& use : loop.uses) {
                    if (const int rim = rim_with(patch, use.edge); rim >= 0) touched.insert(rim);
                }
            }
        }
        return touched;
    }

    /// Mean departure from a right angle between an end and its walls, as a share of a right angle.
    [[nodiscard]] double slant(const Patch& end) const
    {
        double sum = 0, length = 0;
        for (const Rim& rim : end.rims) {
            for (const EdgeUse& use : rim.uses) {
                if (uses_[use.edge.index()].size() != 2) continue;
                const double l = edge_length(model_, use.edge);
                sum += l * std::abs(angle_across(model_, use.edge, uses_[use.edge.index()]) - 90) / 90;
                length += l;
            }
        }
        return length > 0 ? sum / length : 0;
    }

    [[nodiscard]] static double bend(const Patch& end)
    {
        return kBent * std::min(1.0, 4 * (1 - end.flatness));
    }

    [[nodiscard]] std::string names(const std::vector<FaceId>& faces) const
    {
        std::string text;
        for (const FaceId face : faces) text += (text.empty() ? "" : ", ") + name_of(model_, face);
        return text;
    }

    [[nodiscard]] std::optional<RoleCandidate> two_ends(std::size_t a, std::size_t b) const
    {
        const Patch& s = patches_[a];
        const Patch& t = patches_[b];
        if (s.rims.empty() || s.rims.size() != t.rims.size()) return std::nullopt;
        for (const VertexId v : s.rim_vertices) {
            if (t.rim_vertices.contains(v)) return std::nullopt;
        }
        RoleCandidate candidate;
        candidate.roles = {s.faces, t.faces, others(a, b)};
        std::map<int, int> joined;
        for (const std::vector<FaceId>& part : connected_parts(model_, candidate.roles.walls)) {
            // Walls with a tunnel through them are no ring, whatever is done about what is missing.
            if (euler_number(model_, part) != 2 - static_cast<long>(rims(model_, part).size()))
                return std::nullopt;
            const std::set<int> on_s = rims_touched(s, part), on_t = rims_touched(t, part);
            if (on_s.size() != 1 || on_t.size() != 1) return std::nullopt;
            const auto [found, fresh] = joined.try_emplace(*on_s.begin(), *on_t.begin());
            if (!fresh && found->second != *on_t.begin()) return std::nullopt;
        }
        // Ends of one sweep face each other: the way between them leaves both.
        const Vec3 way = (t.centre - s.centre).stableNormalized();
        const double facing =
            1 - (std::abs(way.dot(s.normal)) * s.flatness + std::abs(way.dot(t.normal)) * t.flatness) / 2;
        const double unlike = std::abs(std::log(s.area / t.area)) / 4;
        candidate.cost = bend(s) + bend(t) + (slant(s) + slant(t)) / 2 + facing / 2 + unlike;
        candidate.reasons = {
            "two ends, " + names(s.faces) + " and " + names(t.faces) + ", with " +
                std::to_string(s.rims.size()) + (s.rims.size() == 1 ? " loop each" : " loops each") +
                " and no vertex in common",
            candidate.roles.walls.empty() ? "no faces between them"
                                          : "every other face joins a loop of one to a loop of the other"};
        return finished(std::move(candidate));
    }

    [[nodiscard]] std::optional<RoleCandidate> one_end(std::size_t a) const
    {
        const Patch& s = patches_[a];
        if (s.rims.empty()) return std::nullopt;
        for (const Rim& rim : s.rims) {
            for (const EdgeUse& use : rim.uses) {
                if (uses_[use.edge.index()].size() != 2) return std::nullopt;
            }
        }
        RoleCandidate candidate;
        candidate.roles = {s.faces, {}, others(a, a)};
        std::set<int> served;
        for (const std::vector<FaceId>& part : connected_parts(model_, candidate.roles.walls)) {
            const std::set<int> on_s = rims_touched(s, part);
            if (on_s.size() != 1 || !served.insert(*on_s.begin()).second) return std::nullopt;
            if (rims(model_, part).size() != 2 || euler_number(model_, part) != 0) return std::nullopt;
        }
        candidate.cost = kOneEnd + bend(s) + slant(s);
        candidate.reasons = {names(s.faces) + " has walls on its whole rim, and each ring of walls ends in "
                                              "one free loop: the target is missing"};
        return finished(std::move(candidate));
    }

    [[nodiscard]] std::optional<RoleCandidate> no_end() const
    {
        RoleCandidate candidate;
        candidate.roles.walls = others(patches_.size(), patches_.size());
        double cost = 0;
        const auto parts = connected_parts(model_, candidate.roles.walls);
        for (const std::vector<FaceId>& part : parts) {
            const std::vector<Rim> open = rims(model_, part);
            if (open.size() != 2 || euler_number(model_, part) != 0) return std::nullopt;
            const auto cap = cap_cost(open[0], open[1]);
            if (!cap) return std::nullopt;
            cost += *cap;
        }
        candidate.cost = kNoEnd + cost / static_cast<double>(parts.size());
        candidate.reasons = {"all faces form " + std::to_string(parts.size()) +
                             (parts.size() == 1 ? " tube" : " tubes") +
                             " with a free loop at either side: source and target are missing"};
        return finished(std::move(candidate));
    }

    /// How unlikely two free loops are as missing ends; nothing where they cannot be: one inside the other in one plane, or a cap that would
    /// only run on the face next to it.
    [[nodiscard]] std::optional<double> cap_cost(const Rim& first, const Rim& second) const
    {
        double cost = 0;
        std::vector<Vec3> centre;
        std::vector<double> size;
        for (const Rim* rim : {&first, &second}) {
            std::vector<Vec3> points;
            double length = 0;
            for (const EdgeUse& use : rim->uses) {
                const std::vector<Index> chain = use_points(model_, use);
                for (std::size_t i = 0; i + 1 < chain.size(); ++i) points.push_back(model_.at(chain[i]));
                length += edge_length(model_, use.edge);
            }
            Vec3 mean = Vec3::Zero(), area = Vec3::Zero();
            for (const Vec3& p : points) mean += p / static_cast<double>(points.size());
            for (std::size_t i = 0; i < points.size(); ++i)
                area += (points[i] - mean).cross(points[(i + 1) % points.size()] - mean) / 2;
            double bulge = 0;
            for (const Vec3& p : points)
                bulge = std::max(bulge, std::abs((p - mean).dot(area.stableNormalized())));
            cost += bulge / length;
            centre.push_back(mean);
            size.push_back(length);
            double along = 0, whole = 0;
            for (const EdgeUse& use : rim->uses) {
                const FaceId wall = uses_[use.edge.index()].front().face;
                const Vec3 normal = face_area_vector(model_, wall).stableNormalized();
                const double flat = face_area_vector(model_, wall).norm() / face_area(model_, wall);
                const double l = edge_length(model_, use.edge);
                along += l * flat * std::abs(normal.dot(area.stableNormalized()));
                whole += l;
            }
            if (along > 0.9 * whole) return std::nullopt;
        }
        if ((centre[0] - centre[1]).norm() < 1e-3 * std::max(size[0], size[1])) return std::nullopt;
        return cost;
    }

    [[nodiscard]] std::optional<RoleCandidate> finished(RoleCandidate candidate) const
    {
        try {
            const Classification found = classify(open_volume(model_, candidate.roles));
            candidate.value = found.value;
        } catch (const InvalidInput&) {
            return std::nullopt;
        }
        return candidate;
    }

    const Model& model_;
    std::vector<std::vector<FaceUse>> uses_;
    std::vector<Patch> patches_;
};

std::string in_words(const Model& model, const RoleCandidate& candidate)
{
    const auto list = [&](std::string_view role, const std::vector<FaceId>& faces) {
        std::string text;
        for (std::size_t i = 0; i < faces.size(); ++i) {
            if (i == 12) {
                text += ", …";
                break;
            }
            text += (i == 0 ? "" : ", ") + std::to_string(model[faces[i]].tag);
        }
        return faces.empty() ? std::string() : " " + std::string(role) + " = {" + text + "}";
    };
    return "class " + std::string(to_string(candidate.value)) + ":" + list("source", candidate.roles.source) +
           list("target", candidate.roles.target) + list("walls", candidate.roles.walls);
}

} // namespace

std::vector<RoleCandidate> role_candidates(const Model& model, const std::vector<FaceId>& faces)
{
    Model part = extract(model, faces);
    orient_consistently(part);
    std::vector<RoleCandidate> candidates = Reader(part).all();
    for (RoleCandidate& candidate : candidates) {
        for (std::vector<FaceId>* list :
             {&candidate.roles.source, &candidate.roles.target, &candidate.roles.walls}) {
            for (FaceId& face : *list) face = faces[face.index()];
        }
    }
    return candidates;
}

RoleCandidate find_roles(const Model& model, const std::vector<FaceId>& faces)
{
    std::vector<RoleCandidate> candidates = role_candidates(model, faces);
    if (candidates.empty()) {
        std::string tags;
        for (const FaceId face : faces) tags += (tags.empty() ? "" : ", ") + std::to_string(model[face].tag);
        throw InvalidInput("topology.no_roles",
                           "no reading of the faces " + tags +
                               " as source, target and walls of one sweep was found; name the roles: "
                               "open_volume{ source = …, target = …, walls = … }");
    }
    if (candidates.size() > 1 && candidates[1].cost - candidates[0].cost < kClear) {
        std::string text;
        for (std::size_t i = 0; i < candidates.size() && candidates[i].cost - candidates[0].cost < kClear;
             ++i) {
            text += "\n  " + in_words(model, candidates[i]);
        }
        throw InvalidInput(
            "topology.roles_ambiguous",
            "the faces can be read in several ways about as likely; name the roles of one of them:" + text);
    }
    return candidates.front();
}

} // namespace lacuna::topology
