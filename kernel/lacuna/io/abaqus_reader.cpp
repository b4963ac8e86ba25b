// SPDX-License-Identifier: MIT
//
// Abaqus and CalculiX decks. Each part is read into a mesh of its own and placed once per instance; a deck
// without parts is one part without a name.
#include <lacuna/io/detail/abaqus.h>
#include <lacuna/io/detail/deck_builder.h>
#include <lacuna/io/detail/deck_files.h>
#include <lacuna/io/detail/deck_writer.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <optional>

namespace lacuna::io {
namespace {

/// A family of element types: the word at the start of their names, and their dimension. A number of nodes
/// and letters follow the word: S4R, C3D8I.
struct Family {
    std::string_view word;
    int dimension;
};
constexpr Family kFamilies[] = {{"C3D", 3},  {"DC3D", 3}, {"AC3D", 3},  {"SC", 3},    {"CSS", 3},
                                {"S", 2},    {"DS", 2},   {"M3D", 2},   {"SFM3D", 2}, {"R3D", 2},
                                {"STRI", 2}, {"CPS", 2},  {"CPE", 2},   {"CAX", 2},   {"DC2D", 2},
                                {"DCAX", 2}, {"AC2D", 2}, {"DCC3D", 3}, {"CGAX", 2}};

/// The shape of an element by its type in capitals; empty if it is neither a shell nor a solid.
std::optional<DeckShape> shape_of(std::string_view type)
{
    for (const Family& family : kFamilies) {
        if (!type.starts_with(family.word)) continue;
        std::string_view rest = type.substr(family.word.size());
        std::size_t digits = 0;
        while (digits < rest.size() && std::isdigit(static_cast<unsigned char>(rest[digits])) != 0) ++digits;
        auto nodes = parse_integer<int>(rest.substr(0, digits)).value_or(0);
        if (digits == 0) continue;
        rest.remove_prefix(digits);
        if (!std::ranges::all_of(rest, [](unsigned char c) { return std::isalnum(c) != 0; })) continue;
        if (family.word == "STRI" && nodes == 65) nodes = 6;
        constexpr std::array<int, 5> kCorners{3, 4, 5, 6, 8};
        const bool centred = family.dimension == 3 &&
                             (nodes == 14 || nodes == 18 || nodes == 27); // shapes that no Abaqus element has
        if (centred) continue;
        for (const int corners : kCorners)
            if (const auto shape = find_shape(family.dimension, corners, nodes)) return shape;
    }
    return std::nullopt;
}

/// Keywords that generate or move nodes or elements. A deck with such a keyword is refused, because it would
/// be read as a different mesh.
constexpr std::string_view kGenerators[] = {"NGEN",   "NFILL",  "NCOPY", "NMAP",  "ELGEN",
                                            "ELCOPY", "SYSTEM", "MODEL", "IMPORT"};
struct Scope {
    std::string name;
    DeckBuilder builder{DeckFormat::abaqus};
    std::map<std::string, std::size_t, std::less<>> sets; ///< index in the deck's sets, by kind and name in
                                                          ///< capitals
    struct Section {
        std::string name, material;
        std::vector<DeckTag> members;
    };
    std::vector<Section> sections;
    bool placed = false;
};

class AbaqusReader {
public:
    AbaqusReader(Cursor& cursor, DeckBuilder& into) : main_(cursor), into_(into), files_(cursor) {}

    void read()
    {
        parts_.push_back(std::make_unique<Scope>());
        scope_ = parts_.front().get();
        read_file(main_, 0, 0);
        finish_element();
        if (in_part_) main_.fail("the file ends within *PART");
        finish();
    }

private:
    enum class Mode { none, node, element, set, surface, instance, other_elements };

    // --- lines ---------------------------------------------------------------------------------------------

    void read_file(Cursor& cursor, std::uint64_t file, int depth)
    {
        budget_ += kMadePerByte * cursor.rest().size();
        while (!cursor.at_end()) {
            std::string_view raw = cursor.raw_line();
            place_ = {&cursor, cursor.last(), file};
            std::string_view line = trimmed(raw);
            if (line.empty() || line.starts_with("**")) {
                if (!line.empty()) keep(raw);
            } else if (line.starts_with('*')) {
                const DeckPlace begin = place_;
                std::string joined(raw), words(line);
                while (words.ends_with(',') && !cursor.at_end()) {
                    raw = cursor.raw_line();
                    joined += '\n';
                    joined += raw;
                    words += trimmed(raw);
                }
                place_ = begin;
                take_keyword(words, joined, depth);
            } else if (mode_ == Mode::none) {
                keep(raw);
            } else {
                take_data(line, raw);
            }
        }
    }

