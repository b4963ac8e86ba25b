// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/whole_file.h>

#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace lacuna::io {

/// A folder of files that is there whole or not at all: it is written beside its place under a hidden name,
/// which the destructor removes, and renamed. One that was there before changes places with it in one system
/// call, where the file system can do so, and is removed. A kill leaves the hidden folder behind.
class WholeFolder {
public:
    /// @param is_own  whether a file of this name may go with a folder that is there.
    /// @throw InvalidInput "io.not_replaced"  it is no folder, or holds something else; names it.
    ///                     "io.no_folder"     the folder that it is to lie in does not exist.
    /// @throw BackendError  the folder cannot be written to.
    WholeFolder(const OutputPath& path, const std::function<bool(std::string_view name)>& is_own);
    ~WholeFolder();
    WholeFolder(const WholeFolder&) = delete;
    WholeFolder& operator=(const WholeFolder&) = delete;

    /// Where to write a file of it. @param name  one component of a path
    [[nodiscard]] OutputPath file(const std::string& name) const;
    /// Put the folder in its place. @throw BackendError
    void commit();

private:
    [[noreturn]] void fail(int error) const;
    void remove_unfinished() noexcept;

    std::string path_;                     ///< for messages
    std::shared_ptr<const Folder> folder_; ///< it is in
    std::string name_;                     ///< inside that
    std::string unfinished_;               ///< name it is written under; empty: it is gone
    bool replaces_ = false;
};

} // namespace lacuna::io
