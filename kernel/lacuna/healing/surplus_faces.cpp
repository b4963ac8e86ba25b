// SPDX-License-Identifier: MIT
#include <lacuna/healing/detail/surplus_faces.h>

#include <lacuna/core/shared/limits.h>
#include <lacuna/healing/detail/coincident_faces.h>
#include <lacuna/healing/detail/edge_track.h>
#include <lacuna/topology/open_volume.h>

#include <algorithm>
#include <map>
#include <set>

namespace lacuna::healing {

namespace {

void leave_out_copies(LooseModel& loose, StitchReport& report, const std::vector<FaceId>& alike,
                      const std::vector<int>& class_of, const std::vector<std::vector<EdgeId>>& edges)
{
    const topology::Model& model = loose.model();
    const int own = class_of[alike.front().index()];
    std::size_t stay = 1;
    for (const EdgeId e : edges[alike.front().index()]) {
        std::set<int> others;
        for (const FaceId f : loose.users(e))
            if (class_of[f.index()] != own) others.insert(class_of[f.index()]);
        if (others.size() > 1) stay = 2; // two are needed: each is connected to another face
    }
    const auto worth = [&](FaceId f) {
        return (model[f].given_quads.empty() || !model[f].keeps_nodes ? 0 : 2) + (model[f].surface ? 1 : 0);
    };
    std::vector<FaceId> order = alike;
    std::stable_sort(order.begin(), order.end(), [&](FaceId a, FaceId b) { return worth(a) > worth(b); });
    for (std::size_t i = stay; i < order.size(); ++i) {
        report.notes.push_back(
            {"healing.repeated_face",
             "{0} lies on {1} everywhere: the face is listed twice, and naming {0} names {1}",
             entity_of(model, order[i]), entity_of(model, order[0])});
        ++report.faces_left_out;
        loose.remove_repeated(order[i], order[0]);
    }
}

} // namespace

Message thin_face_note(const topology::Model& model, FaceId face, double tolerance)
{
    return Message("healing.thin_face", "{} is no wider than the tolerance of {:.3g} and is left out",
                   entity_of(model, face), tolerance)
        .remedy("give a smaller tolerance to keep it");
}

void leave_out_thin_faces(LooseModel& loose, double tolerance, StitchReport& report)
{
    const topology::Model& model = loose.model();
    const std::vector<std::vector<EdgeId>> edges = loose.edges_of_faces();
    for (std::size_t f = 0; f < edges.size(); ++f) {
        const FaceId face(f);
        if (loose.is_gone(face) || edges[f].empty()) continue;
        std::map<EdgeId, int> uses;
        double border = 0;
        for (const EdgeId e : edges[f]) {
            ++uses[e];
            border += topology::edge_length(model, e);
        }
        const bool folded = std::all_of(uses.begin(), uses.end(),
                                        [](const auto& use) { return use.second % 2 == 0; });
        const bool empty = model[face].triangles.empty();
        if (!empty && (!folded || topology::face_area(model, face) > tolerance * border)) continue;
        report.notes.push_back(thin_face_note(model, face, tolerance));
        ++report.faces_left_out;
        loose.remove(face);
    }
}

void leave_out_repeated_faces(LooseModel& loose, double tolerance, StitchReport& report,
                              const RunContext& context)
{
    const topology::Model& model = loose.model();
    const std::vector<std::vector<EdgeId>> edges = loose.edges_of_faces();
    std::map<std::vector<EdgeId>, std::vector<FaceId>> by_border;
    for (std::size_t f = 0; f < edges.size(); ++f)
        if (!loose.is_gone(FaceId(f))) by_border[edges[f]].emplace_back(f);
    // Many faces may have no border, such as spheres. A comparison of boxes excludes most pairs. The boxes of
    // two coincident faces with different facets differ by far less than a tenth.
    std::map<FaceId, Eigen::AlignedBox3d> boxes;
    const auto box_of = [&](FaceId f) -> const Eigen::AlignedBox3d& {
        auto [box, fresh] = boxes.try_emplace(f);
        if (!fresh) return box->second;
        for (const Triangle& t : model[f].triangles)
            for (const Index p : t) box->second.extend(model.at(p));
        return box->second;
    };
    const auto same_box = [&](FaceId a, FaceId b) {
        const auto& of_a = box_of(a);
        const auto& of_b = box_of(b);
        const double apart = std::max((of_a.min() - of_b.min()).norm(), (of_a.max() - of_b.max()).norm());
        return apart <= tolerance + of_a.diagonal().norm() / 10;
    };
    // Class: a set of coincident faces.
    std::vector<int> class_of(edges.size(), -1);
    std::vector<std::vector<FaceId>> classes;
    for (std::size_t f = 0; f < edges.size(); ++f) {
        if (loose.is_gone(FaceId(f)) || class_of[f] >= 0) continue;
        class_of[f] = static_cast<int>(classes.size());
        classes.push_back({FaceId(f)});
        const std::vector<FaceId>& rivals = by_border[edges[f]];
        if (rivals.size() < 2) continue;
        for (const FaceId other : rivals) {
            if (class_of[other.index()] >= 0 || !same_box(FaceId(f), other)) continue;
            if (!faces_coincide(model, model.faces[f], model[other], tolerance, context)) continue;
            class_of[other.index()] = class_of[f];
            classes.back().push_back(other);
        }
    }
    for (const std::vector<FaceId>& alike : classes)
        if (alike.size() > 1) leave_out_copies(loose, report, alike, class_of, edges);
}

void note_gaps(const LooseModel& loose, double tolerance, StitchReport& report, const RunContext& context)
{
    const topology::Model& model = loose.model();
    std::map<std::pair<VertexId, VertexId>, std::vector<EdgeId>> groups;
    for (std::size_t e = 0; e < model.edges.size(); ++e) {
        const topology::Edge& edge = model.edges[e];
        if (loose.is_free(EdgeId(e)) && edge.from != edge.to)
            groups[std::minmax(edge.from, edge.to)].emplace_back(e);
    }
    for (const auto& [ends, group] : groups) {
        for (std::size_t i = 0; i < group.size(); ++i) {
            for (std::size_t k = i + 1; k < group.size(); ++k) {
                check_cancelled(context);
                const EdgeTrack a(model, group[i], context);
                const EdgeTrack b(model, group[k], context);
                const double gap = greatest_gap(a, b, tolerance, context);
                if (gap <= tolerance || gap > kOnePoint * std::min(a.length(), b.length())) continue;
                report.notes.push_back(
                    Message("healing.gap",
                            "{} of {} and {} of {} have the same ends and a gap of {:.3g}, more than the "
                            "tolerance of {:.3g}",
                            NamedEntity{"edge", model[group[i]].tag},
                            entity_of(model, loose.users(group[i])[0]),
                            NamedEntity{"edge", model[group[k]].tag},
                            entity_of(model, loose.users(group[k])[0]), found(gap), needed(tolerance))
                        .remedy("give a larger tolerance to close it"));
            }
        }
    }
}

} // namespace lacuna::healing