    [[noreturn]] void fail(const Message& why) const { place_.fail(why); }
    template <class... Arguments>
    [[noreturn]] void fail(lacuna::Format<sizeof...(Arguments)> format, const Arguments&... arguments) const
    {
        place_.fail(format, arguments...);
    }

    void keep(std::string_view raw)
    {
        std::vector<DeckText>& texts = into_.deck().texts;
        const auto place = mesh_begun_ ? DeckText::Place::cards : DeckText::Place::head;
        if (texts.empty() || texts.back().place != place || texts.back().part != scope_->name)
            texts.push_back({place, scope_->name, ""});
        texts.back().text += raw;
        texts.back().text += '\n';
    }

    // --- keywords ------------------------------------------------------------------------------------------

    void take_keyword(const std::string& words, const std::string& raw, int depth)
    {
        const Keyword keyword = parse_keyword(words);
        if (keyword.name == "INCLUDE") {
            const std::string name = keyword.value("INPUT");
            Cursor& included = files_.include(name, place_, depth);
            read_file(included, files_.last(), depth + 1);
            return;
        }
        finish_element();
        mode_ = Mode::none;
        if (std::ranges::find(kGenerators, keyword.name) != std::end(kGenerators))
            fail(Message(kUnreadable, "*{} is not read", keyword.name)
                     .remedy("write the deck with all nodes and elements"));
        if (keyword.name == "NODE")
            begin_nodes(keyword);
        else if (keyword.name == "ELEMENT")
            begin_elements(keyword, raw);
        else if (keyword.name == "NSET" || keyword.name == "ELSET")
            begin_set(keyword);
        else if (keyword.name == "SURFACE")
            begin_surface(keyword, raw);
        else if (keyword.name == "PART" || keyword.name == "ENDPART")
            begin_part(keyword);
        else if (keyword.name == "INSTANCE" || keyword.name == "ENDINSTANCE")
            begin_instance(keyword);
        else if (keyword.name == "ASSEMBLY" || keyword.name == "ENDASSEMBLY")
            mesh_begun_ = true;
        else
            take_other(keyword, raw);
    }

    void take_other(const Keyword& keyword, const std::string& raw)
    {
        keep(raw);
        if (!is_section(keyword)) {
            into_.pass_over("*" + keyword.name);
            return;
        }
        const std::string name = keyword.value("ELSET");
        const DeckSet* set = find_set(*scope_, DeckSet::Kind::elements, name);
        if (set != nullptr) scope_->sections.push_back({set->name, keyword.value("MATERIAL"), set->members});
    }

    void begin_part(const Keyword& keyword)
    {
        mesh_begun_ = true;
        const bool end = keyword.name == "ENDPART";
        if (instance_part_ != nullptr) fail("*PART within *INSTANCE");
        if (end != in_part_) fail("{}", end ? "*END PART without *PART" : "*PART within *PART");
        in_part_ = !end;
        scope_ = parts_.front().get();
        if (end) return;
        const std::string name = keyword.value("NAME");
        if (name.empty()) fail("*PART: expected NAME=");
        if (find_part(name) != nullptr) fail("*PART: the part {} is defined twice", shown(name));
        parts_.push_back(std::make_unique<Scope>());
        scope_ = parts_.back().get();
        scope_->name = name;
    }

    Scope* find_part(std::string_view name) const
    {
        const auto found = std::find_if(parts_.begin() + 1, parts_.end(),
                                        [&](const auto& part) { return same_word(part->name, name); });
        return found == parts_.end() ? nullptr : found->get();
    }

