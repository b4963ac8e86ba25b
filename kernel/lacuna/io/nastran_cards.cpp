// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/nastran.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <climits>

namespace lacuna::io {
namespace {

/// Data fields of a line; large ones take two lines.
constexpr std::size_t kFields = kCardColumns / kCardField - 2;

bool begins_with(std::string_view line, std::string_view word)
{
    return same_word(line.substr(0, word.size()), word) &&
           (line.size() == word.size() || std::isalnum(static_cast<unsigned char>(line[word.size()])) == 0);
}

bool is_bulk_line(std::string_view line, std::string_view word)
{
    if (!begins_with(line, word)) return false;
    const std::string text = upper(line);
    return text.find("BULK") != std::string::npos || text.find("SUPER") != std::string::npos;
}

/// Cards that contain text, equations or labels, in which commas do not separate fields.
constexpr std::string_view kTextCards[] = {"DEQATN", "MONPNT1", "MONPNT2", "MONPNT3", "MONDSP1", "UDNAME"};

/// Whether commas separate the fields of a line: the text before its first comma is then one word, or empty.
bool is_free(std::string_view line)
{
    const std::string_view before = line.substr(0, line.find(','));
    if (before.size() == line.size()) return false;
    const std::string_view word = trimmed(before);
    return word.empty() || (before.find_first_not_of(" \t") < kCardField &&
                            word.find_first_of(" \t") == std::string_view::npos);
}

/// The number n in `*n`, `*(n)`, `=n` and `=(n)`.
std::string_view replication_value(std::string_view field)
{
    field.remove_prefix(1);
    if (field.starts_with('(') && field.ends_with(')')) field = field.substr(1, field.size() - 2);
    return trimmed(field);
}

/// A field increased by a replication step; integers stay integers.
std::string stepped(std::string_view field, std::string_view step, const DeckPlace& place)
{
    const auto whole = parse_integer<Index>(field), by = parse_integer<Index>(step);
    if (whole && by) return std::to_string(std::int64_t(*whole) + *by);
    const auto real = parse_real(field, Exponents::fortran), more = parse_real(step, Exponents::fortran);
    if (whole || !real || !more)
        place.fail("cannot add {} to {} of the replicated card", shown(step), shown(field));
    std::array<char, 32> text{};
    std::string sum(text.data(), std::to_chars(text.data(), text.data() + text.size(), *real + *more).ptr);
    // without a point, the sum would become an integer
    return sum.find_first_of(".e") == std::string::npos ? sum + '.' : sum;
}

bool is_large(std::string_view first) { return first.find('*') != std::string_view::npos; }

/// Whether the last field of a line names a continuation.
bool is_named(std::string_view marker) { return marker.size() > 1 && (marker[0] == '+' || marker[0] == '*'); }

void add_line(std::string& text, std::string_view raw)
{
    text += raw;
    text += '\n';
}

void check_half(const Card& card, bool large, const DeckPlace& place)
{
    if (card.fields.size() % kFields != 0 && !large)
        place.fail("expected the second half of a card of large fields, which begins with *");
}

} // namespace

std::string_view Card::field(std::size_t number) const
{
    return number - 2 < fields.size() ? fields[number - 2] : std::string_view();
}

Index Card::whole(std::size_t number, Index otherwise) const
{
    const std::string_view text = field(number);
    if (text.empty()) return otherwise;
    const auto value = parse_integer<Index>(text);
    if (!value || *value < 0)
        fail("expected a whole number in field {}, found {}", number, found(shown(text)));
    return *value;
}

Index Card::needed(std::size_t number) const
{
    if (field(number).empty()) fail("expected a number in field {}, found none", number);
    return whole(number, 0);
}

double Card::real(std::size_t number) const
{
    const std::string_view text = field(number);
    if (text.empty()) return 0;
    const auto value = parse_real(text, Exponents::fortran);
    if (!value) fail("expected a finite number in field {}, found {}", number, found(shown(text)));
    return *value;
}

Vec3 Card::point(std::size_t first) const { return {real(first), real(first + 1), real(first + 2)}; }

std::string Card::text(std::size_t first) const
{
    std::size_t end = fields.size() + 2;
    while (end > first && field(end - 1).empty()) --end;
    std::string all;
    for (std::size_t number = first; number < end; ++number) {
        if (number > first) all += ',';
        all += field(number);
    }
    return all;
}

BulkData::BulkData(Cursor& cursor)
    : main_(cursor), start_(cursor), files_(cursor), bulk_(true), room_(kMadePerByte * cursor.rest().size())
{
    for (Cursor scout = cursor; bulk_ && !scout.at_end();) bulk_ = !is_bulk_line(scout.line(), "BEGIN");
}

void BulkData::read(const std::function<CardUse(std::string_view)>& use,
                    const std::function<void(const Card&)>& take)
{
    use_ = use;
    take_ = take;
    read_file(main_, 0);
    end_card();
    finish();
}

std::vector<DeckText> BulkData::texts() const
{
    std::vector<DeckText> all;
    const auto add = [&](DeckText::Place place, const std::string& text) {
        if (!text.empty()) all.push_back({place, "", text});
    };
    add(DeckText::Place::head, head_);
    add(DeckText::Place::cards, kept_);
    add(DeckText::Place::tail, tail_);
    return all;
}

void BulkData::read_file(Cursor& cursor, std::uint64_t file)
{
    while (!cursor.at_end() && !ended_) {
        const std::string_view raw = cursor.raw_line();
        const std::string_view line = raw.substr(0, raw.find('$'));
        const std::string_view words = trimmed(line);
        std::string& outside = tail_.empty() ? head_ : tail_;
        if (words.empty()) {
            add_line(bulk_ ? kept_ : outside, raw);
        } else if (begins_with(words, "INCLUDE")) {
            include(cursor, words.substr(7), file);
        } else if (is_bulk_line(words, "BEGIN")) {
            end_card();
            bulk_ = true;
            if (upper(words).find("SUPER") == std::string::npos)
                add_line(head_, raw);
            else if (++superelements_ == 1)
                first_superelement_ = {&cursor, cursor.last(), file};
        } else if (is_bulk_line(words, "END")) {
            end_card();
            bulk_ = false;
            if (tail_.empty()) tail_ = "ENDDATA\n";
        } else if (begins_with(words, "ENDDATA")) {
            ended_ = true;
            add_line(tail_, raw);
        } else if (bulk_) {
            read_line(cursor, file, line, raw);
        } else {
            add_line(outside, raw);
        }
    }
}

void BulkData::include(Cursor& cursor, std::string_view rest, std::uint64_t from)
{
    end_card();
    const DeckPlace place{&cursor, cursor.last(), from};
    std::string name(trimmed(rest));
    if (name.starts_with('\'') || name.starts_with('"')) {
        const char quote = name[0];
        while (name.find(quote, 1) == std::string::npos) {
            if (cursor.at_end() || name.size() > PATH_MAX)
                place.fail("INCLUDE: the name has no closing quote");
            name += cursor.line();
        }
        name = name.substr(1, name.find(quote, 1) - 1);
    }
    Cursor& included = files_.include(name, place);
    read_file(included, files_.last());
    end_card();
}

/// Split a line into `line_`.
void BulkData::split(const Cursor& cursor, std::string_view line)
{
    line_.clear();
    if (is_free(line))
        free_fields(cursor, line);
    else
        fixed_fields(line);
}

void BulkData::free_fields(const Cursor& cursor, std::string_view line)
{
    for (std::size_t begin = 0; begin <= line.size();) {
        const std::size_t end = std::min(line.find(',', begin), line.size());
        line_.push_back(trimmed(line.substr(begin, end - begin)));
        begin = end + 1;
    }
    const std::size_t all = 2 + (is_large(line_[0]) ? kFields / 2 : kFields);
    for (std::size_t k = all; k < line_.size(); ++k)
        if (!line_[k].empty())
            cursor.fail("expected at most {} fields in a line, found {}", all, found(line_.size()));
    line_.resize(all);
}

/// Split a line in small or large format; a tab skips to the next column of eight.
void BulkData::fixed_fields(std::string_view line)
{
    line = line.substr(0, kCardColumns);
    if (line.find('\t') != std::string_view::npos) {
        std::string& wide = expanded_.emplace_back();
        for (const char c : line) {
            if (wide.size() >= kCardColumns) break;
            if (c == '\t')
                wide.append(kCardField - wide.size() % kCardField, ' ');
            else
                wide += c;
        }
        line = wide;
    }
    const auto field = [&](std::size_t begin, std::size_t length) {
        return begin < line.size() ? trimmed(line.substr(begin, length)) : std::string_view();
    };
    line_.push_back(field(0, kCardField));
    const std::size_t width = is_large(line_[0]) ? kLargeCardField : kCardField;
    for (std::size_t begin = kCardField; begin < kCardColumns - kCardField; begin += width)
        line_.push_back(field(begin, width));
    line_.push_back(field(kCardColumns - kCardField, kCardField));
}

void BulkData::read_line(const Cursor& cursor, std::uint64_t file, std::string_view line,
                         std::string_view raw)
{
    const DeckPlace place{&cursor, cursor.last(), file};
    const auto text_card = std::ranges::find_if(
        kTextCards, [&](std::string_view name) { return begins_with(line, name); });
    if (text_card != std::end(kTextCards)) {
        begin_card(*text_card, place);
        text_ = true;
    } else if (!text_ || std::isalnum(static_cast<unsigned char>(line.front())) != 0 || line[0] == '=') {
        split(cursor, line);
        if (!take_fields(place)) return take_elsewhere(place, raw);
    }
    if (card_use_ != CardUse::read) add_line(kept_, raw);
}

/// Take over the fields in `line_`. @return false if they belong to another card than the current one
bool BulkData::take_fields(const DeckPlace& place)
{
    const std::string_view first = line_.front();
    if (first.starts_with('=') && first.size() > 1) {
        replicate(replication_value(first), place);
        return true;
    }
    if (first.empty() || first[0] == '+' || first[0] == '*') {
        const bool both_named = first.size() > 1 && marker_.size() > 1;
        const bool another = both_named && !same_word(first.substr(1), marker_.substr(1));
        // A continuation with a name, after a line that names none. If some line of the deck names it, it
        // belongs to the card of that line. Otherwise its name is only a remark of the user.
        const bool unsaid = first.size() > 1 && marker_.size() <= 1 && open_ && is_awaited(first.substr(1));
        if (first.size() > 1 && (!open_ || another || unsaid)) return false;
        if (!open_) place.fail("the continuation {} belongs to no card", shown(first));
        if (first.size() > 1 && marker_.size() <= 1 && unasked_.empty()) unasked_ = shown(first);
        check_half(card_, is_large(first), place);
    } else if (const std::string_view name = first.substr(0, first.find('*')); !replicates(name)) {
        begin_card(name, place);
    } else {
        if (!open_ || (card_use_ != CardUse::keep && is_named(marker_)))
            place.fail("expected a complete card right above = for it to repeat");
        begin_replica(place);
        steps_.clear();
    }
    marker_ = line_.back();
    if (card_use_ == CardUse::keep) return true;
    if (!replica_) card_.fields.insert(card_.fields.end(), line_.begin() + 1, line_.end() - 1);
    if (!replica_) return true;
    const auto rest = std::find(line_.begin() + 1, line_.end() - 1, "==");
    std::for_each(line_.begin() + 1, rest, [&](std::string_view field) { add_replicated(field); });
    while (rest + 1 != line_.end() && card_.fields.size() < pattern_.size()) add_replicated("=");
    return true;
}

/// Whether the card in `line_` replicates the card before it, which has the same name or is not named.
bool BulkData::replicates(std::string_view name) const
{
    const bool same = open_ && card_use_ != CardUse::keep && same_word(card_.name, name);
    const auto is_rule = [](std::string_view field) {
        return field.starts_with('=') || field.starts_with('*');
    };
    return name == "=" || (same && std::any_of(line_.begin() + 1, line_.end() - 1, is_rule));
}

void BulkData::begin_card(std::string_view name, const DeckPlace& place)
{
    const auto fits = [](unsigned char c) { return std::isalnum(c) != 0; };
    const bool nameless = parse_integer<Index>(name).has_value();
    if (!nameless && (std::isalpha(static_cast<unsigned char>(name.empty() ? ' ' : name[0])) == 0 ||
                      name.size() > kCardField || !std::ranges::all_of(name, fits)))
        place.fail("expected the name of a bulk data card, found {}", found(shown(name)));
    end_card();
    open_ = true;
    replica_ = text_ = false;
    kept_begin_ = kept_.size();
    card_.place = place;
    card_.name = nameless ? std::string() : upper(name);
    card_use_ = nameless ? CardUse::read : use_(card_.name);
}

void BulkData::end_card()
{
    if (!std::exchange(open_, false)) return;
    text_ = false;
    if (is_named(marker_)) {
        own_fields(card_);
        go_on({card_, card_use_, owned_.emplace_back(marker_), false, {}});
    } else if (!hand_over(card_, card_use_)) {
        kept_.resize(kept_begin_);
    }
    card_.fields.clear();
    marker_ = {};
    while (expanded_.size() > 1) expanded_.pop_front(); // the last may be the current line
}

/// Pass on a card. @return false if the card repeats one of another superelement and is therefore ignored
bool BulkData::hand_over(const Card& card, CardUse use)
{
    if (use == CardUse::both) {
        const auto [known, fresh] = known_.emplace(card.name + ' ' + std::string(card.field(2)),
                                                   std::pair(superelements_, card.text(3)));
        const bool again = !fresh && known->second.first != superelements_;
        if (again && known->second.second != card.text(3))
            card.fail(Message(kUnreadable,
                              "superelements are read as one deck, but another one has a different {}",
                              known->first)
                          .remedy("renumber one of them"));
        if (again) return false;
    }
    take_(card);
    return true;
}

// --- replication -------------------------------------------------------------------------------------------

/// Begin a card that is replicated from the card before it. That card is still open, and becomes the pattern.
void BulkData::begin_replica(const DeckPlace& place)
{
    pattern_.assign(card_.fields.begin(), card_.fields.end());
    end_card();
    generated_.clear();
    open_ = replica_ = true;
    kept_begin_ = kept_.size();
    card_.place = place;
}

/// Add the next field of a replica. `=` copies the pattern's field. `*(n)` adds n to it, here and in further
/// replicas of this card.
void BulkData::add_replicated(std::string_view field)
{
    const std::size_t at = card_.fields.size();
    pattern_.resize(std::max(pattern_.size(), at + 1));
    steps_.resize(std::max(steps_.size(), at + 1));
    if (field.starts_with('*'))
        steps_[at] = replication_value(field);
    else if (field != "=")
        pattern_[at] = field;
    card_.fields.push_back(generated_.emplace_back(
        steps_[at].empty() ? pattern_[at] : stepped(pattern_[at], steps_[at], card_.place)));
}

/// `=(n)`: replicate the card above n times.
void BulkData::replicate(std::string_view count, const DeckPlace& place)
{
    const auto times = parse_integer<Index>(count);
    if (!times || *times < 1 || !open_ || !replica_ || is_named(marker_))
        place.fail("expected =n with a count above 0 right below a card that begins with =, found ={}",
                   count.substr(0, kCardField));
    if (index(*times) > room_)
        place.fail(Message(kUnreadable, "={} generates too many cards for a deck of this size", *times)
                       .remedy("write them out"));
    room_ -= index(*times);
    for (Index n = 0; n < *times && card_use_ != CardUse::keep; ++n) {
        begin_replica(place);
        for (std::size_t k = pattern_.size(); k > 0; --k) add_replicated("=");
    }
}

// --- continuations -----------------------------------------------------------------------------------------

/// Whether a line of the deck names this continuation. The first call searches the deck.
bool BulkData::is_awaited(std::string_view name)
{
    if (!awaited_) {
        awaited_.emplace();
        const std::vector<std::string_view> line = line_;
        const std::size_t before = expanded_.size();
        for (Cursor scout = start_; !scout.at_end();) {
            const std::string_view raw = scout.raw_line();
            const std::string_view words = raw.substr(0, raw.find('$'));
            // Lines with too many fields are refused when they are read.
            if (std::ranges::count(words, ',') > static_cast<std::ptrdiff_t>(kFields) + 1) continue;
            split(scout, words);
            if (is_named(line_.back())) awaited_->push_back(upper(line_.back().substr(1)));
            while (expanded_.size() > before) expanded_.pop_back();
        }
        std::ranges::sort(*awaited_);
        line_ = line;
    }
    return std::ranges::binary_search(*awaited_, upper(name));
}

/// Copy the fields of a card, so that they stay valid when its lines are discarded.
void BulkData::own_fields(Card& card)
{
    for (std::string_view& field : card.fields)
        if (!field.empty()) field = owned_.emplace_back(field);
}

/// Store the continuation in `line_`, which belongs to another card than the one before it.
void BulkData::take_elsewhere(const DeckPlace& place, std::string_view raw)
{
    Waiting found{
        {std::string(line_.front().substr(1)), {}, place}, CardUse::keep, {}, false, std::string(raw)};
    found.large = is_large(line_.front());
    found.card.fields.assign(line_.begin() + 1, line_.end() - 1);
    own_fields(found.card);
    found.marker = owned_.emplace_back(line_.back());
    const std::string name = upper(found.card.name);
    const auto card = cards_.find(name);
    continuations_.emplace(name, std::move(found));
    if (card == cards_.end()) return;
    Waiting waiting = std::move(card->second);
    cards_.erase(card);
    go_on(std::move(waiting));
}

/// Append to a card the continuations that are read already, and pass the card on if it is complete.
void BulkData::go_on(Waiting waiting)
{
    while (is_named(waiting.marker)) {
        const std::string name = upper(waiting.marker.substr(1));
        const auto next = continuations_.find(name);
        if (next == continuations_.end()) {
            cards_.emplace(name, std::move(waiting));
            return;
        }
        const Waiting& line = next->second;
        check_half(waiting.card, line.large, line.card.place);
        waiting.card.fields.insert(waiting.card.fields.end(), line.card.fields.begin(),
                                   line.card.fields.end());
        waiting.marker = line.marker;
        if (waiting.use != CardUse::read) add_line(kept_, line.raw);
        continuations_.erase(next);
    }
    hand_over(waiting.card, waiting.use);
}

void BulkData::finish()
{
    const auto place = [](const auto& waiting) { return waiting.second.card.place.number(); };
    if (!continuations_.empty()) {
        const Waiting& line = std::ranges::min_element(continuations_, {}, place)->second;
        const std::string text = shown(line.raw.substr(0, kCardField));
        if (cards_.empty()) line.card.place.fail("the continuation {} belongs to no card", text);
        const Waiting& card = std::ranges::min_element(cards_, {}, place)->second;
        card.card.fail("its continuation {} is missing, and the continuation {} belongs to no card",
                       shown(card.marker), text);
    }
    if (!cards_.empty() && !unasked_.empty()) {
        const Waiting& card = std::ranges::min_element(cards_, {}, place)->second;
        card.card.fail("its continuation {} is missing, and no card names the continuation {}",
                       shown(card.marker), unasked_);
    }
    // No continuation with these names exists, so the names were only remarks: pass on the cards as they are.
    std::map<std::uint64_t, const Waiting*> in_order;
    for (const auto& [name, waiting] : cards_) in_order.emplace(waiting.card.place.number(), &waiting);
    for (const auto& [number, waiting] : in_order) hand_over(waiting->card, waiting->use);
    cards_.clear();
}

} // namespace lacuna::io
