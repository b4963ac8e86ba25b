// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/error.h>
#include <lacuna/core/shared/fields.h>
#include <lacuna/core/shared/team.h>
#include <lacuna/core/types.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

/// Serialisation of values for other processes of the same program, on machines with the same byte order.
namespace lacuna {

/// Thrown if bytes received from another process do not follow the protocol.
class ProtocolError : public Error {
public:
    explicit ProtocolError(std::string_view what) : Error("core.protocol", "{}", what) {}
};

/// Types that are copied byte by byte: numbers, enumerators and fixed-size arrays of numbers. `bool` is
/// excluded, because a byte other than 0 and 1 is not a valid value.
template <class T>
struct IsPlain
    : std::bool_constant<(std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) || std::is_enum_v<T>> {
};
template <class T, std::size_t n>
struct IsPlain<std::array<T, n>> : IsPlain<T> {
};
template <>
struct IsPlain<Vec2> : std::true_type {
};
template <>
struct IsPlain<Vec3> : std::true_type {
};

static_assert(std::endian::native == std::endian::little, "the wire is little-endian and never swapped");
static_assert(sizeof(Vec2) == 2 * sizeof(double) && sizeof(Vec3) == 3 * sizeof(double));

/// Appends values to a buffer: numbers as they are in memory, arrays and strings preceded by their length,
/// variants by the number of their type, structs as their members in the order of declaration.
class Writer {
public:
    template <class T>
    void operator()(const T& value)
    {
        if constexpr (IsPlain<T>::value)
            append(&value, sizeof(T));
        else
            each_field(value, *this);
    }
    void operator()(bool truth) { (*this)(static_cast<std::uint8_t>(truth)); }
    void operator()(const std::string& text)
    {
        (*this)(static_cast<std::uint64_t>(text.size()));
        append(text.data(), text.size());
    }
    template <class T>
    void operator()(const std::optional<T>& value)
    {
        (*this)(value.has_value());
        if (value) (*this)(*value);
    }
    template <class... T>
    void operator()(const std::variant<T...>& value)
    {
        (*this)(static_cast<std::uint8_t>(value.index()));
        std::visit(*this, value);
    }
    template <class T>
    void operator()(const std::vector<T>& values)
    {
        (*this)(static_cast<std::uint64_t>(values.size()));
        if constexpr (IsPlain<T>::value)
            append(values.data(), values.size() * sizeof(T));
        else
            for (const T& value : values) (*this)(value);
    }

    [[nodiscard]] std::string take() && { return std::move(bytes_); }

private:
    void append(const void* data, std::size_t size)
    {
        if (size > 0) bytes_.append(static_cast<const char*>(data), size);
    }

    std::string bytes_;
};

/// Reads data written by a `Writer`. A length is checked against the number of bytes left before it is used.
class Reader {
public:
    explicit Reader(std::string_view bytes) : left_(bytes) {}

    template <class T>
    void operator()(T& value)
    {
        if constexpr (IsPlain<T>::value)
            std::memcpy(static_cast<void*>(&value), take(sizeof(T)), sizeof(T));
        else
            each_field(value, *this);
    }
    void operator()(bool& truth)
    {
        const char byte = *take(1);
        if (byte != 0 && byte != 1) throw ProtocolError("a truth value is neither 0 nor 1");
        truth = byte == 1;
    }
    void operator()(std::string& text)
    {
        const std::size_t size = length(1);
        text.assign(take(size), size);
    }
    template <class T>
    void operator()(std::optional<T>& value)
    {
        bool is_set = false;
        (*this)(is_set);
        if (is_set) (*this)(value.emplace());
    }
    template <class... T>
    void operator()(std::variant<T...>& value)
    {
        std::uint8_t wanted = 0;
        (*this)(wanted);
        if (wanted >= sizeof...(T)) throw ProtocolError("a value has an unknown type");
        std::size_t type = 0;
        ((type++ == wanted ? (*this)(value.template emplace<T>()) : void()), ...);
    }
    template <class T>
    void operator()(std::vector<T>& values)
    {
        if constexpr (IsPlain<T>::value) {
            const std::size_t count = length(sizeof(T));
            values.resize(count);
            if (count > 0)
                std::memcpy(static_cast<void*>(values.data()), take(count * sizeof(T)), count * sizeof(T));
        } else {
            // Each element takes at least one byte, so the number of bytes left bounds the loop.
            const std::size_t count = length(1);
            values.clear();
            for (std::size_t i = 0; i < count; ++i) (*this)(values.emplace_back());
        }
    }

    [[nodiscard]] bool is_empty() const { return left_.empty(); }
    /// @throw ProtocolError  bytes are left over.
    void finish() const
    {
        if (!left_.empty()) throw ProtocolError("a message has bytes left over");
    }

private:
    std::size_t length(std::size_t size_of_one)
    {
        std::uint64_t count = 0;
        (*this)(count);
        if (count > left_.size() / size_of_one) throw ProtocolError("a length exceeds the message");
        return static_cast<std::size_t>(count);
    }
    const char* take(std::size_t size)
    {
        if (size > left_.size()) throw ProtocolError("a message ends too early");
        const char* at = left_.data();
        left_.remove_prefix(size);
        return at;
    }
    std::string_view left_;
};

/// The values that the processes of a team wrote, by rank. Each process writes any number of them.
/// @throw TeamFailed  as `gather()`
template <class Value>
std::vector<Value> gathered(const Team* team, Writer own)
{
    std::vector<Value> all;
    for (const std::string& bytes : gather(team, std::move(own).take())) {
        Reader reader(bytes);
        while (!reader.is_empty()) reader(all.emplace_back());
    }
    return all;
}

} // namespace lacuna