    void begin_instance(const Keyword& keyword)
    {
        if (keyword.name == "ENDINSTANCE") {
            if (instance_part_ == nullptr) fail("*END INSTANCE without *INSTANCE");
            place_instance(std::exchange(instance_part_, nullptr));
            return;
        }
        if (in_part_ || instance_part_ != nullptr) fail("*INSTANCE within *PART or *INSTANCE");
        instance_name_ = keyword.value("NAME");
        const std::string part = keyword.value("PART");
        instance_part_ = find_part(part);
        if (instance_name_.empty() || instance_part_ == nullptr)
            fail("*INSTANCE: expected NAME= and, as PART=, a part defined above; found {}",
                 found(shown(part)));
        rows_.clear();
        mode_ = Mode::instance;
    }

    void begin_nodes(const Keyword& keyword)
    {
        if (instance_part_ != nullptr)
            fail(Message(kUnreadable, "*NODE within *INSTANCE is not read").remedy("put it into a part"));
        mesh_begun_ = true;
        mode_ = Mode::node;
        const std::string system = upper(keyword.value("SYSTEM"));
        if (!system.empty() && system != "R" && system != "C")
            fail(Message(kUnreadable, "*NODE: SYSTEM={} is not read", system).remedy("give R or C"));
        cylindrical_ = system == "C";
        set_ = open_set(DeckSet::Kind::nodes, keyword.value("NSET"));
    }

    void begin_elements(const Keyword& keyword, const std::string& raw)
    {
        if (instance_part_ != nullptr)
            fail(Message(kUnreadable, "*ELEMENT within *INSTANCE is not read").remedy("put it into a part"));
        mesh_begun_ = true;
        type_ = upper(keyword.value("TYPE"));
        const auto fits = [](unsigned char c) { return std::isalnum(c) != 0; };
        if (type_.empty() || !std::ranges::all_of(type_, fits))
            fail("*ELEMENT: expected TYPE= and a word of letters and digits, found {}", found(shown(type_)));
        const std::string set = keyword.value("ELSET");
        set_ = open_set(DeckSet::Kind::elements, set);
        const std::optional<DeckShape> shape = shape_of(type_);
        if (!shape) {
            mode_ = Mode::other_elements;
            keep(raw);
            return;
        }
        shape_ = *shape;
        mode_ = Mode::element;
        further_ = -1;
        block_ = scope_->builder.block_of(shape_, type_);
        const std::string key = upper(set);
        const auto [found, fresh] = regions_.try_emplace({scope_, key}, -1);
        if (fresh) found->second = scope_->builder.add_region(0, set.empty() ? scope_->name : set);
        region_ = found->second;
    }

    void begin_set(const Keyword& keyword)
    {
        const auto kind = keyword.name == "NSET" ? DeckSet::Kind::nodes : DeckSet::Kind::elements;
        const std::string name = keyword.value(keyword.name);
        if (name.empty()) fail("*{}: expected {}=", keyword.name, keyword.name);
        mesh_begun_ = true;
        mode_ = Mode::set;
        generate_ = keyword.find("GENERATE") != nullptr;
        const std::string instance = keyword.value("INSTANCE");
        of_instance_ = -1;
        if (!instance.empty()) {
            of_instance_ = find_instance(instance);
            if (of_instance_ < 0) fail("*{}: no instance {}", keyword.name, shown(instance));
        }
        set_ = open_set(kind, name);
        if (const std::string* elements = keyword.find("ELSET");
            elements != nullptr && kind == DeckSet::Kind::nodes)
            add_nodes_of(*elements);
    }

    void begin_surface(const Keyword& keyword, const std::string& raw)
    {
        const std::string type = upper(keyword.value("TYPE"));
        const std::string name = keyword.value("NAME");
        if (name.empty()) fail("*SURFACE: expected NAME=");
        if ((!type.empty() && type != "ELEMENT") || keyword.find("COMBINE") != nullptr) {
            keep(raw);
            into_.pass_over("*SURFACE of other kinds");
            return;
        }
        mesh_begun_ = true;
        mode_ = Mode::surface;
        set_ = open_set(DeckSet::Kind::sides, name);
        generate_ = false;
        of_instance_ = -1;
    }

    // --- sets ----------------------------------------------------------------------------------------------

    static std::string key_of(DeckSet::Kind kind, std::string_view name)
    {
        return std::to_string(static_cast<int>(kind)) + upper(name);
    }

