// SPDX-License-Identifier: GPL-2.0-or-later
#include <lacuna/cad/detail/import_facets.h>

#include <lacuna/core/error.h>

#include <charconv>
#include <fstream>
#include <optional>

namespace lacuna::cad {

namespace {

/// Reads one file line by line; numbers are read as in the C locale, whatever the host has set.
class ObjReader {
public:
    ObjReader(const std::string& path, LabelledSoup& into)
        : path_(path), into_(into), first_(static_cast<Index>(into.soup.points.size()))
    {
    }

    void read()
    {
        std::ifstream file(path_);
        std::string line, more;
        while (std::getline(file, line)) {
            ++number_;
            while (!line.empty() && (line.back() == '\r' || line.back() == '\\')) {
                const bool goes_on = line.back() == '\\';
                line.pop_back();
                if (goes_on && std::getline(file, more)) {
                    ++number_;
                    line += ' ' + more;
                }
            }
            read_line(line.substr(0, line.find('#')));
        }
    }

private:
    void read_line(std::string_view rest)
    {
        const std::string_view word = next_word(rest);
        if (word == "v") {
            Vec3 p;
            for (int k = 0; k < 3; ++k) p[k] = number(next_word(rest));
            into_.soup.points.push_back(p);
        } else if (word == "f") {
            read_face(rest);
        } else if (word == "o" || word == "g") {
            while (!rest.empty() && is_space(rest.front())) rest.remove_prefix(1);
            while (!rest.empty() && is_space(rest.back())) rest.remove_suffix(1);
            name_ = std::string(rest);
            label_.reset();
        }
    }

    void read_face(std::string_view rest)
    {
        std::vector<Index> corners;
        for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest)) {
            corners.push_back(corner(word.substr(0, word.find('/'))));
        }
        if (corners.size() < 3) fail("a face of " + std::to_string(corners.size()) + " corners");
        const int label = current_label();
        if (corners.size() == 4) {
            into_.soup.quads.push_back({corners[0], corners[1], corners[2], corners[3]});
            into_.soup.quad_label.push_back(label);
            return;
        }
        for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
            into_.soup.triangles.push_back({corners[0], corners[k], corners[k + 1]});
            into_.soup.triangle_label.push_back(label);
        }
    }

    /// Counted from 1, or back from the last point where negative.
    Index corner(std::string_view word)
    {
        long value = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        const auto count = static_cast<long>(into_.soup.points.size()) - first_;
        if (error != std::errc{} || end != word.data() + word.size())
            fail("the corner \"" + std::string(word) + '"');
        const long place = value > 0 ? value - 1 : count + value;
        if (value == 0 || place < 0 || place >= count) {
            fail("the corner " + std::to_string(value) + ", of " + std::to_string(count) + " points so far,");
        }
        return first_ + static_cast<Index>(place);
    }

    int current_label()
    {
        if (!label_) {
            label_ = static_cast<int>(into_.label_tag.size());
            into_.label_tag.push_back(*label_ + 1);
            into_.soup.label_name.push_back(name_);
        }
        return *label_;
    }

    double number(std::string_view word)
    {
        double value = 0;
        if (word.starts_with('+')) word.remove_prefix(1);
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (error != std::errc{} || end != word.data() + word.size())
            fail("the coordinate \"" + std::string(word) + '"');
        return value;
    }

    static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r'; }

    static std::string_view next_word(std::string_view& rest)
    {
        while (!rest.empty() && is_space(rest.front())) rest.remove_prefix(1);
        std::size_t length = 0;
        while (length < rest.size() && !is_space(rest[length])) ++length;
        const std::string_view word = rest.substr(0, length);
        rest.remove_prefix(length);
        return word;
    }

    [[noreturn]] void fail(const std::string& what) const
    {
        throw InvalidInput("cad.unreadable", path_ + ", line " + std::to_string(number_) + ": " + what +
                                                 " cannot be read; check that this is a Wavefront OBJ file");
    }

    const std::string& path_;
    LabelledSoup& into_;
    Index first_;
    int number_ = 0;
    std::string name_;
    std::optional<int> label_;
};

} // namespace

void read_obj(const std::string& path, LabelledSoup& into) { ObjReader(path, into).read(); }

} // namespace lacuna::cad
