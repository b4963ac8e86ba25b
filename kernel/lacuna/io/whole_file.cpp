// SPDX-License-Identifier: MIT
#include <lacuna/io/whole_file.h>

#include <lacuna/core/error.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace lacuna::io {
namespace fs = std::filesystem;
namespace {

/// The path itself, or the file it is a link to, so that a link stays one.
fs::path resolved(const std::string& path)
{
    std::error_code ignored;
    if (fs::is_symlink(path, ignored)) {
        fs::path target = fs::weakly_canonical(path, ignored);
        if (!ignored) return target;
    }
    return path;
}

void check_place(const std::string& path, const fs::path& target)
{
    if (path.empty()) throw InvalidInput("io.no_path", "no file name was given to write to");
    std::error_code ignored;
    const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, ignored))
        throw InvalidInput("io.no_folder", "cannot write '" + path + "': there is no folder '" +
                                               folder.string() + "'; make it first, or name another place");
    if (fs::is_directory(target, ignored) || !target.has_filename())
        throw InvalidInput("io.not_a_file", "cannot write '" + path + "': it is a folder; add a file name");
    if (fs::exists(target, ignored) && !fs::is_regular_file(target, ignored))
        throw InvalidInput("io.not_a_file", "cannot write '" + path + "': it is not a plain file");
}

} // namespace

WholeFile::WholeFile(const std::string& path)
{
    const fs::path target = resolved(path);
    check_place(path, target);
    path_ = target.string();
    // The name is taken by whoever makes the file first, so that two writers never share one.
    for (int attempt = 0; descriptor_ < 0; ++attempt) {
        unfinished_ = path_ + ".unfinished-" + std::to_string(::getpid()) + "-" + std::to_string(attempt);
        descriptor_ = ::open(unfinished_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor_ < 0 && errno != EEXIST) {
            const int error = errno;
            unfinished_.clear();
            fail(error);
        }
    }
}

WholeFile::~WholeFile()
{
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!unfinished_.empty()) ::unlink(unfinished_.c_str());
}

void WholeFile::fail(int error)
{
    std::string hint;
    if (error == ENOSPC || error == EDQUOT || error == EFBIG) hint = "; make room, or name another disk";
    throw BackendError("io.write_failed", "cannot write '" + path_ +
                                              "': " + std::generic_category().message(error) + hint +
                                              ". Nothing was left behind");
}

void WholeFile::write_at(std::uint64_t offset, std::string_view bytes)
{
    while (!bytes.empty()) {
        const ssize_t done = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (done < 0) {
            if (errno == EINTR) continue;
            fail(errno);
        }
        offset += static_cast<std::uint64_t>(done);
        bytes.remove_prefix(static_cast<std::size_t>(done));
    }
}

void WholeFile::append(std::string_view bytes)
{
    write_at(end_, bytes);
    end_ += bytes.size();
}

void WholeFile::commit()
{
    const int descriptor = descriptor_;
    descriptor_ = -1;
    if (::close(descriptor) != 0) fail(errno);
    if (std::rename(unfinished_.c_str(), path_.c_str()) != 0) fail(errno);
    unfinished_.clear();
}

} // namespace lacuna::io