    DeckSet* find_set(Scope& scope, DeckSet::Kind kind, std::string_view name)
    {
        const auto found = scope.sets.find(key_of(kind, name));
        return found == scope.sets.end() ? nullptr : &scope.builder.deck().sets[found->second];
    }

    /// The set of a name in this scope, created on first use; -1: no name.
    std::ptrdiff_t open_set(DeckSet::Kind kind, const std::string& name)
    {
        if (name.empty()) return -1;
        std::vector<DeckSet>& sets = scope_->builder.deck().sets;
        const auto [found, fresh] = scope_->sets.try_emplace(key_of(kind, name), sets.size());
        if (fresh) sets.push_back({.kind = kind, .name = name});
        return static_cast<std::ptrdiff_t>(found->second);
    }

    DeckSet& set() { return scope_->builder.deck().sets[static_cast<std::size_t>(set_)]; }

    Index find_instance(std::string_view name) const
    {
        const std::vector<DeckInstance>& all = into_.deck().instances;
        const auto found = find_word(all, name, &DeckInstance::name);
        return found == all.end() ? -1 : static_cast<Index>(found - all.begin());
    }

    /// Add the members that a word names: a single number, or the members of a set. "instance.word" names a
    /// number or a set of that instance.
    void members_of(std::string_view word, DeckSet::Kind kind, std::vector<DeckTag>& members)
    {
        Index instance = of_instance_;
        const std::size_t dot = word.rfind('.');
        if (dot != std::string_view::npos && find_set(*scope_, kind, word) == nullptr) {
            instance = find_instance(word.substr(0, dot));
            if (instance < 0) fail("no instance {}", shown(word.substr(0, dot)));
            word.remove_prefix(dot + 1);
        }
        const DeckTag offset = instance < 0 ? 0 : into_.deck().instances[index(instance)].offset;
        if (const auto number = parse_integer<Index>(word)) {
            if (*number < 0) fail("expected a number of a node or element, found {}", found(shown(word)));
            members.push_back(*number + offset);
            return;
        }
        Scope* scope = scope_;
        if (instance >= 0) scope = find_part(into_.deck().instances[index(instance)].part);
        const DeckSet* found = find_set(*scope, kind, word);
        if (found == nullptr)
            fail("expected a number or the name of a set above, found {}", lacuna::found(shown(word)));
        const std::vector<DeckTag> copy = found->members; // a copy: `members` may belong to the same set
        spend(copy.size());
        for (const DeckTag tag : copy) members.push_back(tag + offset);
    }

    /// Add all nodes of the elements in an earlier set to the current set.
    void add_nodes_of(const std::string& elements)
    {
        constexpr auto kElements = DeckSet::Kind::elements;
        std::vector<DeckTag> cells;
        members_of(elements, kElements, cells);
        std::ranges::sort(cells);
        const bool of_instance = of_instance_ >= 0 || (elements.find('.') != std::string::npos &&
                                                       find_set(*scope_, kElements, elements) == nullptr);
        const Deck& deck = of_instance ? into_.deck() : scope_->builder.deck();
        spend(deck.element_count());
        for (const DeckBlock& block : deck.blocks)
            for (std::size_t e = 0; e < block.count(); ++e) {
                if (!std::ranges::binary_search(cells, block.tags[e])) continue;
                for (const Index node : block.element(e)) // point indices, or node tags while the part is
                                                          // being read
                    if (node >= 0) set().members.push_back(of_instance ? deck.point_tags[index(node)] : node);
            }
    }

    // --- data ----------------------------------------------------------------------------------------------

    Index whole(std::string_view word) const
    {
        const auto value = parse_integer<Index>(word);
        if (!value || *value < 0) fail("expected a whole number, found {}", found(shown(word)));
        return *value;
    }

    double real(std::string_view word) const
    {
        if (word.empty()) return 0;
        const auto value = parse_real(word, Exponents::fortran);
        if (!value) fail("expected a finite number, found {}", found(shown(word)));
        return *value;
    }

    void take_data(std::string_view line, std::string_view raw)
    {
        switch (mode_) {
        case Mode::node:
            return take_node(line);
        case Mode::element:
            return take_element(line);
        case Mode::set:
            return generate_ ? take_range(line) : take_members(line);
        case Mode::surface:
            return take_side(line);
        case Mode::instance:
            return take_row(line);
        case Mode::other_elements:
            take_other_element(line);
            [[fallthrough]];
        case Mode::none:
            return keep(raw);
        }
    }

