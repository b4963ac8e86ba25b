// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/mesh_deck.h>

#include <lacuna/core/shared/constants.h>
#include <lacuna/io/detail/deck_builder.h>
#include <lacuna/io/detail/deck_writer.h>
#include <lacuna/io/detail/texts.h>

#include <algorithm>

namespace lacuna::io {

bool SetAdder::is_emptied(const std::string& name) const
{
    return find_word(deck_.gap.names, name) != deck_.gap.names.end();
}

const DeckSet& SetAdder::add(DeckSet& set, const std::string& group, const std::string& wanted)
{
    tidy(set);
    const auto put = [&](DeckSet& into) -> const DeckSet& {
        const bool rises = into.sides.empty() && set.sides.empty() &&
                           (into.members.empty() || set.members.empty() ||
                            into.members.back() < set.members.front());
        into.members.insert(into.members.end(), set.members.begin(), set.members.end());
        into.sides.insert(into.sides.end(), set.sides.begin(), set.sides.end());
        if (!rises) tidy(into);
        into.listed |= set.listed;
        return into;
    };
    GroupSets own;
    const auto [known, fresh] =
        (added_.before ? added_.before->sets : own).try_emplace({set.kind, group}, deck_.sets.size());
    if (!fresh) return put(deck_.sets[known->second]);
    const auto find = [&](const std::string& name) {
        const std::vector<std::size_t>& named = names().sets[upper(name)];
        const auto at = std::ranges::find_if(named, [&](std::size_t s) {
            const DeckSet& other = deck_.sets[s];
            if (other.kind != set.kind) return false;
            const bool none = other.members.empty() && other.sides.empty();
            // If the deck does not store cells, the set of all cells of a mesh is empty. It is recognised
            // by being empty and created by this mesh.
            if (none && added_.bulk != nullptr) return set.members.empty() && s >= first_set_;
            return none ? is_emptied(name) : other.members == set.members && other.sides == set.sides;
        });
        return at == named.end() ? kNoIndex : *at;
    };
    set.name = free_name(wanted, format_, [&](const std::string& name) {
        return find(name) == kNoIndex && is_taken(set.kind, name);
    });
    constexpr const char* kKinds[] = {"nodes", "elements", "sides"}; // in the order of DeckSet::Kind
    const bool behind = format_ == DeckFormat::abaqus && group.ends_with(kSkin);
    if (!behind && set.name != free_name(wanted, format_, [](const auto&) { return false; }))
        renamed_.emplace(formatted("its set of {} {}", kKinds[static_cast<int>(set.kind)], wanted), set.name);
    if (const std::size_t same = find(set.name); same != kNoIndex) {
        known->second = same;
        deck_.gap.replaced[{deck_.sets[same].kind, deck_.sets[same].name}] = 1;
        return put(deck_.sets[same]);
    }
    set.tag = names().highest_tag + 1;
    return deck_.sets.emplace_back(std::move(set));
}

SetNames& SetAdder::names()
{
    SetNames& names = added_.before ? added_.before->names : names_;
    for (; names.counted < deck_.sets.size(); ++names.counted) {
        const DeckSet& set = deck_.sets[names.counted];
        names.sets[upper(set.name)].push_back(names.counted);
        names.highest_tag = std::max(names.highest_tag, set.tag);
    }
    return names;
}

bool SetAdder::is_taken(DeckSet::Kind kind, const std::string& name)
{
    if (kind != DeckSet::Kind::nodes && find_word(surfaces_, name) != surfaces_.end()) return true;
    return std::ranges::any_of(names().sets[upper(name)],
                               [&](std::size_t s) { return share_names(format_, kind, deck_.sets[s].kind); });
}

void SetAdder::tell_names(const std::string& volume, const RunContext& context) const
{
    std::vector<std::string> names;
    for (const auto& [own, name] : renamed_) names.push_back(formatted("{} is called {}", own, name));
    if (!names.empty())
        log_line(context, formatted("note: {}: renamed, because other sets have these names: {}", volume,
                                    listed(names)));
}

} // namespace lacuna::io
