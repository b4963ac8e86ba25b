// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/whole_folder.h>

#include <lacuna/core/error.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <tuple>

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace lacuna::io {

std::vector<std::string> names_in(int folder, const std::string& name)
{
    std::vector<std::string> names;
    const int listed = ::openat(folder, name.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    DIR* const all = listed < 0 ? nullptr : ::fdopendir(listed);
    if (all == nullptr) {
        if (listed >= 0) ::close(listed);
        return names;
    }
    while (const dirent* const entry = ::readdir(all))
        if (const std::string_view own = entry->d_name; own != "." && own != "..") names.emplace_back(own);
    ::closedir(all);
    return names;
}

namespace {

/// Make the folders above a path that do not exist, as "case" and "constant" above "case/constant/polyMesh".
void make_parents(const std::string& path)
{
    const std::filesystem::path parent = std::filesystem::path(path).parent_path();
    std::error_code ignored; // place() names the folder that is missing then
    if (!path.ends_with("/") && !parent.empty()) std::filesystem::create_directories(parent, ignored);
}

} // namespace

WholeFolder::WholeFolder(const OutputPath& path, const std::function<bool(std::string_view name)>& is_own)
    : path_(path.text())
{
    if (!path.folder_) make_parents(path_);
    std::tie(folder_, name_) = path.place();
    if (name_.empty())
        throw InvalidInput(Message("io.not_replaced",
                                   "cannot write '{}': the path does not end in the name of a folder", path_)
                               .remedy("add the name of the folder"));
    struct stat before = {};
    if (::fstatat(folder_->descriptor(), name_.c_str(), &before, AT_SYMLINK_NOFOLLOW) == 0) {
        replaces_ = true;
        if (!S_ISDIR(before.st_mode))
            throw InvalidInput(
                Message("io.not_replaced", "cannot write '{}': it exists and is not a folder", path_)
                    .remedy("remove it, or give another path"));
        for (const std::string& name : names_in(folder_->descriptor(), name_)) {
            struct stat status = {};
            const std::string inside = name_ + "/" + name;
            const bool is_file = ::fstatat(folder_->descriptor(), inside.c_str(), &status,
                                           AT_SYMLINK_NOFOLLOW) == 0 &&
                                 S_ISREG(status.st_mode);
            if (!is_file || !is_own(name))
                throw InvalidInput(
                    Message("io.not_replaced",
                            "cannot write '{}': the folder already contains '{}', which would be lost", path_,
                            name)
                        .remedy("move that file away, or give another path"));
        }
    } else if (errno != ENOENT) {
        fail(errno);
    }
    for (int attempt = 0; unfinished_.empty(); ++attempt) {
        const std::string name = formatted(".{}.unfinished-{}-{}", name_, ::getpid(), attempt);
        if (::mkdirat(folder_->descriptor(), name.c_str(), 0777) == 0)
            unfinished_ = name;
        else if (errno != EEXIST)
            fail(errno);
    }
}

WholeFolder::~WholeFolder() { remove_unfinished(); }

OutputPath WholeFolder::file(const std::string& name) const
{
    OutputPath file(path_ + "/" + name);
    file.folder_ = folder_->inside(unfinished_);
    file.name_ = name;
    return file;
}

void WholeFolder::commit()
{
    const int folder = folder_->descriptor();
    if (!replaces_) {
        if (::renameat(folder, unfinished_.c_str(), folder, name_.c_str()) != 0) fail(errno);
        unfinished_.clear();
        return;
    }
#ifdef RENAME_EXCHANGE
    if (::renameat2(folder, unfinished_.c_str(), folder, name_.c_str(), RENAME_EXCHANGE) == 0)
        return remove_unfinished(); // the hidden folder is now the old one
    if (errno != EINVAL && errno != ENOSYS) fail(errno);
#endif
    // The file system cannot exchange names. So there is no folder at the path between the two renames.
    const std::string before = unfinished_ + "-before";
    if (::renameat(folder, name_.c_str(), folder, before.c_str()) != 0) fail(errno);
    if (::renameat(folder, unfinished_.c_str(), folder, name_.c_str()) != 0) {
        const int error = errno;
        ::renameat(folder, before.c_str(), folder, name_.c_str());
        fail(error);
    }
    unfinished_ = before;
    remove_unfinished();
}

void WholeFolder::remove_unfinished() noexcept
{
    if (unfinished_.empty()) return;
    for (const std::string& name : names_in(folder_->descriptor(), unfinished_))
        ::unlinkat(folder_->descriptor(), (unfinished_ + "/" + name).c_str(), 0);
    ::unlinkat(folder_->descriptor(), unfinished_.c_str(), AT_REMOVEDIR);
    unfinished_.clear();
}

void WholeFolder::fail(int error) const
{
    throw BackendError("io.write_failed", "cannot write '{}': {}. No partial file was left", path_,
                       std::generic_category().message(error));
}

} // namespace lacuna::io