    void take_node(std::string_view line)
    {
        const Index tag = whole(next_field(line));
        Vec3 p;
        for (double& x : p) x = real(next_field(line));
        if (cylindrical_) {
            const double angle = p.y() * std::numbers::pi / 180;
            p = {p.x() * std::cos(angle), p.x() * std::sin(angle), p.z()};
        }
        scope_->builder.add_point(tag, p, *place_.cursor);
        if (set_ >= 0) set().members.push_back(tag);
    }

    void take_element(std::string_view line)
    {
        if (given_ == 0) element_place_ = place_;
        const auto wanted = static_cast<std::size_t>(shape_info(shape_).nodes) + 1;
        const bool from_start = given_ == 0;
        std::size_t further = 0;
        while (!line.empty()) {
            const std::string_view field = next_field(line);
            if (field.empty() && line.empty()) break; // a comma at the end: the next line continues
            const Index number = whole(field);
            if (given_ < wanted)
                element_[given_++] = number;
            else
                ++further;
        }
        // The element lists more nodes than its type has, so their number does not show whether the element
        // continues on the next line. Each line must then be one element, with as many nodes as the first
        // line.
        if (further_ < 0) further_ = static_cast<std::ptrdiff_t>(further);
        if (further_ != static_cast<std::ptrdiff_t>(further) || (further > 0 && !from_start))
            fail("expected {} nodes of {}, or the same larger number on each line; found another number",
                 needed(wanted - 1), type_);
        if (further > 0) into_.pass_over_nodes(type_, further);
        if (given_ == wanted) finish_element();
    }

    /// Finish the element. Also called if a keyword comes before the element has all its nodes.
    void finish_element()
    {
        if (given_ == 0) return;
        const auto nodes = static_cast<std::size_t>(shape_info(shape_).nodes);
        if (given_ != nodes + 1)
            element_place_.fail("expected {} nodes of {}, found {}", needed(nodes), type_, found(given_ - 1));
        given_ = 0;
        scope_->builder.add_element(block_, element_[0], region_, {element_.data() + 1, nodes},
                                    element_place_.number());
        if (set_ >= 0) set().members.push_back(element_[0]);
    }

    void take_other_element(std::string_view line)
    {
        // The type is unknown, and so is its number of nodes. An element continues on the next line if its
        // line ends with a comma.
        if (!std::exchange(goes_on_, line.ends_with(','))) {
            into_.pass_over("elements " + type_);
            if (set_ >= 0)
                if (const auto tag = parse_integer<Index>(next_field(line))) set().members.push_back(*tag);
        }
    }

    void take_members(std::string_view line)
    {
        std::vector<DeckTag> found;
        const auto kind = set().kind;
        while (!line.empty())
            if (const std::string_view word = next_field(line); !word.empty()) members_of(word, kind, found);
        set().members.insert(set().members.end(), found.begin(), found.end());
    }

    void take_range(std::string_view line)
    {
        const Index first = whole(next_field(line));
        const Index last = whole(next_field(line));
        const std::string_view word = next_field(line);
        const Index step = word.empty() ? 1 : whole(word);
        if (step < 1 || last < first)
            fail("expected an increasing range 'first, last, step', found {}, {}, {}", found(first), last,
                 step);
        const DeckTag offset = of_instance_ < 0 ? 0 : into_.deck().instances[index(of_instance_)].offset;
        spend(index(last - first) / index(step));
        for (std::int64_t tag = first; tag <= last; tag += step) set().members.push_back(tag + offset);
    }

    void take_side(std::string_view line)
    {
        std::vector<DeckTag> elements;
        members_of(next_field(line), DeckSet::Kind::elements, elements);
        const std::string side = upper(next_field(line));
        int number = 0;
        if (side == "SNEG")
            number = -1;
        else if (side.size() == 2 && side[1] >= '1' &&
                 (side[0] == 'S' ? side[1] <= '6' : side[0] == 'E' && side[1] <= '4'))
            number = side[1] - '0';
        else if (side != "SPOS")
            fail("expected a side S1 to S6, E1 to E4, SPOS or SNEG, found {}", found(shown(side)));
        for (const DeckTag element : elements) set().sides.push_back({element, number});
    }

