// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/abaqus.h>

#include <algorithm>
#include <limits>

namespace lacuna::io {
namespace {

/// If there are no sections and *ELEMENT names no set, the element sets become the regions, provided each
/// element is in exactly one of them. Other programs convert regions to such sets.
void take_sets_for_sections(AbaqusPart& scope)
{
    const Deck& deck = scope.builder.deck();
    if (std::ranges::find(deck.regions, scope.name, &DeckRegion::name) == deck.regions.end()) return;
    std::vector<AbaqusPart::Section> sections;
    std::vector<DeckTag> members, tags = element_tags(deck);
    for (const DeckSet& set : deck.sets) {
        if (set.kind != DeckSet::Kind::elements) continue;
        sections.push_back({set.name, "", set.members});
        members.insert(members.end(), set.members.begin(), set.members.end());
    }
    if (members.size() != tags.size()) return;
    std::ranges::sort(tags);
    std::ranges::sort(members);
    if (members == tags) scope.sections = std::move(sections);
}

/// Index of the region named after an element set. It exists if an *ELEMENT line names the set; otherwise
/// it is added.
Index region_called(AbaqusPart& scope, const std::string& name)
{
    const std::vector<DeckRegion>& all = scope.builder.deck().regions;
    const auto found = find_word(all, name, &DeckRegion::name);
    return found == all.end() ? scope.builder.add_region(0, name) : static_cast<Index>(found - all.begin());
}

} // namespace

AbaqusParts::AbaqusParts(const Cursor& main, DeckBuilder& into, const DeckFiles& files)
    : main_(main), into_(into), files_(files)
{
    parts_.push_back(std::make_unique<AbaqusPart>());
}

AbaqusPart& AbaqusParts::add(const std::string& name)
{
    parts_.push_back(std::make_unique<AbaqusPart>());
    parts_.back()->name = name;
    return *parts_.back();
}

AbaqusPart* AbaqusParts::find(std::string_view name) const
{
    const auto found = std::find_if(parts_.begin() + 1, parts_.end(),
                                    [&](const auto& part) { return same_word(part->name, name); });
    return found == parts_.end() ? nullptr : found->get();
}

void AbaqusParts::spend(std::size_t count, const DeckPlace& place)
{
    if (count > budget_)
        place.fail("ranges, sets and instances generate too many entries for a file of this size");
    budget_ -= count;
}

/// Assign regions by the sections, and replace node tags by indices.
void AbaqusParts::finish_part(AbaqusPart& scope)
{
    if (std::exchange(scope.is_finished, true)) return;
    Deck& deck = scope.builder.deck();
    for (DeckSet& set : deck.sets) tidy(set);
    const TagPlaces nodes(deck.point_tags, [&](Index, Index second) {
        main_.fail("{}{} is defined twice", scope.name.empty() ? "" : formatted("part {}: ", scope.name),
                   numbered("node", deck.point_tags[index(second)]));
    });
    scope.builder.resolve(nodes,
                          [&](std::uint64_t place, const Message& why) { files_.place_of(place).fail(why); });
    if (scope.sections.empty()) take_sets_for_sections(scope);
    if (scope.sections.empty()) return;
    const std::vector<DeckTag> tags = element_tags(deck);
    std::vector<Index*> regions;
    for (DeckBlock& block : deck.blocks)
        for (Index& region : block.regions) regions.push_back(&region);
    const TagPlaces elements(tags);
    for (const AbaqusPart::Section& section : scope.sections) {
        const Index region = region_called(scope, section.name);
        deck.regions[index(region)].material = section.material;
        for (const DeckTag tag : section.members)
            if (const Index e = elements.find(tag); e >= 0) *regions[index(e)] = region;
    }
}

void AbaqusParts::place(AbaqusPart& scope, const std::string& name, const Eigen::Isometry3d* to,
                        const DeckPlace& place)
{
    finish_part(scope);
    const Deck& part = scope.builder.deck();
    Deck& deck = into_.deck();
    const auto extend = [](std::pair<DeckTag, DeckTag>& range, const std::vector<DeckTag>& tags) {
        for (const DeckTag tag : tags) range = {std::min(range.first, tag), std::max(range.second, tag)};
    };
    std::pair<DeckTag, DeckTag> own{std::numeric_limits<DeckTag>::max(), -1};
    extend(own, part.point_tags);
    for (const DeckBlock& block : part.blocks) extend(own, block.tags);
    spend(part.points.size() + part.element_count(), place);
    for (const DeckSet& of : part.sets) spend(of.members.size() + of.sides.size() + 1, place);
    const DeckTag offset = own.first <= highest_ ? highest_ : 0;
    highest_ = std::max(highest_, own.second + offset);
    const auto first = static_cast<Index>(deck.points.size());
    deck.instances.push_back({name, scope.name, deck.points.size(), part.points.size(), offset});
    for (std::size_t p = 0; p < part.points.size(); ++p) {
        deck.points.push_back(to != nullptr ? Vec3(*to * part.points[p]) : part.points[p]);
        if (!deck.points.back().allFinite())
            main_.fail("instance {}: coordinates of a node are too large", name);
        deck.point_tags.push_back(part.point_tags[p] + offset);
    }
    const auto first_region = static_cast<Index>(deck.regions.size());
    for (DeckRegion region : part.regions) {
        region.part = name;
        deck.regions.push_back(std::move(region));
    }
    for (const DeckBlock& block : part.blocks) {
        const std::size_t to_block = into_.block_of(block.shape, block.type);
        append_block(block, first, first_region, offset, deck.blocks[to_block]);
    }
    for (const DeckSet& set : part.sets) {
        raise_numbers(deck.sets.emplace_back(set), offset, offset);
        set_instance_.push_back(static_cast<Index>(deck.instances.size()) - 1);
    }
}

void AbaqusParts::finish(const DeckPlace& at)
{
    AbaqusPart& global = outside();
    Deck& deck = into_.deck();
    if (parts_.size() == 1) {
        finish_part(global);
        Deck& whole = global.builder.deck();
        deck.points = std::move(whole.points);
        deck.point_tags = std::move(whole.point_tags);
        deck.blocks = std::move(whole.blocks);
        deck.regions = std::move(whole.regions);
        deck.sets = std::move(whole.sets);
    } else {
        // If there are no instances, each part is added once, in its own coordinates.
        if (deck.instances.empty())
            for (std::size_t p = 1; p < parts_.size(); ++p) place(*parts_[p], parts_[p]->name, nullptr, at);
        if (deck.instances.size() > 1)
            for (std::size_t s = 0; s < set_instance_.size(); ++s)
                deck.sets[s].name = deck.instances[index(set_instance_[s])].name + "." + deck.sets[s].name;
        const bool sections = !global.sections.empty();
        global.sections.clear();
        finish_part(global);
        if (sections) into_.pass_over("sections of the assembly");
        // Add the nodes and sets of the assembly itself. The numbers in its sets already include the
        // offsets of the instances.
        std::vector<DeckSet> sets = std::move(global.builder.deck().sets);
        global.builder.deck().sets.clear();
        if (!global.builder.deck().points.empty()) place(global, "assembly", nullptr, at);
        for (DeckSet& set : sets) deck.sets.push_back(std::move(set));
    }
    for (std::size_t r = 0; r < deck.regions.size(); ++r) deck.regions[r].tag = static_cast<int>(r) + 1;
    std::erase_if(deck.blocks, [](const DeckBlock& block) { return block.count() == 0; });
}

} // namespace lacuna::io
