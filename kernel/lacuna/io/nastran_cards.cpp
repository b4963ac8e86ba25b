// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/nastran.h>

#include <algorithm>
#include <cctype>

namespace lacuna::io {
namespace {

constexpr std::size_t kField = 8;       // characters of a small field, and of the first and last of each line
constexpr std::size_t kLargeField = 16; // characters
constexpr std::size_t kFields = 8;      // data fields of a line; large ones take two lines

std::string upper(std::string_view text)
{
    std::string result(text);
    for (char& c : result) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return result;
}

bool begins_with(std::string_view line, std::string_view word)
{
    return same_word(line.substr(0, word.size()), word) &&
           (line.size() == word.size() || std::isalnum(static_cast<unsigned char>(line[word.size()])) == 0);
}

bool begins_bulk(std::string_view line)
{
    return begins_with(line, "BEGIN") && upper(line).find("BULK") != std::string::npos;
}

bool is_large(std::string_view first) { return first.find('*') != std::string_view::npos; }

/// Whether the last field of a line names a continuation.
bool is_named(std::string_view marker) { return marker.size() > 1 && (marker[0] == '+' || marker[0] == '*'); }

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
        fail("expected a whole number in field " + std::to_string(number) + ", found " + shown(text));
    return *value;
}

Index Card::needed(std::size_t number) const
{
    if (field(number).empty()) fail("expected a number in field " + std::to_string(number) + ", found none");
    return whole(number, 0);
}

double Card::real(std::size_t number) const
{
    const std::string_view text = field(number);
    if (text.empty()) return 0;
    const auto value = parse_real(text, Exponents::fortran);
    if (!value)
        fail("expected a finite number in field " + std::to_string(number) + ", found " + shown(text));
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

BulkData::BulkData(Cursor& cursor) : main_(cursor), start_(cursor), files_(cursor), bulk_(true)
{
    for (Cursor scout = cursor; bulk_ && !scout.at_end();) bulk_ = !begins_bulk(scout.line());
}

void BulkData::read(const std::function<CardUse(std::string_view)>& use,
                    const std::function<void(const Card&)>& take)
{
    use_ = use;
    take_ = take;
    read_file(main_, 0, 0);
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

void BulkData::read_file(Cursor& cursor, std::uint64_t file, int depth)
{
    const auto keep = [](std::string& text, std::string_view raw) {
        text += raw;
        text += '\n';
    };
    while (!cursor.at_end() && !ended_) {
        const std::string_view raw = cursor.raw_line();
        const std::string_view line = raw.substr(0, raw.find('$'));
        const std::string_view words = trimmed(line);
        if (words.empty()) {
            keep(bulk_ ? kept_ : head_, raw);
        } else if (begins_with(words, "INCLUDE")) {
            include(cursor, words.substr(7), file, depth);
        } else if (begins_with(words, "BEGIN") && upper(words).find("SUPER") != std::string::npos) {
            cursor.fail("superelements are not read; write the deck as one");
        } else if (begins_bulk(words)) {
            bulk_ = true;
            keep(head_, raw);
        } else if (begins_with(words, "ENDDATA")) {
            ended_ = true;
            keep(tail_, raw);
        } else if (bulk_) {
            read_line(cursor, file, line, raw);
        } else {
            keep(head_, raw);
        }
    }
}

void BulkData::include(Cursor& cursor, std::string_view rest, std::uint64_t from, int depth)
{
    end_card();
    const DeckPlace place{&cursor, cursor.last(), from};
    std::string name(trimmed(rest));
    if (name.starts_with('\'') || name.starts_with('"')) {
        const char quote = name[0];
        while (name.find(quote, 1) == std::string::npos) {
            if (cursor.at_end() || name.size() > DeckFiles::kLongestName)
                place.fail("INCLUDE: the name has no end");
            name += cursor.line();
        }
        name = name.substr(1, name.find(quote, 1) - 1);
    }
    Cursor& included = files_.include(name, place, depth);
    read_file(included, files_.last(), depth + 1);
    end_card();
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
            cursor.fail("expected at most " + std::to_string(all) + " fields in a line, found " +
                        std::to_string(line_.size()));
    line_.resize(all);
}

/// Small or large format, tabs to the next column of eight.
void BulkData::fixed_fields(std::string_view line)
{
    constexpr std::size_t kColumns = (kFields + 2) * kField; // what is further right does not count
    line = line.substr(0, kColumns);
    if (line.find('\t') != std::string_view::npos) {
        std::string& wide = expanded_.emplace_back();
        for (const char c : line) {
            if (wide.size() >= kColumns) break;
            if (c == '\t')
                wide.append(kField - wide.size() % kField, ' ');
            else
                wide += c;
        }
        line = wide;
    }
    const auto field = [&](std::size_t begin, std::size_t length) {
        return begin < line.size() ? trimmed(line.substr(begin, length)) : std::string_view();
    };
    line_.push_back(field(0, kField));
    const std::size_t width = is_large(line_[0]) ? kLargeField : kField;
    for (std::size_t begin = kField; begin < kColumns - kField; begin += width)
        line_.push_back(field(begin, width));
    line_.push_back(field(kColumns - kField, kField));
}

void BulkData::read_line(const Cursor& cursor, std::uint64_t file, std::string_view line,
                         std::string_view raw)
{
    line_.clear();
    if (line.find(',') != std::string_view::npos)
        free_fields(cursor, line);
    else
        fixed_fields(line);
    const std::string_view first = line_.front();
    if (first.empty() || first[0] == '+' || first[0] == '*') {
        const DeckPlace place{&cursor, cursor.last(), file};
        const bool both_named = first.size() > 1 && marker_.size() > 1;
        const bool another = both_named && !same_word(first.substr(1), marker_.substr(1));
        // Behind a card that names none, a name is a mark of somebody's, where no line names any.
        const bool unsaid = first.size() > 1 && marker_.size() <= 1 && open_ && names_continuations();
        if (first.size() > 1 && (!open_ || another || unsaid)) return take_elsewhere(place, raw);
        if (!open_) cursor.fail("a continuation " + shown(first) + " of no card");
        check_half(card_, is_large(first), place);
    } else {
        end_card();
        const std::string_view name = first.substr(0, first.find('*'));
        const auto fits = [](unsigned char c) { return std::isalnum(c) != 0; };
        if (std::isalpha(static_cast<unsigned char>(first[0])) == 0 || name.size() > kField ||
            !std::ranges::all_of(name, fits))
            cursor.fail("expected the name of a bulk data card, found " + shown(first));
        open_ = true;
        card_.place = {&cursor, cursor.last(), file};
        card_.name.assign(name);
        for (char& c : card_.name) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
        card_use_ = use_(card_.name);
    }
    marker_ = line_.back();
    if (card_use_ != CardUse::read) {
        kept_ += raw;
        kept_ += '\n';
    }
    if (card_use_ != CardUse::keep)
        card_.fields.insert(card_.fields.end(), line_.begin() + 1, line_.end() - 1);
}

void BulkData::end_card()
{
    if (!std::exchange(open_, false)) return;
    if (is_named(marker_)) {
        own_fields(card_);
        go_on({card_, card_use_, owned_.emplace_back(marker_), false, {}});
    } else {
        take_(card_);
    }
    card_.fields.clear();
    marker_ = {};
    while (expanded_.size() > 1) expanded_.pop_front(); // the last may be the line that ends the card
}

/// Whether a line of the deck names its continuation. The deck is looked through the first time it is asked.
bool BulkData::names_continuations()
{
    if (!names_continuations_) {
        names_continuations_ = false;
        const std::vector<std::string_view> line = line_;
        const std::size_t before = expanded_.size();
        for (Cursor scout = start_; !scout.at_end() && !*names_continuations_;) {
            const std::string_view raw = scout.raw_line();
            const std::string_view words = raw.substr(0, raw.find('$'));
            line_.clear();
            // Lines of too many fields are refused when their turn comes.
            if (words.find(',') == std::string_view::npos)
                fixed_fields(words);
            else if (std::ranges::count(words, ',') <= static_cast<std::ptrdiff_t>(kFields) + 1)
                free_fields(scout, words);
            else
                continue;
            names_continuations_ = is_named(line_.back());
            while (expanded_.size() > before) expanded_.pop_back();
        }
        line_ = line;
    }
    return *names_continuations_;
}

/// Fields that stay when the line they are of has gone.
void BulkData::own_fields(Card& card)
{
    for (std::string_view& field : card.fields)
        if (!field.empty()) field = owned_.emplace_back(field);
}

/// The continuation in `line_`, which is not of the card before it.
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

/// Add the continuations that a card names, as far as they have come, and hand it over where none is missing.
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
        if (waiting.use != CardUse::read) {
            kept_ += line.raw;
            kept_ += '\n';
        }
        continuations_.erase(next);
    }
    take_(waiting.card);
}

void BulkData::finish()
{
    if (!continuations_.empty()) {
        const auto place = [](const auto& waiting) { return waiting.second.card.place.number(); };
        const Waiting& line = std::ranges::min_element(continuations_, {}, place)->second;
        const std::string text = shown(line.raw.substr(0, kField));
        if (cards_.empty()) line.card.place.fail("a continuation " + text + " of no card");
        const Waiting& card = std::ranges::min_element(cards_, {}, place)->second;
        card.card.fail("its continuation " + shown(card.marker) + " is not there, and " + text +
                       " is a continuation of no card");
    }
    // What they name never came: a mark of somebody's.
    std::map<std::uint64_t, const Card*> in_order;
    for (const auto& [name, waiting] : cards_) in_order.emplace(waiting.card.place.number(), &waiting.card);
    for (const auto& [place, card] : in_order) take_(*card);
    cards_.clear();
}

} // namespace lacuna::io
