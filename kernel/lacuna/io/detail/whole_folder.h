// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/whole_file.h>

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace lacuna::io {

/// The names in a folder that lies in another one, except "." and ".."; none if it cannot be listed.
/// @param name  "." stands for `folder` itself; a link is not followed
std::vector<std::string> names_in(int folder, const std::string& name);

/// A folder that appears completely or not at all. Its files are written to a hidden folder next to the final
/// path. Committing renames the hidden folder; without a commit, the destructor removes it. If a folder
/// exists at the path, both folders are exchanged in one system call, provided that the file system supports
/// this, and the old folder is removed. If the process is killed, the hidden folder stays. Missing
/// folders above it are made, except below a folder that is held open.
class WholeFolder {
public:
    /// @param is_own  returns whether a file of this name may be deleted together with an existing folder.
    /// @throw InvalidInput "io.not_replaced"  the path is not a folder, or the folder holds other files;
    ///        names one.
    ///                     "io.no_folder"     the parent folder does not exist and cannot be made.
    /// @throw BackendError  the folder cannot be written to.
    WholeFolder(const OutputPath& path, const std::function<bool(std::string_view name)>& is_own);
    ~WholeFolder();
    WholeFolder(const WholeFolder&) = delete;
    WholeFolder& operator=(const WholeFolder&) = delete;

    /// The path for writing a file of the folder. @param name  one path component
    [[nodiscard]] OutputPath file(const std::string& name) const;
    /// Move the folder to its final path. @throw BackendError
    void commit();

private:
    [[noreturn]] void fail(int error) const;
    void remove_unfinished() noexcept;

    std::string path_;                     ///< for messages
    std::shared_ptr<const Folder> folder_; ///< parent folder
    std::string name_;                     ///< name in the parent folder
    std::string unfinished_;               ///< name of the hidden folder; empty: it no longer exists
    bool replaces_ = false;
};

} // namespace lacuna::io
