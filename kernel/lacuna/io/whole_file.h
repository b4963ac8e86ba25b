// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace lacuna::io {

/// A file that is there whole or not at all: it is written beside its place, and `commit()` renames it.
/// Whatever else happens, nothing is left behind and what was there before stays.
class WholeFile {
public:
    /// @throw InvalidInput  the folder does not exist, or the path is not that of a file.
    /// @throw BackendError  the folder cannot be written to.
    explicit WholeFile(const std::string& path);
    ~WholeFile();
    WholeFile(const WholeFile&) = delete;
    WholeFile& operator=(const WholeFile&) = delete;

    /// Write bytes at a place of their own; several threads may do so at once.
    /// @throw BackendError  the disk is full.
    void write_at(std::uint64_t offset, std::string_view bytes);
    /// Write bytes behind those appended so far.
    void append(std::string_view bytes);
    /// Put the file in its place. @throw BackendError
    void commit();

private:
    [[noreturn]] void fail(int error);

    std::string path_;       ///< where the file shall be
    std::string unfinished_; ///< where it is written
    int descriptor_ = -1;
    std::uint64_t end_ = 0;
};

} // namespace lacuna::io