    void take_row(std::string_view line)
    {
        std::vector<double> row;
        while (!line.empty()) row.push_back(real(next_field(line)));
        const bool right = rows_.empty() ? row.size() >= 3 : rows_.size() == 1 && row.size() >= 7;
        if (!right) fail("*INSTANCE: expected three numbers of a translation, then seven of a rotation");
        rows_.push_back(std::move(row));
    }

    // --- putting together ----------------------------------------------------------------------------------

    /// Assign regions by the sections, and replace node tags by indices.
    void finish_scope(Scope& scope)
    {
        if (std::exchange(scope.placed, true)) return;
        Deck& deck = scope.builder.deck();
        for (DeckSet& set : deck.sets) tidy(set);
        const TagPlaces nodes(deck.point_tags, [&](Index, Index second) {
            main_.fail("{}{} is defined twice", scope.name.empty() ? "" : formatted("part {}: ", scope.name),
                       numbered("node", deck.point_tags[index(second)]));
        });
        scope.builder.resolve(
            nodes, [&](std::uint64_t place, const Message& why) { files_.place_of(place).fail(why); });
        if (scope.sections.empty()) take_sets_for_sections(scope);
        if (scope.sections.empty()) return;
        const std::vector<DeckTag> tags = element_tags(deck);
        std::vector<Index*> regions;
        for (DeckBlock& block : deck.blocks)
            for (Index& region : block.regions) regions.push_back(&region);
        const TagPlaces elements(tags);
        for (const Scope::Section& section : scope.sections) {
            const Index region = region_called(scope, section.name);
            deck.regions[index(region)].material = section.material;
            for (const DeckTag tag : section.members)
                if (const Index e = elements.find(tag); e >= 0) *regions[index(e)] = region;
        }
    }

