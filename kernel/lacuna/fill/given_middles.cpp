// SPDX-License-Identifier: MIT
#include <lacuna/fill/detail/members.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/io/shared/deck_middles.h>

#include <array>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace lacuna::fill {

namespace {

/// The decks that the faces of a volume came from. Their ownership is shared, because a sweep that creates
/// its layers later may outlive its volume.
struct GivenMiddles {
    std::vector<std::shared_ptr<const io::Deck>> decks;
    double tolerance = 0, scale = 1;

    /// The nodes that `ask(deck)` finds; the first deck with a node at a place supplies it.
    template <class Ask>
    std::vector<Vec3> find(std::size_t count, const Ask& ask) const
    {
        std::vector<Vec3> found(count, Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
        for (const auto& deck : decks) {
            const std::vector<Vec3> own = ask(*deck);
            for (std::size_t i = 0; i < found.size(); ++i)
                if (!found[i].allFinite()) found[i] = own[i];
        }
        return found;
    }
};

} // namespace

void keep_given_middles(const Volume& volume, sweep::SecondOrderOptions& options)
{
    if (volume.decks.empty()) return;
    const GivenMiddles given{volume.decks, kSamePlace * volume.volume.model.diagonal, volume.scale};
    options.given = [given](std::span<const Vec3> from, std::span<const Vec3> to) {
        return given.find(from.size(), [&](const io::Deck& deck) {
            return io::middles_between(deck, from, to, given.tolerance, given.scale);
        });
    };
    options.given_centres = [given](std::span<const std::array<Vec3, 4>> quads) {
        return given.find(quads.size(), [&](const io::Deck& deck) {
            return io::centres_of(deck, quads, given.tolerance, given.scale);
        });
    };
}

} // namespace lacuna::fill
