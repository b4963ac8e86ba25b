// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/clean_patch.h>

namespace lacuna::quads::cleaning {

void PatchGrower::start(Index seed, std::size_t others)
{
    look_for_others(seed, others);
    patch_.quads.clear();
    patch_.touched.clear();
    in_patch_.clear(mesh_.net().quad_slots());
    count_.clear(mesh_.net().points());
    add_star(seed);
}

void PatchGrower::look_for_others(Index seed, std::size_t most)
{
    const QuadNet& net = mesh_.net();
    others_.clear();
    parent_.clear(net.points());
    parent_[seed] = -1;
    std::vector<Index>& queue = seen_points_;
    queue.assign(1, seed);
    for (std::size_t i = 0; i < queue.size() && others_.size() < most; ++i) {
        const Index here = queue[i];
        const auto see = [&](Index p) {
            if (parent_.has(p)) return;
            parent_[p] = here;
            queue.push_back(p);
            if (mesh_.is_irregular(p)) others_.push_back(p);
        };
        Index last = -1;
        net.for_sides(here, [&](Index side) {
            see(net.to(side));
            last = side;
        });
        // On the boundary, a point has one neighbour more than quads. At an inner point, this neighbour was
        // already visited.
        see(net.from(QuadNet::before(last)));
    }
}

bool PatchGrower::grow_to(Index other)
{
    if (count_.has(other) && count_[other] == mesh_.net().valence(other)) return false;
    for (Index p = other; p >= 0; p = parent_[p]) add_star(p);
    return true;
}

void PatchGrower::add_star(Index p)
{
    const QuadNet& net = mesh_.net();
    net.for_sides(p, [&](Index side) {
        if (!in_patch_.add(side / 4)) return;
        patch_.quads.push_back(side / 4);
        for (const Index q : net.quad(side / 4)) {
            if (!count_.has(q)) patch_.touched.push_back(q);
            ++count_[q];
        }
    });
}

PatchState PatchGrower::close(std::size_t largest)
{
    while (true) {
        if (!fill_notches(largest)) return PatchState::too_large;
        const Index pinched = link_sides();
        if (pinched < 0) return walk_outline() ? PatchState::fine : PatchState::hopeless;
        add_star(pinched);
        if (mesh_.net().on_boundary(pinched)) return PatchState::hopeless;
    }
}

/// Add quads until no point of the outline is concave. @return false if the patch would have too many quads
bool PatchGrower::fill_notches(std::size_t largest)
{
    for (bool more = true; more;) {
        more = false;
        for (std::size_t i = 0; i < patch_.touched.size(); ++i) {
            const Index p = patch_.touched[i];
            const int inside = count_[p];
            if (inside <= 2 || inside == mesh_.net().valence(p)) continue;
            add_star(p);
            more = true;
            if (patch_.quads.size() > largest) return false;
        }
    }
    return true;
}

/// Find the successor of each point on the outline. @return a point that the outline passes twice; -1 if
/// there is none
Index PatchGrower::link_sides()
{
    const QuadNet& net = mesh_.net();
    next_.clear(net.points());
    start_ = -1;
    sides_ = 0;
    for (const Index q : patch_.quads) {
        const Quad& quad = net.quad(q);
        for (std::size_t k = 0; k < 4; ++k) {
            const Index other = net.opposite(4 * q + static_cast<Index>(k));
            if (other >= 0 && in_patch_.has(other / 4)) continue;
            if (next_.has(quad[k])) return quad[k];
            next_[quad[k]] = quad[(k + 1) % 4];
            start_ = quad[k];
            ++sides_;
        }
    }
    return -1;
}

/// Order the outline and find its corners. @return false if no template fills it
bool PatchGrower::walk_outline()
{
    const QuadNet& net = mesh_.net();
    patch_.loop.clear();
    patch_.corners.clear();
    patch_.irregular = 0;
    if (start_ < 0) return false;
    Index p = start_;
    do {
        const int valence = net.valence(p), inside = count_[p], wanted = mesh_.ideal_valence(p);
        // At a point on the mesh's boundary, a filling may change the number of quads.
        const bool whole = inside == valence;
        const int corner = whole ? wanted : inside;
        if (corner > 2) return false;
        if (corner == 1) patch_.corners.push_back(patch_.loop.size());
        if (whole && valence != wanted) ++patch_.irregular;
        patch_.loop.push_back(p);
        p = next_[p];
    } while (p != start_ && patch_.loop.size() <= sides_);
    if (patch_.loop.size() != sides_) return false; // the patch has a hole
    for (const Index q : patch_.touched) {
        if (!next_.has(q) && net.valence(q) != 4) ++patch_.irregular;
    }
    return true;
}

const std::vector<Index>& PatchGrower::rings(int layers)
{
    const QuadNet& net = mesh_.net();
    rings_.clear();
    front_ = patch_.loop;
    in_rings_.clear(net.quad_slots());
    passed_.clear(net.points());
    for (int ring = 0; ring < layers; ++ring) {
        const std::size_t first = rings_.size();
        for (const Index p : front_) {
            passed_.add(p);
            net.for_sides(p, [&](Index side) {
                if (!in_patch_.has(side / 4) && in_rings_.add(side / 4)) rings_.push_back(side / 4);
            });
        }
        front_.clear();
        for (std::size_t i = first; i < rings_.size(); ++i) {
            for (const Index p : net.quad(rings_[i])) {
                if (passed_.add(p)) front_.push_back(p);
            }
        }
    }
    return rings_;
}

} // namespace lacuna::quads::cleaning
