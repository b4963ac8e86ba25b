// SPDX-License-Identifier: MIT
//
// Abaqus and CalculiX decks. Each part is read into a mesh of its own and placed once per instance; a deck
// without parts is one part without a name.
#include <lacuna/io/detail/abaqus.h>
#include <lacuna/io/detail/deck_builder.h>
#include <lacuna/io/detail/deck_files.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

namespace lacuna::io {
namespace {

/// Keywords that generate or move nodes or elements. A deck with such a keyword is refused, because it would
/// be read as a different mesh.
constexpr std::string_view kGenerators[] = {"NGEN",   "NFILL",  "NCOPY", "NMAP",  "ELGEN",
                                            "ELCOPY", "SYSTEM", "MODEL", "IMPORT"};
class AbaqusReader {
public:
    AbaqusReader(Cursor& cursor, DeckBuilder& into) : main_(cursor), into_(into), files_(cursor) {}

    void read()
    {
        read_file(main_, 0);
        finish_element();
        if (in_part_) main_.fail("the file ends within *PART");
        parts_.finish(place_);
    }

private:
    enum class Mode { none, node, element, set, surface, instance, other_elements };

    // --- lines ---------------------------------------------------------------------------------------------

    void read_file(Cursor& cursor, std::uint64_t file)
    {
        parts_.allow(cursor.rest().size());
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
                take_keyword(words, joined);
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

    void take_keyword(const std::string& words, const std::string& raw)
    {
        const Keyword keyword = parse_keyword(words);
        if (keyword.name == "INCLUDE") {
            const std::string name = keyword.value("INPUT");
            Cursor& included = files_.include(name, place_);
            read_file(included, files_.last());
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
        scope_ = &parts_.outside();
        if (end) return;
        const std::string name = keyword.value("NAME");
        if (name.empty()) fail("*PART: expected NAME=");
        if (parts_.find(name) != nullptr) fail("*PART: the part {} is defined twice", shown(name));
        scope_ = &parts_.add(name);
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
        instance_part_ = parts_.find(part);
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
        const std::optional<DeckShape> shape = abaqus_shape(type_);
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

    DeckSet* find_set(AbaqusPart& scope, DeckSet::Kind kind, std::string_view name)
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
        AbaqusPart* scope = scope_;
        if (instance >= 0) scope = parts_.find(into_.deck().instances[index(instance)].part);
        const DeckSet* found = find_set(*scope, kind, word);
        if (found == nullptr)
            fail("expected a number or the name of a set above, found {}", lacuna::found(shown(word)));
        const std::vector<DeckTag> copy = found->members; // a copy: `members` may belong to the same set
        parts_.spend(copy.size(), place_);
        for (const DeckTag tag : copy) members.push_back(tag + offset);
    }

    /// Add all nodes of the elements in an earlier set to the current set.
    void add_nodes_of(const std::string& elements)
    {
        std::vector<DeckTag> cells;
        members_of(elements, DeckSet::Kind::elements, cells);
        std::ranges::sort(cells);
        const bool of_instance = of_instance_ >= 0 ||
                                 (elements.find('.') != std::string::npos &&
                                  find_set(*scope_, DeckSet::Kind::elements, elements) == nullptr);
        const Deck& deck = of_instance ? into_.deck() : scope_->builder.deck();
        parts_.spend(deck.element_count(), place_);
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
        parts_.spend(index(last - first) / index(step), place_);
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

    void place_instance(AbaqusPart* part)
    {
        const Eigen::Isometry3d to = placement();
        parts_.place(*part, instance_name_, rows_.empty() ? nullptr : &to, place_);
    }

    Cursor& main_;
    DeckBuilder& into_;
    DeckFiles files_;
    AbaqusParts parts_{main_, into_, files_};
    AbaqusPart* scope_ = &parts_.outside(); ///< what the deck's lines describe
    std::map<std::pair<AbaqusPart*, std::string>, Index> regions_;
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
    AbaqusPart* instance_part_ = nullptr;
    std::vector<std::vector<double>> rows_; ///< data lines of an instance
};

} // namespace

void read_abaqus(Cursor& cursor, DeckBuilder& into) { AbaqusReader(cursor, into).read(); }

} // namespace lacuna::io