    /// If there are no sections and *ELEMENT names no set, the element sets become the regions, provided each
    /// element is in exactly one of them. Other programs convert regions to such sets.
    static void take_sets_for_sections(Scope& scope)
    {
        const Deck& deck = scope.builder.deck();
        if (std::ranges::find(deck.regions, scope.name, &DeckRegion::name) == deck.regions.end()) return;
        std::vector<Scope::Section> sections;
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
    static Index region_called(Scope& scope, const std::string& name)
    {
        const std::vector<DeckRegion>& all = scope.builder.deck().regions;
        const auto found = find_word(all, name, &DeckRegion::name);
        return found == all.end() ? scope.builder.add_region(0, name)
                                  : static_cast<Index>(found - all.begin());
    }

    /// Placement of an instance: a translation, then a rotation about an axis.
    [[nodiscard]] Eigen::Isometry3d placement() const
    {
        Eigen::Isometry3d to = Eigen::Isometry3d::Identity();
        if (!rows_.empty()) to.translation() = Vec3(rows_[0][0], rows_[0][1], rows_[0][2]);
        if (rows_.size() > 1) {
            const std::vector<double>& r = rows_[1];
            const Vec3 a(r[0], r[1], r[2]);
            const Vec3 axis = Vec3(r[3], r[4], r[5]) - a;
            if (!(axis.norm() > 0)) fail("*INSTANCE: the axis of the rotation has length 0");
            const Eigen::AngleAxisd turn(r[6] * std::numbers::pi / 180, axis.normalized());
            to = Eigen::Translation3d(a) * turn * Eigen::Translation3d(-a) * to;
        }
        return to;
    }

    void place_instance(Scope* part)
    {
        finish_scope(*part);
        copy(*part, instance_name_, placement(), !rows_.empty());
    }

    /// Add a copy of a part to the deck. Its numbers are raised unless all of them are above those in the
    /// deck.
    void copy(Scope& scope, const std::string& name, const Eigen::Isometry3d& to, bool moved)
    {
        const Deck& part = scope.builder.deck();
        Deck& deck = into_.deck();
        const auto extend = [](std::pair<DeckTag, DeckTag>& range, const std::vector<DeckTag>& tags) {
            for (const DeckTag tag : tags) range = {std::min(range.first, tag), std::max(range.second, tag)};
        };
        std::pair<DeckTag, DeckTag> own{std::numeric_limits<DeckTag>::max(), -1};
        extend(own, part.point_tags);
        for (const DeckBlock& block : part.blocks) extend(own, block.tags);
        spend(part.points.size() + part.element_count());
        for (const DeckSet& of : part.sets) spend(of.members.size() + of.sides.size() + 1);
        const DeckTag offset = own.first <= highest_ ? highest_ : 0;
        highest_ = std::max(highest_, own.second + offset);
        const auto first = static_cast<Index>(deck.points.size());
        deck.instances.push_back({name, scope.name, deck.points.size(), part.points.size(), offset});
        for (std::size_t p = 0; p < part.points.size(); ++p) {
            deck.points.push_back(moved ? Vec3(to * part.points[p]) : part.points[p]);
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
            const std::size_t place = into_.block_of(block.shape, block.type);
            append_block(block, first, first_region, offset, deck.blocks[place]);
        }
        for (const DeckSet& set : part.sets) {
            raise_numbers(deck.sets.emplace_back(set), offset, offset);
            set_instance_.push_back(static_cast<Index>(deck.instances.size()) - 1);
        }
    }

    void finish()
    {
        Scope& global = *parts_.front();
        Deck& deck = into_.deck();
        if (parts_.size() == 1) {
            finish_scope(global);
            Deck& whole = global.builder.deck();
            deck.points = std::move(whole.points);
            deck.point_tags = std::move(whole.point_tags);
            deck.blocks = std::move(whole.blocks);
            deck.regions = std::move(whole.regions);
            deck.sets = std::move(whole.sets);
        } else {
            // If there are no instances, each part is added once, in its own coordinates.
            rows_.clear();
            if (deck.instances.empty())
                for (std::size_t p = 1; p < parts_.size(); ++p) {
                    finish_scope(*parts_[p]);
                    copy(*parts_[p], parts_[p]->name, Eigen::Isometry3d::Identity(), false);
                }
            if (deck.instances.size() > 1)
                for (std::size_t s = 0; s < set_instance_.size(); ++s)
                    deck.sets[s].name = deck.instances[index(set_instance_[s])].name + "." +
                                        deck.sets[s].name;
            const bool sections = !global.sections.empty();
            global.sections.clear();
            finish_scope(global);
            if (sections) into_.pass_over("sections of the assembly");
            // Add the nodes and sets of the assembly itself. The numbers in its sets already include the
            // offsets of the instances.
            std::vector<DeckSet> sets = std::move(global.builder.deck().sets);
            global.builder.deck().sets.clear();
            if (!global.builder.deck().points.empty())
                copy(global, "assembly", Eigen::Isometry3d::Identity(), false);
            for (DeckSet& set : sets) deck.sets.push_back(std::move(set));
        }
        for (std::size_t r = 0; r < deck.regions.size(); ++r) deck.regions[r].tag = static_cast<int>(r) + 1;
        std::erase_if(deck.blocks, [](const DeckBlock& block) { return block.count() == 0; });
    }

    /// Count generated data against a budget. Ranges and copies create more than the file contains, so their
    /// amount is limited by the size of the files.
    void spend(std::size_t count)
    {
        if (count > budget_)
            fail("ranges, sets and instances generate too many entries for a file of this size");
        budget_ -= count;
    }
    // Number of set members and copied entities that each byte of the file may generate. It allows about
    // fifty sets of all elements; not measured.
    static constexpr std::size_t kMadePerByte = 16;

    std::size_t budget_ = 100'000; // entities that even a small deck may generate

    Cursor& main_;
    DeckBuilder& into_;
    DeckFiles files_;
    std::vector<std::unique_ptr<Scope>> parts_; ///< the first scope holds the entities outside all parts
    Scope* scope_ = nullptr;
    std::map<std::pair<Scope*, std::string>, Index> regions_;
    std::vector<Index> set_instance_; ///< index of each set's instance; sets of the assembly come last and
                                      ///< have no entry
    DeckPlace place_, element_place_;
    Mode mode_ = Mode::none;
    bool mesh_begun_ = false, in_part_ = false, cylindrical_ = false, generate_ = false, goes_on_ = false;
    std::ptrdiff_t set_ = -1; ///< index in the scope of the set that is being read
    Index of_instance_ = -1;
    std::string type_, instance_name_;
    DeckShape shape_ = DeckShape::hex8;
    std::size_t block_ = 0, given_ = 0;
    std::ptrdiff_t further_ = -1; ///< number of surplus nodes in each line under the keyword; -1: not known
                                  ///< yet
    Index region_ = 0;
    std::array<Index, 28> element_{}; ///< tag and nodes of the element that is being read
    Scope* instance_part_ = nullptr;
    std::vector<std::vector<double>> rows_; ///< data lines of an instance
    DeckTag highest_ = 0;
};

} // namespace

const std::string* Keyword::find(std::string_view key) const
{
    for (const auto& [name_of, value] : parameters)
        if (name_of == key) return &value;
    return nullptr;
}

std::string Keyword::value(std::string_view key) const
{
    const std::string* found = find(key);
    return found == nullptr ? std::string() : *found;
}

Keyword parse_keyword(std::string_view words)
{
    Keyword keyword;
    words.remove_prefix(1);
    for (bool first = true; !words.empty() || first; first = false) {
        const std::string_view field = next_field(words);
        const std::size_t equals = std::min(field.find('='), field.size());
        std::string key = upper(field.substr(0, equals));
        std::erase_if(key, [](char c) { return is_blank(c); });
        if (first) {
            keyword.name = key;
            continue;
        }
        std::string_view value = equals < field.size() ? trimmed(field.substr(equals + 1))
                                                       : std::string_view();
        if (value.size() >= 2 && value.front() == '"' && value.back() == '"')
            value = value.substr(1, value.size() - 2);
        if (!key.empty()) keyword.parameters.emplace_back(std::move(key), std::string(value));
    }
    return keyword;
}

std::vector<AbaqusCard> abaqus_cards(std::string_view text)
{
    std::vector<AbaqusCard> cards(1);
    for (std::size_t begin = 0, at = 0; at < text.size(); begin = at) {
        const auto next_line = [&] {
            const std::size_t from = at, end = std::min(text.find('\n', at), text.size());
            at = std::min(end + 1, text.size());
            return trimmed(text.substr(from, end - from));
        };
        const std::string_view line = next_line();
        const bool comment = line.starts_with("**"), keyword = !comment && line.starts_with('*');
        if (keyword) {
            std::string words(line);
            while (words.ends_with(',') && at < text.size()) words += next_line();
            cards.push_back({parse_keyword(words)});
        }
        AbaqusCard& card = cards.back();
        const auto extend = [&](std::string_view& lines) {
            lines = text.substr(lines.empty() ? begin : static_cast<std::size_t>(lines.data() - text.data()));
            lines = lines.substr(0, at - static_cast<std::size_t>(lines.data() - text.data()));
        };
        extend(card.text);
        if (!keyword && !comment) extend(card.data);
    }
    return cards;
}

bool is_section(const Keyword& keyword)
{
    constexpr std::string_view kSections[] = {"SOLIDSECTION",   "SHELLSECTION",        "MEMBRANESECTION",
                                              "SURFACESECTION", "SHELLGENERALSECTION", "SOLIDSHELLSECTION",
                                              "RIGIDBODY"};
    return std::ranges::find(kSections, keyword.name) != std::end(kSections);
}

bool is_layer(std::string_view type)
{
    return std::ranges::any_of(std::array{"COH3D8", "GK3D8", "SC8R", "CSS8"},
                               [&](const char* word) { return type.starts_with(word); });
}

std::string layer_wedge(std::string_view type)
{
    if (!is_layer(type) || type.starts_with("CSS")) return {};
    std::string wedge(type);
    wedge[wedge.find('8')] = '6';
    return wedge;
}

bool is_abaqus_element(std::string_view type, DeckShape shape)
{
    // Cohesive elements and gaskets are written, but not read: they may have no thickness.
    const bool thin = type.starts_with("COH3D") || type.starts_with("GK3D");
    if (thin && type.substr(type.find('D') + 1).starts_with('8')) return shape == DeckShape::hex8;
    if (thin && type.substr(type.find('D') + 1).starts_with('6')) return shape == DeckShape::wedge6;
    return shape_of(type) == shape;
}

void read_abaqus(Cursor& cursor, DeckBuilder& into) { AbaqusReader(cursor, into).read(); }

} // namespace lacuna::io
