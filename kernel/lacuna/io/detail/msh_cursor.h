// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

/// A place in the bytes of an MSH file. Internal to this folder.
namespace lacuna::io {

/// Reads values as text or as bytes, whichever the file holds, and never beyond its end.
class MshCursor {
public:
    MshCursor(std::string path, std::string_view data) : path_(std::move(path)), data_(data) {}

    bool binary = false; ///< set once the header is known

    [[nodiscard]] bool at_end() const { return at_ >= data_.size(); }
    /// The rest of the line, without blanks at its ends.
    std::string_view line();
    /// Go behind the line `$End<section>`.
    void leave(const std::string& section);

    int integer();        ///< 4 bytes, or text
    std::uint64_t size(); ///< 8 bytes, or text
    double real();        ///< 8 bytes, or text
    /// A number in text, also in files that are binary elsewhere.
    std::int64_t text_integer();
    double text_real();
    /// 4 bytes as they lie.
    int raw_integer() { return raw<int>(); }
    /// `count` bytes as they lie.
    std::string_view bytes(std::uint64_t count);

    /// A count of records, refused where the rest of the file could not hold them: a count that lies must not
    /// cost memory. @param bytes  of a record in a binary file. @param values  of a record in a text file.
    std::uint64_t plausible(std::uint64_t count, std::uint64_t bytes, std::uint64_t values);

    /// @throw InvalidInput "io.bad_mesh"
    [[noreturn]] void fail(const std::string& what) const;

private:
    template <class Value>
    Value raw()
    {
        const std::string_view from = bytes(sizeof(Value));
        Value value;
        std::memcpy(&value, from.data(), sizeof value);
        return value;
    }
    std::string_view token();

    std::string path_;
    std::string_view data_;
    std::size_t at_ = 0;
};

} // namespace lacuna::io
